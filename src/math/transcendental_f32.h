// Single precision transcendentals for the shading kernels, written over a lane type: F is float
// today, a vector of floats in the SIMD kernels; both must give the same bits, so each is a fixed
// sequence of float + - * / and integer bit operations, with no table and no branch on data.
//
// Errors (tests/math/transcendental_f32_test.cpp, against MPFR): log2 and exp2 below 2 ulp;
// pow(x, y) for x in [0, 1], y in [0, 10000]: absolute error below 2^-20.
#pragma once

namespace scanout {

float log2_f32(float x);          // x > 0, normal; smaller or negative x give -infinity
float exp2_f32(float x);          // below -126: 0; above 128: infinity
float pow_f32(float x, float y);  // x <= 0 gives 0, except y == 0, which gives 1

}  // namespace scanout
