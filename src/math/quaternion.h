// Rotations as unit quaternions x, y, z, w, in the order of glTF; in double, without libm.
// Shoemake 1985.
#pragma once

#include "math/vec.h"

namespace scanout {

inline constexpr DVec4 kNoTurn{0, 0, 0, 1};

// One fixed order of additions.
inline double dot4(const DVec4& a, const DVec4& b) {
    return (a.x * b.x + a.y * b.y) + (a.z * b.z + a.w * b.w);
}

// q / |q|; of length 0, and of numbers that are not finite, the quaternion that turns nothing.
DVec4 unit_quaternion(const DVec4& q);

// The way from a to b (both unit) by equal angles: a at u = 0, the rotation of b at u = 1. Of the
// two ways the shorter one: b and -b are the same rotation. Within 2^-50 of the exact value, and
// of unit length, however near to each other they are.
DVec4 slerp(const DVec4& a, const DVec4& b, double u);

DMat3 matrix_of(const DVec4& unit);
// rotation_z * rotation_y * rotation_x.
DVec4 quaternion_of_degrees(const DVec3& about_x_y_z);

} // namespace scanout
