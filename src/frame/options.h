// What the user can ask of a frame. One struct, from the command line to the plan.
#pragma once

#include "image/image.h"
#include "scene/light.h"
#include "scene/view.h"
#include "techniques.h"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::frame {

#define SCANOUT_ENUMERATOR(name) name,
enum class Cull : std::uint8_t { SCANOUT_CULL(SCANOUT_ENUMERATOR) };
#undef SCANOUT_ENUMERATOR

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
    // A technique by name for each axis that is asked (src/techniques.h): interpolate, texture,
    // wrap ...; "auto" lets the plan decide from the scene, and of aa `samples`.
#define SCANOUT_ASKED_asked(axis) std::string axis = "auto";
#define SCANOUT_ASKED_listed(axis)
#define SCANOUT_ASKED_planned(axis)
#define SCANOUT_ASKED(module, axis, LIST, Row, choice, help) SCANOUT_ASKED_##choice(axis)
    SCANOUT_AXES(SCANOUT_ASKED)
#undef SCANOUT_ASKED
#undef SCANOUT_ASKED_asked
#undef SCANOUT_ASKED_listed
#undef SCANOUT_ASKED_planned
    int shadow_size = 1024;                // texels a side of a shadow map
    int shadow_filter = 3;                 // texels a side that a filtered shadow asks
    std::optional<FilePlane> shadow_plane; // on which projected shadows fall; else on the ground
    std::vector<scene::Light> lights = scene::default_lights(); // at most scene::kMaxLights
    double alpha_cut = 0.5;      // least alpha that a cut-out surface shows
    int max_fragments = 1 << 16; // of a list of blended ones; what is drawn does not depend on it
    int bits = 8;                // of the narrowest channel of what shows the picture
    double exposure = 0;         // stops: light is multiplied by 2^exposure; within +-kMaxStops
    // Effects (rows of the plan) that are forced on or off; the others follow the scene.
    std::map<std::string, bool, std::less<>> effects;
    friend bool operator==(const FrameOptions&, const FrameOptions&) = default;
};

// An axis whose technique the user may ask for by name.
struct AskedAxis {
    std::string_view axis;
    std::string FrameOptions::*asked;
};
std::span<const AskedAxis> asked_axes(); // in the order of techniques.h

inline bool is_auto(std::string_view asked) {
    return asked == "auto";
}

// Asks for a technique on an axis, instead of what stands there; false for an axis without option.
bool ask(FrameOptions& options, std::string_view axis, std::string_view technique);
// What is asked for on an axis; "auto" where nothing is, or the axis has no option.
std::string asked_for(const FrameOptions& options, std::string_view axis);
std::string option_of(std::string_view axis); // the command line's name of it, without "--"

inline constexpr int kMinShadowSize = 64, kMaxShadowSize = 8192, kMaxShadowFilter = 15;
inline constexpr int kMaxSide = 16384;
inline constexpr double kMaxStops = 20;

} // namespace scanout::frame
