// The options of a frame that the user can set: one struct, from the command line to the plan.
#pragma once

#include "frame/annotation.h"
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
    int samples = 1;           // a pixel: 1, 2, 4, 8, 16
    bool samples_asked = true; // false: a default, of which nobody is told that it changes nothing
    Cull cull = Cull::material;
    image::Rgba8 background{48, 51, 56, 255};
    // A technique by name for each axis that is asked (src/techniques.h): interpolate, texture,
    // wrap ...; "auto" lets the plan decide from the scene; for aa, `samples` does.
#define SCANOUT_ASKED_asked(axis) std::string axis = "auto";
#define SCANOUT_ASKED_listed(axis)
#define SCANOUT_ASKED_planned(axis)
#define SCANOUT_ASKED(module, axis, LIST, Row, choice, help) SCANOUT_ASKED_##choice(axis)
    SCANOUT_AXES(SCANOUT_ASKED)
#undef SCANOUT_ASKED
#undef SCANOUT_ASKED_asked
#undef SCANOUT_ASKED_listed
#undef SCANOUT_ASKED_planned
    int shadow_size = 1024;                // side of a shadow map, texels
    int shadow_filter = 3;                 // side of a filtered shadow's kernel, texels
    std::optional<FilePlane> shadow_plane; // receives projected shadows; none: the ground
    std::vector<scene::Light> lights = scene::plain_lights(); // at most scene::kMaxLights
    double edge_angle = 30; // degrees: a bend of more is a feature edge
    Annotations annotations;
    int line_width = 1; // of lines and edges, pixels
    int point_size = 1;
    double alpha_cut = 0.5;      // a cut-out surface shows where alpha is at least this
    int max_fragments = 1 << 16; // limit of a list of blended ones; changes no bit of the picture
    int bits = 8;                // bits of the narrowest channel of the display or file
    double exposure = 0;         // stops: light is multiplied by 2^exposure; within +-kMaxStops
    // Effects (rows of the plan) that the user forces on or off; the others follow the scene.
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

// Sets the technique of an axis by name; returns false for an axis that is no option.
bool ask(FrameOptions& options, std::string_view axis, std::string_view technique);
// The technique asked for on an axis; "auto" where none is, or where the axis is no option.
std::string asked_for(const FrameOptions& options, std::string_view axis);
std::string option_of(std::string_view axis); // the command line's name of it, without "--"

inline constexpr int kMinShadowSize = 64, kMaxShadowSize = 8192, kMaxShadowFilter = 15;
inline constexpr int kMaxSide = 16384;
inline constexpr int kMaxLineWidth = 64; // and size of a point, pixels
inline constexpr double kMaxStops = 20;

} // namespace scanout::frame
