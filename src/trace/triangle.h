// The test that decides what a ray meets: watertight, in double, for rays of any length. Two
// triangles that share an edge compute the same number for it, so no ray passes between them.
// Woop, Benthin and Wald 2013.
#pragma once

#include "math/vec.h"

#include <array>
#include <cstdint>
#include <limits>

namespace scanout::trace {

inline constexpr std::uint32_t kNothing = 0xffffffff;

struct Ray {
    DVec3 from{0}, way{0, 0, -1}; // of any length but 0
};

struct Hit {
    double t = std::numeric_limits<double>::infinity(); // from + t * way
    std::uint32_t triangle = kNothing;
    std::array<double, 3> weight{}; // of the corners; their sum is 1
    bool any() const { return triangle != kNothing; }
    // Nearer; of two that are as near, the one with the lower number.
    bool before(const Hit& other) const {
        return t < other.t || (t == other.t && triangle < other.triangle);
    }
};

using Corners = std::array<DVec3, 3>;

// What is the same for all triangles that a ray is tested against.
class RayTest {
public:
    explicit RayTest(const Ray& ray);
    // Where the ray's line meets the triangle; t is infinite where it does not.
    Hit meets(const Corners& corners, std::uint32_t triangle) const;

private:
    DVec3 from_;
    int x_, y_, z_; // axes: the ray runs along z most
    double shear_x_, shear_y_, shear_z_;
};

} // namespace scanout::trace
