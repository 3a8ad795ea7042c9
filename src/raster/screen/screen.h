// The screen transform: from the mesh to the screen by transform, divide and snap. The mesh's float
// positions are transformed relative to the camera in double and rounded once more, to the 16.8
// grid (HARD-CASES R1-R3, R7-R9).
#pragma once

#include "math/vec.h"
#include "scene/view.h"

#include <cstdint>
#include <span>

namespace scanout::raster {

inline constexpr std::size_t kMaxVertices = std::size_t{1} << 29; // lanes index words in 31 bits
inline constexpr int kSubpixelBits = 8;
inline constexpr std::int32_t kSubpixel = 1 << kSubpixelBits;
inline constexpr double kGuardPixels = 32767; // vertices beyond it, |x| or |y|, are not snapped
inline constexpr double kMaxDepth = 0x1p64;   // z beyond it, in near_w, counts as not finite

// A vertex before the perspective divide. x and y are pixels times w (y down), depth is z / w.
struct ClipVertex {
    double x, y, z, w;
};

enum VertexFlags : std::uint32_t {
    kOutsideLeft = 1,
    kOutsideRight = 2,
    kOutsideTop = 4,
    kOutsideBottom = 8, // of the picture
    kOutsideNear = 16,
    kOutsideGuard = 32,
    kNotFinite = 64,
    kOutsideMask = 31,
    kNeedsClip = kOutsideNear | kOutsideGuard,
};

// A vertex on the screen. x, y in 1/256 pixel. A vertex that has no place there, or is not finite,
// has x = kOffScreen and its flags in y.
struct ScreenVertex {
    static constexpr std::int32_t kOffScreen = INT32_MIN;
    std::int32_t x = kOffScreen, y = 0;
    double depth = 0; // in (0, 1], greater is nearer

    bool on_screen() const { return x != kOffScreen; }
    std::uint32_t flags() const { return on_screen() ? 0U : static_cast<std::uint32_t>(y); }
};
static_assert(sizeof(ScreenVertex) == 16);

// The bounds of vertices on the screen: the near plane and the guard band (pixels). Triangles are
// cut at the near plane alone (raster/clipped/clipped_triangle.h), segments at all five planes.
struct ClipBox {
    double near_w;
    double left = -kGuardPixels, right = kGuardPixels, top = -kGuardPixels, bottom = kGuardPixels;
};

// The view's numbers, combined with the size of the picture. Lengths are in a unit near the size of
// the scene, a power of two of the view's: that changes no bit, and products of three coordinates
// stay in the range of a double at any scale of the model.
struct ScreenTransform {
    ScreenTransform(const scene::View& view, int width, int height);

    // Narrows the guard band to this many pixels around the picture. Shapes stay the same, except
    // for 1/256 pixel along edges to vertices that are no longer snapped (HARD-CASES P7).
    void set_guard(double pixels);

    ClipVertex to_clip(const Vec3& mesh_position) const;
    // The planes outside of which the vertex lies.
    std::uint32_t classify(const ClipVertex& vertex) const;
    // Divides and snaps. The vertex must be inside near plane and guard band; if rounding leaves it
    // just outside of the guard band, it is clamped to the edge.
    ScreenVertex to_screen(const ClipVertex& vertex) const;
    // to_clip, classify and to_screen in one step.
    ScreenVertex transform(const Vec3& mesh_position) const;

    double unit;         // lengths here are the view's lengths times this
    double linear[3][3]; // row major, mesh to view space
    double translation[3];
    bool perspective;
    double scale_x, scale_y;   // lengths to pixels at distance 1
    double centre_x, centre_y; // pixels
    double width, height;
    double depth_origin, depth_scale; // of parallel projections
    ClipBox box;
};

// ScreenTransform::transform of many vertices, in lanes.
void transform_vertices(const ScreenTransform& transform, std::span<const Vec3> positions,
                        std::span<ScreenVertex> out);

} // namespace scanout::raster
