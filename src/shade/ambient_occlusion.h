// Ambient occlusion in screen space (axis `ambient_occlusion`): how much of the light from
// everywhere reaches a surface, past other surfaces nearby. Its parts: the frame's pass, which
// finds what the centre of each pixel shows before anything is shaded
// (frame/pass/ambient_occlusion.h); the horizons around each of these places and the blur
// (ambient_occlusion/horizon.h, blur.h); and the stage that takes from the light (attenuate.h).
//
// It means what Zhukov, Iones and Kronin 1998 call obscurance: the share of the light, weighted by
// the cosine to the face's own normal, that is not hidden; what hides at the distance d counts
// 1 - (d / radius)^2, and nothing beyond the radius.
#pragma once

#include "math/vec.h"
#include "shade/stage.h"

#include <cstdint>

namespace scanout::shade {

struct OcclusionTraits {
    int directions = 0; // around a pixel, on the screen, in opposite pairs; 0: none
    int steps = 0;      // places that a pixel looks at in each
};
struct AmbientOcclusion : Stage, OcclusionTraits {};

inline constexpr double kOcclusionRadius = 0.25; // of the model's own
inline constexpr int kMaxDirections = 16;

// What the centres of a picture's pixels show. Lengths are in view space, times scene::to_floats.
// A row has `stride` pixels, kBeside more than the picture at least, and as many stand before the
// first row: those show nothing.
struct SurfaceImage {
    static constexpr float kNowhere = 0x1p50F; // distance where nothing is seen
    static constexpr int kBeside = 16;         // a register

    int width = 0, height = 0, stride = 0;
    const float* distance = nullptr;         // from the eye's plane
    const std::uint32_t* triangle = nullptr; // 0 where nothing is seen
    const float* normal = nullptr;           // of each triangle: x, y, z; object space, any length
    float normal_matrix[3][3] = {};          // object -> view, row major
    bool orthographic = false;
    // A pixel's ray, (x, y, -1) times the distance; orthographic: its place, (x, y).
    float scale_x = 0, offset_x = 0, scale_y = 0, offset_y = 0;
    float radius = 0;
};

// The share of the light from everywhere that reaches each pixel.
struct OcclusionImage {
    int width = 0, height = 0, stride = 0;
    const float* distance = nullptr; // of SurfaceImage
    const float* open = nullptr;     // 0 to 1
    float apart = 0;                 // surfaces of one pixel that are so far apart are two
};

} // namespace scanout::shade
