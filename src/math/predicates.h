// Robust geometric predicates. Shewchuk 1997: a floating-point filter, then exact expansion
// arithmetic.
#pragma once

#include "math/vec.h"

namespace scanout {

// The sign of twice the signed area of (a, b, c), exactly: > 0 when counter-clockwise (y up),
// 0 when collinear. Exact for all finite inputs whose products neither overflow nor underflow.
int orient2d(const DVec2& a, const DVec2& b, const DVec2& c);

// The sign of six times the signed volume of (a, b, c, d), exactly: > 0 when a, b, c wind clockwise
// seen from d, 0 when coplanar. Exact for all finite inputs whose products neither overflow nor
// underflow.
int orient3d(const DVec3& a, const DVec3& b, const DVec3& c, const DVec3& d);

// The sign of dot(normal, p) - offset, exactly: > 0 in front of the plane, 0 on it. Exact for all
// finite inputs whose products neither overflow nor underflow.
int side_of_plane(const DVec3& normal, double offset, const DVec3& p);

} // namespace scanout
