// Robust geometric predicates. Shewchuk 1997: a floating-point filter, then exact expansion
// arithmetic.
#pragma once

#include "math/vec.h"

namespace scanout {

// The sign of twice the signed area of (a, b, c), exactly: > 0 when counter-clockwise (y up),
// 0 when collinear. Exact for all finite inputs whose products neither overflow nor underflow.
int orient2d(const DVec2& a, const DVec2& b, const DVec2& c);

} // namespace scanout
