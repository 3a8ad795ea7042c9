// Our own sin, cos, atan2 ... : the same bits on every machine, because only IEEE + - * / sqrt and
// integer operations are used, in one written-out order. libm differs between versions and CPUs.
//
// Double precision, for cameras, models and tables: error below 1 ulp of the result where |result|
// is normal (tests/math/transcendental_test.cpp holds each against MPFR and states the measured
// maximum). Special values follow C99 Annex F.
#pragma once

namespace scanout {

double sin(double radians);    // any finite argument up to 2^30 in magnitude; larger ones give NaN
double cos(double radians);    // as sin
double tan(double radians);    // as sin
double atan2(double y, double x);
double acos(double x);         // NaN outside [-1, 1]
double exp2(double x);
double log2(double x);
double pow(double base, double exponent);  // base >= 0, else NaN
double cbrt(double x);
double sqrt(double x);         // IEEE, exact

double radians(double degrees);
double degrees(double radians);

// sin and cos of an angle in degrees: exact at every multiple of 90.
double sin_degrees(double degrees);
double cos_degrees(double degrees);

}  // namespace scanout
