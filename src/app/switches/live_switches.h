// What of the rendering keys switch while the model is on show: techniques of some axes, exposure
// and background.
#pragma once

#include "frame/options.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace scanout::app {

// The axes, in the order of their actions (actions.h).
inline constexpr std::array<std::string_view, 6> kSwitchedAxes = {
    "shading", "aa", "texture", "shadow", "tone", "ambient_occlusion"};

struct Rendering {
    std::array<std::string, kSwitchedAxes.size()> asked; // a technique of each axis, or "auto"
    double exposure = 0;                                 // stops
    image::Rgba8 background{48, 51, 56, 255};
    // Axes that were switched after the last step on the frontier: there they count before its
    // rungs. One bit an axis.
    std::uint8_t over_rungs = 0;
    friend bool operator==(const Rendering&, const Rendering&) = default;
};

Rendering rendering_of(const frame::FrameOptions& options);
// Puts it into `out`, which holds the options of the command line. Allocates nothing where it asks
// for the same.
void put(const Rendering& rendering, frame::FrameOptions& out);

// The technique after `now`, or before it (`by` -1): auto, then those of techniques.h, around.
std::string stepped(std::string_view axis, std::string_view now, int by);
// To the next half stop up or down.
double stepped_exposure(double stops, int by);
// Around the names that --background knows; from another colour to the first or the last of them.
image::Rgba8 stepped_background(image::Rgba8 now, int by);

std::string exposure_text(double stops);          // "+0.5 stops"
std::string background_text(image::Rgba8 colour); // "sky", "#102030": as --background takes it

// True where a rung of the frontier on this axis does not count.
bool counts_before_rung(const Rendering& rendering, std::string_view axis);

} // namespace scanout::app
