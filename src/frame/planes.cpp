#include "frame/planes.h"

#include "math/transcendental.h"

#include <algorithm>
#include <cmath>

namespace scanout::frame {

void PlaneSet::add(const DVec3& a, const DVec3& b, const DVec3& c) {
    if (too_many_) return;
    const DVec3 n = cross3(b - a, c - a);
    const double square = dot3(n, n);
    if (!(square > 0)) return;
    const DVec3 unit = n / sqrt(square);
    const Plane plane{unit, dot3(unit, a)};
    constexpr double kSame = 0x1p-20;
    // Neighbours often share it: the last first.
    if (std::any_of(planes_.rbegin(), planes_.rend(), [&](const Plane& other) {
            return dot3(other.normal, unit) > 1 - kSame * kSame &&
                   std::abs(other.offset - plane.offset) < kSame;
        }))
        return;
    if (planes_.size() < kMost) {
        planes_.push_back(plane);
        return;
    }
    too_many_ = true;
    planes_ = {};
}

bool is_known(const scene::View& view) {
    return view.projection == scene::Projection::orthographic || view.near_distance > 0;
}

std::optional<DVec4> eye_of(const scene::View& view) {
    const DMat3& m = view.linear;
    const DVec3 rows[] = {cross3(m[1], m[2]), cross3(m[2], m[0]), cross3(m[0], m[1])};
    const double determinant = dot3(m[0], rows[0]);
    if (!(std::abs(determinant) > 0)) return std::nullopt;
    const bool everywhere = view.projection == scene::Projection::orthographic;
    const DVec3 at = everywhere ? DVec3(0, 0, 1) : -view.translation;
    return DVec4(dot3(rows[0], at) / determinant, dot3(rows[1], at) / determinant,
                 dot3(rows[2], at) / determinant, everywhere ? 0 : 1);
}

double height(const DVec4& eye, const Plane& plane) {
    return dot3(plane.normal, DVec3(eye)) - eye.w * plane.offset;
}

double slant(const Plane& plane, const scene::View& view, double farthest) {
    const DVec3 normal = view.normal * plane.normal;
    const double square = dot3(normal, normal);
    if (!(square > 0)) return INFINITY;
    const DVec3 unit = normal / sqrt(square);
    if (view.projection == scene::Projection::orthographic) return 1 / std::abs(unit.z);
    const DVec3 point = view.linear * (plane.normal * plane.offset) + view.translation;
    return std::max(farthest / std::abs(dot3(unit, point)), 1.0);
}

} // namespace scanout::frame
