// The shading stages: each works through a block of up to 128 visible pixels ("lanes") that share a
// material, whatever triangles they come from. The plan picks one stage an axis; stages add up
// instead of multiplying. Structure of arrays, single precision, one operation sequence a lane.
#pragma once

#include "scene/light.h"
#include "scene/material.h"
#include "math/vec.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace scanout::shade {

inline constexpr int kLanes = 128;

// Which vertex attributes a plan's stages read.
struct Attributes {
    bool normal = false, uv = false, colour = false;
};

struct Block {
    int count = 0;  // live lanes
    const scene::Material* material = nullptr;
    const scene::Texture* texture = nullptr;  // the material's map_Kd, or null

    // Set by the gatherer, one a lane: the vertices of the primitive, and the exact weights of the
    // sample that stands for the pixel (not yet perspective-correct: b_i is proportional to the area
    // opposite vertex i on the screen).
    std::uint32_t vertex[3][kLanes];
    float area[3][kLanes];       // b_i, any common scale
    float inverse_w[3][kLanes];  // 1 / w of the three vertices (1 in orthographic views)
    float ray_x[kLanes], ray_y[kLanes];  // view-space direction of the sample: (x, y, -1)
    bool lit[kLanes];            // false: lines and points, drawn in their plain colour

    // Written by the interpolation stage.
    float weight1[kLanes], weight2[kLanes];  // perspective-correct weights of vertices 1 and 2
    float normal[3][kLanes];     // unit, view space, towards the eye
    float view[3][kLanes];       // unit, from the surface to the eye
    float u[kLanes], v[kLanes];

    float albedo[3][kLanes];     // Kd, times vertex colour, times texture
    float colour[3][kLanes];     // out: linear light
};

// What all blocks of a frame share.
struct FrameState {
    std::span<const Vec3> normal;  // mesh attributes, object space
    std::span<const Vec2> uv;
    std::span<const Vec3> colour;
    float normal_matrix[3][3] = {};  // object -> view, row major
    bool orthographic = false;
    bool two_sided = true;           // normals are turned towards the eye
    std::span<const scene::Light> lights;
};

// What a technique says about itself.
enum class Kind : std::uint8_t {
    rung,    // has an error against the reference; ordered
    effect,  // its neutral element changes no bit
    model    // a choice; not ordered
};
struct Card {
    std::string_view axis, name, blurb, source;
    Kind kind = Kind::model;
    Attributes needs;
};
struct Stage {
    Card card;
    void (*run)(Block& block, const FrameState& frame);
};

// Every stage there is, in the order of techniques.h.
std::span<const Stage* const> catalogue();
const Stage* find(std::string_view axis, std::string_view name);  // null when there is none

}  // namespace scanout::shade
