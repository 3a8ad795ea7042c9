// The planes in which triangles lie, while they are few: of flat things a view tells much without
// looking at each triangle.
#pragma once

#include "math/vec.h"
#include "scene/view.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace scanout::frame {

// The points of mesh coordinates with normal . p = offset; the normal is unit.
struct Plane {
    DVec3 normal{0};
    double offset = 0;
};

class PlaneSet {
public:
    static constexpr std::size_t kMost = 64;
    // The plane through three points, towards the side from which they wind counter-clockwise;
    // without an area they have none. Planes a 2^-20th apart are one.
    void add(const DVec3& a, const DVec3& b, const DVec3& c);
    bool too_many() const { return too_many_; } // then none is kept
    const std::vector<Plane>& planes() const { return planes_; }

private:
    std::vector<Plane> planes_;
    bool too_many_ = false;
};

// A view without a near plane, as of a plan that knows none, is anywhere.
bool is_known(const scene::View& view);
// The eye in mesh coordinates; w is 0 in an orthographic view, whose eye is a direction. Nothing
// where the model is flattened.
std::optional<DVec4> eye_of(const scene::View& view);
// Above 0: the eye sees the plane's front.
double height(const DVec4& eye, const Plane& plane);
// How much more of its plane a pixel spans than where the plane faces the eye: 1 / cos of the angle
// between ray and normal, at most over points no farther than `farthest` (view space) from the eye.
double slant(const Plane& plane, const scene::View& view, double farthest);

} // namespace scanout::frame
