#include "app/report/json_text.h"

#include <nlohmann/json.hpp>

namespace scanout::app {

std::string json_text(const nlohmann::ordered_json& json) {
    return json.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

nlohmann::ordered_json versioned(const nlohmann::ordered_json& report) {
    nlohmann::ordered_json json = {{"schema_version", kSchemaVersion}};
    json.update(report);
    return json;
}

} // namespace scanout::app
