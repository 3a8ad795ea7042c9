// What the user can ask of a frame. One struct, from the command line to the plan.
#pragma once

#include "image/image.h"
#include "scene/light.h"
#include "scene/view.h"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::frame {

enum class Cull : std::uint8_t { none, back, front }; // in the order of techniques.h

// The points of the file's space with normal . p = offset. The normal is not 0, of any length.
struct FilePlane {
    DVec3 normal{0};
    double offset = 0;
    friend bool operator==(const FilePlane&, const FilePlane&) = default;
};

struct FrameOptions {
    int width = 1280, height = 720;
    int samples = 1; // a pixel: 1, 2, 4, 8, 16
    Cull cull = Cull::none;
    image::Rgba8 background{48, 51, 56, 255};
    // Techniques by name (`scanout list techniques`); "auto" lets the plan decide from the scene.
    std::string interpolate = "auto";
    std::string texture = "auto";
    std::string wrap = "auto";
    std::string source = "auto", mapping = "auto";
    std::string reflection = "auto";
    std::string shading = "auto";
    std::string shadow = "auto";
    int shadow_size = 1024;                // texels a side of a shadow map
    int shadow_filter = 3;                 // texels a side that a filtered shadow asks
    std::optional<FilePlane> shadow_plane; // on which projected shadows fall; else on the ground
    std::vector<scene::Light> lights = scene::default_lights(); // at most scene::kMaxLights
    std::string transparency = "auto";
    std::string blend = "auto";      // over
    std::string depth = "auto";      // reversed
    std::string depth_test = "auto"; // greater
    std::string stencil = "auto";    // none
    double alpha_cut = 0.5;          // least alpha that a cut-out surface shows
    int most_fragments = 1 << 16; // of a list of blended ones; what is drawn does not depend on it
    std::string aa = "auto";      // then `samples` says it
    std::string tone = "auto";
    std::string blend_space = "auto";
    std::string encode = "auto";
    std::string dither = "auto";      // then none, or bayer where colours have fewer than 8 bits
    int bits = 8;                     // of the narrowest channel of what shows the picture
    std::string convolution = "auto"; // then none
    double exposure = 0; // stops: light is multiplied by 2^exposure; within +-kMaxStops
    // Effects (rows of the plan) that are forced on or off; the others follow the scene.
    std::map<std::string, bool, std::less<>> effects;
    friend bool operator==(const FrameOptions&, const FrameOptions&) = default;
};

// Asks for a technique on an axis, instead of what stands there; false for an axis without option.
bool ask(FrameOptions& options, std::string_view axis, std::string_view technique);
// What is asked for on an axis; "auto" where nothing is, or the axis has no option.
std::string asked_for(const FrameOptions& options, std::string_view axis);
std::string option_of(std::string_view axis); // the command line's name of it, without "--"

inline constexpr int kMinShadowSize = 64, kMaxShadowSize = 8192, kMaxShadowFilter = 15;
inline constexpr int kMaxSide = 16384;
inline constexpr double kMaxStops = 20;

} // namespace scanout::frame
