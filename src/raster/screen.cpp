#include "raster/screen.h"

#include <cmath>

namespace scanout::raster {
namespace {

// To the grid: round to nearest, ties to even (the sum has no bits below 1). Saturates, and NaN
// becomes a number, so that no conversion is undefined (HARD-CASES R2).
std::int32_t snap(double pixels) {
    constexpr double kLimit = kGuardPixels * kSubpixel;
    double v = pixels * kSubpixel;
    v = v > -kLimit ? v : -kLimit;
    v = v < kLimit ? v : kLimit;
    return static_cast<std::int32_t>((v + 0x1.8p52) - 0x1.8p52);
}

} // namespace

ScreenTransform::ScreenTransform(const scene::View& view, int width, int height)
    : linear_(view.linear), translation_(view.translation),
      perspective_(view.projection == scene::Projection::perspective),
      scale_x_(width / (2 * view.half_width)), scale_y_(height / (2 * view.half_height)),
      centre_x_(width / 2.0), centre_y_(height / 2.0), width_(width), height_(height),
      near_w_(perspective_ ? view.near_distance : 0.5), depth_origin_(view.depth_origin),
      depth_scale_(view.depth_scale) {}

ClipVertex ScreenTransform::to_clip(const Vec3& p) const {
    const DVec3 position(p);
    const auto axis = [&](int r) {
        return ((linear_[0][r] * position.x + linear_[1][r] * position.y) +
                linear_[2][r] * position.z) +
               translation_[r];
    };
    const double x = axis(0), y = axis(1), z = axis(2);
    // Perspective: w is the distance along the view axis, depth = near / w. Orthographic: w is 1.
    const double w = perspective_ ? -z : 1.0;
    return {x * scale_x_ + w * centre_x_, w * centre_y_ - y * scale_y_,
            perspective_ ? near_w_ : (z - depth_origin_) * depth_scale_, w};
}

std::uint32_t ScreenTransform::classify(const ClipVertex& v) const {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.w) || !std::isfinite(v.z))
        return kNotFinite;
    std::uint32_t flags = 0;
    // Half-spaces in homogeneous coordinates: right for every sign of w.
    if (v.x < 0) flags |= kOutsideLeft;
    if (v.x > width_ * v.w) flags |= kOutsideRight;
    if (v.y < 0) flags |= kOutsideTop;
    if (v.y > height_ * v.w) flags |= kOutsideBottom;
    if (v.w < near_w_) flags |= kOutsideNear;
    const double guard = kGuardPixels * v.w;
    if (v.x < -guard || v.x > guard || v.y < -guard || v.y > guard) flags |= kOutsideGuard;
    return flags;
}

ScreenVertex ScreenTransform::to_screen(const ClipVertex& v) const {
    ScreenVertex out;
    out.x = snap(v.x / v.w);
    out.y = snap(v.y / v.w);
    out.depth = v.z / v.w;
    out.inverse_w = static_cast<float>(near_w_ / v.w);
    return out;
}

void transform_vertices(const ScreenTransform& transform, std::span<const Vec3> positions,
                        std::span<ScreenVertex> out) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const ClipVertex clip = transform.to_clip(positions[i]);
        const std::uint32_t flags = transform.classify(clip);
        if ((flags & (kNeedsClip | kNotFinite)) == 0)
            out[i] = transform.to_screen(clip);
        else
            out[i] = ScreenVertex();
        out[i].flags = flags;
    }
}

} // namespace scanout::raster
