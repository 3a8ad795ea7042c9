// A picture that a command makes without a model: of another picture, or by a formula.
#pragma once

#include "app/options/settings.h"
#include "base/result.h"
#include "image/image.h"

#include <cstdint>
#include <string>

namespace scanout::app {

// -o and --format, before the work begins: Exit::usage without -o or where its name and the format
// contradict each other, and what check_outputs finds.
Result<void> check_made(const Settings& settings);

// Exit::usage unless one picture is named; `example`: words that do it right.
Result<void> check_one_picture(const Settings& settings, std::string_view command,
                               std::string_view example);

// Exit::unreadable where work of so many bytes is more than what is available.
Result<void> check_memory(const std::string& what, std::int64_t bytes);

// Where -o says.
Result<void> write_made(const Settings& settings, const image::Image& picture);

} // namespace scanout::app
