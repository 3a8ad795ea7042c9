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

// Kernels work on whole registers and may read and write this many lanes beyond the live ones; what
// stands there is finite.
inline constexpr int kRoom = kLanes + 16;

// What a stage reads: vertex attributes, and the ray from the eye.
struct Attributes {
    bool normal = false, uv = false, colour = false, ray = false;
};
constexpr Attributes operator|(Attributes a, Attributes b) {
    return {a.normal || b.normal, a.uv || b.uv, a.colour || b.colour, a.ray || b.ray};
}

// What all lanes of one triangle share, its vertices in canonical order.
struct Primitive {
    std::uint32_t id;
    // weight_i = a_i x + b_i y + c_i at a sample (x, y in 1/256 pixel): twice the area opposite
    // vertex i, whole numbers and exact, where the triangle was not clipped; else the row of
    // raster::HomogeneousTriangle. Inside, none is negative.
    double a[3], b[3], c[3];
    double least[3]; // a sample is covered where weight_i >= least_i: the top-left rule
    bool clipped;
    float inverse_w[3]; // of the vertices; 1 where it was clipped: those weights hold it already
    float facing[3];    // the triangle's own normal, towards the eye; object space
    // Of the three vertices; only what the frame's stages read.
    float normal[3][3], uv[2][3], colour[3][3]; // [component][vertex]; normals in object space
};

// Consecutive lanes of one triangle, whose pixels lie side by side.
struct Run {
    const Primitive* primitive;
    int first, count;    // lanes
    std::int32_t x, y;   // centre of the first pixel, 1/256 pixel
    std::int32_t dx, dy; // from the centre to the sample that is used where the triangle does
                         // not cover the centre; 0 when it always does
};

struct Block {
    int count = 0; // live lanes
    const scene::Material* material = nullptr;
    const scene::Texture* texture = nullptr; // the material's map_Kd, or null
    bool lit = true; // false: lines and points, drawn in their plain colour; there are no runs

    // Set by the gatherer.
    int runs = 0;
    Run run[kLanes];
    alignas(64) std::int32_t x[kRoom],
        y[kRoom]; // the sample that stands for the pixel, 1/256 pixel
    alignas(64) float ray_x[kRoom], ray_y[kRoom]; // its direction in view space: (x, y, -1)

    // Written by the interpolation stage.
    alignas(64) float normal[3][kRoom]; // unit, view space, on the side that the eye sees
    alignas(64) float u[kRoom], v[kRoom];

    // Kd, times vertex colour, times texture; and the result, linear light. Where the block is not
    // lit, the gatherer writes the albedo.
    alignas(64) float albedo[3][kRoom];
    alignas(64) float colour[3][kRoom];
};

// What all blocks of a frame share.
struct FrameState {
    float normal_matrix[3][3] = {}; // object -> view, row major
    bool orthographic = false;      // then every ray is (0, 0, -1)
    Attributes attributes;          // what this frame's plan reads
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
