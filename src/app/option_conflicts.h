// Options that exclude each other, or need each other.
#pragma once

#include "app/settings.h"
#include "base/result.h"

#include <string_view>

namespace scanout::app {

// What no option can see alone. Errors are whole lines, Exit::usage.
Result<void> check_together(const Settings& settings);

// Of --no-times, --record and --replay, which make a session look the same in every run, the one
// that was given; empty: none.
std::string_view steadying_option(const Settings& settings);

// May only one of two options count? Of one name, or such as --view and --camera.
bool exclude_each_other(std::string_view name, std::string_view other);

} // namespace scanout::app
