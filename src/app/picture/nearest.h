// "Did you mean": the name nearest to a misspelt one, by edits (Damerau 1964: insert, delete,
// replace, swap two neighbours).
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace scanout::app {

int edit_distance(std::string_view a, std::string_view b);

// The nearest name, when it is near enough to be meant (a third of its letters may differ; in a
// name of two letters, one); else an empty view. The first of equally near ones.
std::string_view nearest_name(std::string_view text, std::span<const std::string_view> names);

// "; did you mean 'NAME'?", or nothing.
std::string did_you_mean(std::string_view text, std::span<const std::string_view> names);

} // namespace scanout::app
