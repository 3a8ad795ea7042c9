// The values of options as text: each function reads a whole text, or says what was expected.
// An error here is the second half of a line; the caller puts the option's name in front.
#pragma once

#include "base/result.h"
#include "image/image.h"
#include "math/vec.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::app {

Result<std::int64_t> parse_integer(std::string_view text);
Result<double> parse_real(std::string_view text); // finite
// "16ms", "0.02s", "16": milliseconds, above 0 and at most kLongestTime.
Result<double> parse_time(std::string_view text);
inline constexpr double kLongestTime = 3'600'000;
// Between `least` and `most` numbers with commas between them: "30,20".
Result<std::vector<double>> parse_list(std::string_view text, std::size_t least, std::size_t most);
Result<DVec3> parse_vector(std::string_view text); // X,Y,Z

struct Size {
    int width = 0, height = 0;
};
// "1920x1080": each side 1 to frame::kMaxSide, and at most kMaxPixels together.
Result<Size> parse_size(std::string_view text);
inline constexpr std::int64_t kMaxPixels = std::int64_t{1} << 27;

// "#rrggbb", "#rgb", "transparent" or a name (black white grey ...).
Result<image::Rgba8> parse_colour(std::string_view text);
// The names that parse_colour knows, separated by spaces.
std::string_view colour_names();

} // namespace scanout::app
