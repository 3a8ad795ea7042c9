// The planes in which a mesh's triangles lie, as long as they are few: for flat parts a view's
// facts come from the planes, without a look at each triangle.
#pragma once

#include "math/vec.h"

#include <cstddef>
#include <vector>

namespace scanout::geom {

// The points of mesh coordinates with normal . p = offset; the normal is unit.
struct Plane {
    DVec3 normal{0};
    double offset = 0;
};

// The signed distance of a point (w = 1), above 0 on the plane's front; of a direction (w = 0) its
// component along the normal.
inline double height(const DVec4& point, const Plane& plane) {
    return dot3(plane.normal, DVec3(point)) - point.w * plane.offset;
}

class PlaneSet {
public:
    static constexpr std::size_t kMaxPlanes = 64;
    PlaneSet() = default;
    explicit PlaneSet(std::size_t most) : most_(most) {}
    // The plane through three points, towards the side from which they wind counter-clockwise;
    // without an area they have none. Planes a 2^-20th apart are one.
    void add(const DVec3& a, const DVec3& b, const DVec3& c);
    bool too_many() const { return too_many_; } // then none is kept
    const std::vector<Plane>& planes() const { return planes_; }

private:
    std::size_t most_ = kMaxPlanes;
    std::vector<Plane> planes_;
    bool too_many_ = false;
};

} // namespace scanout::geom
