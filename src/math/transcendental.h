// Our own sin, cos, atan2 ... : the same bits on every machine, because only IEEE + - * / sqrt and
// integer operations are used, in one written-out order. libm differs between versions and CPUs.
//
// Double precision, for cameras, models and tables. Measured against MPFR
// (tests/math/transcendental_test.cpp), greatest error in ulps of a normal result: 0.53 sin, cos,
// exp2, pow, sin_degrees, cos_degrees; 0.55 tan; 0.501 atan2, acos, log2, cbrt, radians, degrees.
// Subnormal results may round twice: 0.76. Exact results are exact (pow(3, 4), log2 of a power of
// two). Special values follow C99 Annex F unless a line says otherwise; every NaN is the same,
// positive one.
//
// Code in namespace scanout that writes sin(x) gets these, with or without <cmath>, and never a
// float version: the argument becomes double.
#pragma once

namespace scanout {

double sin(double radians); // |radians| <= 2^30, else NaN
double cos(double radians); // as sin
double tan(double radians); // as sin
double atan2(double y, double x);
double acos(double x); // NaN outside [-1, 1]
double exp2(double x);
double log2(double x);
double pow(double base, double exponent); // base < 0: NaN (unless exponent == 0); -0 counts as 0
double cbrt(double x);
double sqrt(double x); // IEEE, exact

double radians(double degrees);
double degrees(double radians);

// sin and cos of an angle in degrees, of any size: reduced in degrees without rounding, so exact at
// every multiple of 90 (zeros: sin's has the sign of the angle, cos's is +0). Infinity gives NaN.
double sin_degrees(double degrees);
double cos_degrees(double degrees);

} // namespace scanout
