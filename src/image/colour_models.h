// Models of colour: the same colour as other triples of numbers. RGB and CMY are codes of a screen
// and what they lack of white; HSV and HSL turn them into hue, purity and brightness (Smith 1978,
// Joblove and Greenberg 1978); YCbCr parts luma from colour differences (ITU 2011, as JPEG has it);
// XYZ and Lab are CIE's, of the light. Everything goes by way of sRGB in double: the same bits
// everywhere.
#pragma once

#include "base/jobs.h"
#include "image/colour.h"

#include <array>
#include <functional>
#include <span>
#include <string_view>

namespace scanout::image {

struct ColourComponent {
    std::string_view name;
    double low, high; // what it may be; that of a view, black and white
};

struct ColourModel {
    std::string_view name;
    std::array<ColourComponent, 3> components;
    std::string_view blurb;
    // From and to what is shown: red, green and blue as codes / 255, beyond [0, 1] outside of sRGB.
    DVec3 (*of_rgb)(const DVec3& rgb);
    DVec3 (*to_rgb)(const DVec3& values);
};

// The names with spaces between them, in the order of colour_models().
inline constexpr std::string_view kColourModelNames = "rgb linear cmy hsv hsl ycbcr xyz lab";
std::span<const ColourModel> colour_models();
const ColourModel* find_colour_model(std::string_view name); // null: there is none

// The components of every pixel as grey, from low, black, to high, white. `progress` gets a share
// from 0 to 1 now and then, from the calling thread.
std::array<Image, 3> channels_of(const Image& picture, const ColourModel& model, Jobs& jobs,
                                 const std::function<void(double)>& progress = {});

} // namespace scanout::image
