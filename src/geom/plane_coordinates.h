// The points of a plane by two of their coordinates.
#pragma once

#include "math/vec.h"

#include <cmath>
#include <utility>

namespace scanout::geom {

// Leaves out the largest axis of the plane's normal, so that no area vanishes; the other two stand
// in the order in which what is counter-clockwise from the plane's front stays so.
class PlaneCoordinates {
public:
    explicit PlaneCoordinates(const DVec3& normal) {
        const DVec3 size(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
        const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
        u_ = (axis + 1) % 3;
        v_ = (axis + 2) % 3;
        if (normal[axis] < 0) std::swap(u_, v_);
    }
    DVec2 operator()(const DVec3& p) const { return {p[u_], p[v_]}; }

private:
    int u_, v_;
};

} // namespace scanout::geom
