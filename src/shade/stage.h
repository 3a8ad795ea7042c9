// The shading stages: each works through a block of up to 128 visible pixels ("lanes") that share a
// material, whatever triangles they come from. The plan picks one stage an axis; stages add up
// instead of multiplying. Structure of arrays, single precision, one operation sequence a lane.
#pragma once

#include "math/vec.h"
#include "scene/light.h"
#include "scene/material.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace scanout::shade {

inline constexpr int kLanes = 128;

// Which vertex attributes a stage reads.
struct Attributes {
    bool normal = false, uv = false, colour = false;
};
constexpr Attributes operator|(Attributes a, Attributes b) {
    return {a.normal || b.normal, a.uv || b.uv, a.colour || b.colour};
}

struct Block {
    int count = 0; // live lanes
    const scene::Material* material = nullptr;
    const scene::Texture* texture = nullptr; // the material's map_Kd, or null

    // Set by the gatherer, one a lane: the vertices of the primitive, and the weights of the sample
    // that stands for the pixel: b_i is proportional to the area opposite vertex i on the screen,
    // and not negative, because the sample lies inside.
    std::uint32_t vertex[3][kLanes];
    float area[3][kLanes];
    float inverse_w[3][kLanes];         // 1 / w of the three vertices
    float ray_x[kLanes], ray_y[kLanes]; // view-space direction of the sample: (x, y, -1)
    float facing[3][kLanes];            // the triangle's own normal, towards the eye; object space
    bool lit = true;                    // false: lines and points, drawn in their plain colour

    // Written by the interpolation stage.
    float weight1[kLanes], weight2[kLanes]; // perspective-correct weights of vertices 1 and 2
    float normal[3][kLanes];                // unit, view space, on the side that the eye sees
    float u[kLanes], v[kLanes];

    // Kd, times vertex colour, times texture; and the result, linear light.
    float albedo[3][kLanes];
    float colour[3][kLanes];
};

// What all blocks of a frame share.
struct FrameState {
    std::span<const Vec3> normal; // mesh attributes, object space
    std::span<const Vec2> uv;
    std::span<const Vec3> colour;
    float normal_matrix[3][3] = {}; // object -> view, row major
    bool orthographic = false;      // then every ray is (0, 0, -1)
    Attributes attributes;          // what this frame's plan fetches
    std::span<const scene::Light> lights;
};

// What a technique says about itself.
enum class Kind : std::uint8_t {
    rung,   // has an error against the reference; ordered
    effect, // its neutral element changes no bit
    model   // a choice; not ordered
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
const Stage* find(std::string_view axis, std::string_view name); // null when there is none

} // namespace scanout::shade
