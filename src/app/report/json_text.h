// JSON as every command writes it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace scanout::app {

// Paths are bytes; JSON is UTF-8: what is not becomes the replacement character. Whatever is not
// printable ASCII is written as \u: a terminal may be the reader.
std::string json_text(const nlohmann::ordered_json& json);

// What a command reports, an object: with "schema_version" in front, which names the version of
// docs/report.schema.json. It grows where a member goes away or changes its meaning.
inline constexpr int kSchemaVersion = 1;
nlohmann::ordered_json versioned(const nlohmann::ordered_json& report);

} // namespace scanout::app
