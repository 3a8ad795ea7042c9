// What the user can ask of a frame. One struct, from the command line to the plan.
#pragma once

#include "image/image.h"
#include "scene/light.h"
#include "scene/view.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::frame {

enum class Cull : std::uint8_t { none, back, front };

struct FrameOptions {
    int width = 1280, height = 720;
    int samples = 1; // a pixel: 1, 2, 4, 8, 16
    Cull cull = Cull::none;
    image::Rgba8 background{48, 51, 56, 255};
    // Techniques by name (`scanout list techniques`); "auto" lets the plan decide from the scene.
    std::string texture = "auto";
    std::string wrap = "auto";
    std::string reflection = "auto";
    std::string shading = "auto";
    std::vector<scene::Light> lights = scene::default_lights(); // at most scene::kMostLights
    std::string transparency = "auto";
    double alpha_cut = 0.5;       // least alpha that a cut-out surface shows
    int most_fragments = 1 << 16; // of a list of blended ones; what is drawn does not depend on it
    // Effects (rows of the plan) that are forced on or off; the others follow the scene.
    std::map<std::string, bool, std::less<>> effects;
};

// Where the name of the technique on an axis stands; null for an axis without an option.
std::string* asked(FrameOptions& options, std::string_view axis);

inline constexpr int kMaxSide = 16384;

} // namespace scanout::frame
