#include "geom/planes.h"

#include "math/transcendental.h"

#include <algorithm>
#include <cmath>

namespace scanout::geom {

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
    if (planes_.size() < most_) {
        planes_.push_back(plane);
        return;
    }
    too_many_ = true;
    planes_ = {};
}

} // namespace scanout::geom
