// Options that exclude each other, or need each other.
#pragma once

#include "app/options/settings.h"
#include "base/result.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::app {

// What no option can see alone. Errors are whole lines, Exit::usage.
Result<void> check_together(const Settings& settings);

// Of the options that were given on the command line, by their names: a line for each that has
// nothing to say about the display that --backend asks for. Standing options may be of another one.
std::vector<std::string> without_effect(const Settings& settings,
                                        const std::set<std::string_view>& given);

// Of --no-times, --record and --replay, which make a session look the same in every run, the one
// that was given; empty: none.
std::string_view steadying_option(const Settings& settings);

// May only one of two options count? Of one name, or such as --view and --camera.
bool exclude_each_other(std::string_view name, std::string_view other);

} // namespace scanout::app
