// Rotation matrices from angles in degrees, in double; exact at multiples of 90 degrees.
// Right-handed: a positive angle turns counter-clockwise when the axis points at the eye.
#pragma once

#include "math/vec.h"

namespace scanout {

DMat3 rotation_x(double degrees);
DMat3 rotation_y(double degrees);
DMat3 rotation_z(double degrees);
// About an axis of length 1, by Rodrigues' formula.
DMat3 rotation_about(const DVec3& axis, double degrees);

// The cofactor matrix: transforms normals as the inverse transpose does, but stays finite for
// singular matrices (times det, so its sign flips for mirrored ones).
DMat3 cofactor(const DMat3& m);

double determinant(const DMat3& m);

// |v|, of lengths whose square neither overflows nor underflows.
double length(const DVec3& v);
// v / |v|; a zero, NaN or infinite vector gives `fallback`.
DVec3 normalized(const DVec3& v, const DVec3& fallback = DVec3(0, 0, 1));

} // namespace scanout
