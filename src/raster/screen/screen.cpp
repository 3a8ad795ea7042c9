#include "raster/screen/screen.h"

#include "math/bits.h"
#include "raster/check_lanes.h"

#include <algorithm>
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

// The exponent that brings the largest length of a view to [1, 2).
int to_one(const scene::View& view) {
    double largest = 0;
    for (int r = 0; r < 3; ++r) {
        largest = std::max(largest, std::abs(view.translation[r]));
        for (int c = 0; c < 3; ++c)
            largest = std::max(largest, std::abs(view.linear[c][r]));
    }
    return largest > 0 && std::isfinite(largest) ? -decompose(largest).exponent : 0;
}

} // namespace

ScreenTransform::ScreenTransform(const scene::View& view, int w, int h)
    : unit(), linear(), translation(),
      perspective(view.projection == scene::Projection::perspective),
      scale_x(w / (2 * view.half_width)), scale_y(h / (2 * view.half_height)),
      centre_x(w / 2.0 - view.middle.x * scale_x), centre_y(h / 2.0 + view.middle.y * scale_y),
      width(w), height(h), depth_origin(), depth_scale(), box{} {
    const int exponent = to_one(view);
    unit = scale(1, exponent);
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c)
            linear[r][c] = scale(view.linear[c][r], exponent);
        translation[r] = scale(view.translation[r], exponent);
    }
    depth_origin = scale(view.depth_origin, exponent);
    depth_scale = scale(view.depth_scale, -exponent);
    box.near_w = perspective ? scale(view.near_distance, exponent) : 0.5;
    if (!perspective) { // else the extent is that at distance 1, an angle
        scale_x = scale(scale_x, -exponent);
        scale_y = scale(scale_y, -exponent);
    }
}

void ScreenTransform::set_guard(double pixels) {
    box.left = std::max(-pixels, -kGuardPixels);
    box.top = box.left;
    box.right = std::min(width + pixels, kGuardPixels);
    box.bottom = std::min(height + pixels, kGuardPixels);
}

ClipVertex ScreenTransform::to_clip(const Vec3& p) const {
    const DVec3 position(p);
    const auto axis = [&](const double(&row)[3], double offset) {
        return ((row[0] * position.x + row[1] * position.y) + row[2] * position.z) + offset;
    };
    const double x = axis(linear[0], translation[0]), y = axis(linear[1], translation[1]),
                 z = axis(linear[2], translation[2]);
    // Perspective: w is the distance along the view axis, depth = near / w. Orthographic: w is 1.
    const double w = perspective ? -z : 1.0;
    return {x * scale_x + w * centre_x, w * centre_y - y * scale_y,
            perspective ? box.near_w : (z - depth_origin) * depth_scale, w};
}

std::uint32_t ScreenTransform::classify(const ClipVertex& v) const {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.w) ||
        !(std::abs(v.z) <= kMaxDepth * box.near_w))
        return kNotFinite;
    std::uint32_t flags = 0;
    // Half-spaces in homogeneous coordinates: right for every sign of w.
    if (v.x < 0) flags |= kOutsideLeft;
    if (v.x > width * v.w) flags |= kOutsideRight;
    if (v.y < 0) flags |= kOutsideTop;
    if (v.y > height * v.w) flags |= kOutsideBottom;
    if (v.w < box.near_w) flags |= kOutsideNear;
    if (v.x < box.left * v.w || v.x > box.right * v.w || v.y < box.top * v.w ||
        v.y > box.bottom * v.w)
        flags |= kOutsideGuard;
    return flags;
}

ScreenVertex ScreenTransform::to_screen(const ClipVertex& v) const {
    return {snap(v.x / v.w), snap(v.y / v.w), v.z / v.w};
}

ScreenVertex ScreenTransform::transform(const Vec3& position) const {
    const ClipVertex clip = to_clip(position);
    const std::uint32_t flags = classify(clip);
    if ((flags & (kNeedsClip | kNotFinite)) == 0) {
        check_before_snap(clip, 0);
        return to_screen(clip);
    }
    return {ScreenVertex::kOffScreen, static_cast<std::int32_t>(flags), 0};
}

} // namespace scanout::raster
