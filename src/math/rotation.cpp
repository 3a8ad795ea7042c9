#include "math/rotation.h"

#include "math/bits.h"
#include "math/transcendental.h"

namespace scanout {

// Constructors take columns.
DMat3 rotation_x(double degrees) {
    const double s = sin_degrees(degrees);
    const double c = cos_degrees(degrees);
    return DMat3(1, 0, 0, 0, c, s, 0, -s, c);
}

DMat3 rotation_y(double degrees) {
    const double s = sin_degrees(degrees);
    const double c = cos_degrees(degrees);
    return DMat3(c, 0, -s, 0, 1, 0, s, 0, c);
}

DMat3 rotation_z(double degrees) {
    const double s = sin_degrees(degrees);
    const double c = cos_degrees(degrees);
    return DMat3(c, s, 0, -s, c, 0, 0, 0, 1);
}

DMat3 rotation_about(const DVec3& u, double degrees) {
    const double s = sin_degrees(degrees), c = cos_degrees(degrees);
    const DMat3 cross(DVec3(0, u.z, -u.y), DVec3(-u.z, 0, u.x), DVec3(u.y, -u.x, 0));
    const DMat3 outer(u * u.x, u * u.y, u * u.z);
    return DMat3(c) + cross * s + outer * (1 - c);
}

DMat3 cofactor(const DMat3& m) {
    return DMat3(cross3(m[1], m[2]), cross3(m[2], m[0]), cross3(m[0], m[1]));
}

double determinant(const DMat3& m) {
    return dot3(m[0], cross3(m[1], m[2]));
}

double length(const DVec3& v) {
    return scanout::sqrt(dot3(v, v));
}

DVec3 normalized(const DVec3& v, const DVec3& fallback) {
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
        const double size = magnitude(v[i]);
        if (!(size < kInfinity)) return fallback;
        if (size > largest) largest = size;
    }
    if (largest == 0) return fallback;
    // Squares neither overflow nor vanish; a power of two changes no bit of the result.
    DVec3 scaled = v;
    if (largest > 0x1p500) scaled *= 0x1p-600;
    if (largest < 0x1p-500) scaled *= 0x1p600;
    const double length = sqrt(dot3(scaled, scaled));
    return DVec3(scaled.x / length, scaled.y / length, scaled.z / length);
}

} // namespace scanout
