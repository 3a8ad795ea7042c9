// From the mesh to the screen: transform, divide, snap. Positions are relative to the camera in
// double; the only rounding of a position is the one to the 16.8 grid (HARD-CASES R1-R3, R7-R9).
#pragma once

#include "math/vec.h"
#include "scene/view.h"

#include <cstdint>
#include <span>

namespace scanout::raster {

inline constexpr int kSubpixelBits = 8;
inline constexpr std::int32_t kSubpixel = 1 << kSubpixelBits;
inline constexpr double kGuardPixels = 32767; // |x|, |y| beyond it are clipped away

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

// A vertex on the screen. x, y in 1/256 pixel; both are 0 when the vertex needs clipping.
struct ScreenVertex {
    std::int32_t x = 0, y = 0;
    double depth = 0;    // in (0, 1], greater is nearer
    float inverse_w = 0; // near w / w, in (0, 1] at every size of scene, for interpolation
    std::uint32_t flags = 0;
};

// The view's numbers with the size of the picture folded in.
class ScreenTransform {
public:
    ScreenTransform(const scene::View& view, int width, int height);

    ClipVertex to_clip(const Vec3& mesh_position) const;
    // Which planes the vertex is outside of.
    std::uint32_t classify(const ClipVertex& vertex) const;
    // Divide and snap; the vertex must be inside near and guard band (what rounding leaves outside
    // the guard band comes back to its edge).
    ScreenVertex to_screen(const ClipVertex& vertex) const;

    double near_w() const { return near_w_; }

private:
    DMat3 linear_;
    DVec3 translation_;
    bool perspective_;
    double scale_x_, scale_y_;   // view units to pixels at distance 1
    double centre_x_, centre_y_; // pixels
    double width_, height_;
    double near_w_;
    double depth_origin_, depth_scale_;
};

void transform_vertices(const ScreenTransform& transform, std::span<const Vec3> positions,
                        std::span<ScreenVertex> out);

} // namespace scanout::raster
