#include "math/quaternion.h"

#include "math/bits.h"
#include "math/transcendental.h"

namespace scanout {
namespace {

// a, then b.
DVec4 product(const DVec4& b, const DVec4& a) {
    const DVec3 v(b.x, b.y, b.z), w(a.x, a.y, a.z);
    const DVec3 u = (w * b.w + v * a.w) + cross3(v, w);
    return {u.x, u.y, u.z, b.w * a.w - dot3(v, w)};
}

double length4(const DVec4& q) {
    return scanout::sqrt(dot4(q, q));
}

} // namespace

DVec4 unit_quaternion(const DVec4& q) {
    double largest = 0;
    for (int i = 0; i < 4; ++i) {
        if (!(magnitude(q[i]) < kInfinity)) return kNoTurn;
        if (magnitude(q[i]) > largest) largest = magnitude(q[i]);
    }
    if (largest == 0) return kNoTurn;
    // Squares neither overflow nor vanish; a power of two changes no bit of the result.
    const int exponent = decompose(largest).exponent;
    DVec4 scaled;
    for (int i = 0; i < 4; ++i)
        scaled[i] = scale(q[i], -exponent);
    const double length = length4(scaled);
    return {scaled.x / length, scaled.y / length, scaled.z / length, scaled.w / length};
}

DVec4 slerp(const DVec4& a, const DVec4& b, double u) {
    const DVec4 to = dot4(a, b) < 0 ? -b : b;
    // Half the angle between them by the lengths of their difference and sum: near to 0 the cosine
    // that the usual way takes the angle from is 1 or, by rounding, above it.
    const double angle = 2 * scanout::atan2(length4(to - a), length4(to + a));
    const double whole = scanout::sin(angle);
    if (whole == 0) return a;
    return a * (scanout::sin((1 - u) * angle) / whole) + to * (scanout::sin(u * angle) / whole);
}

DMat3 matrix_of(const DVec4& q) {
    const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
    const double xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
    const double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    return DMat3(1 - 2 * (yy + zz), 2 * (xy + wz), 2 * (xz - wy), // columns
                 2 * (xy - wz), 1 - 2 * (xx + zz), 2 * (yz + wx), 2 * (xz + wy), 2 * (yz - wx),
                 1 - 2 * (xx + yy));
}

DVec4 quaternion_of_degrees(const DVec3& about) {
    const DVec3 half = about / 2.0;
    const DVec4 x(sin_degrees(half.x), 0, 0, cos_degrees(half.x));
    const DVec4 y(0, sin_degrees(half.y), 0, cos_degrees(half.y));
    const DVec4 z(0, 0, sin_degrees(half.z), cos_degrees(half.z));
    return product(z, product(y, x));
}

} // namespace scanout
