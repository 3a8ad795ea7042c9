#include "image/colour.h"

#include "math/srgb.h"
#include "math/transcendental.h"

#include <algorithm>

namespace scanout::image {

Hsv to_hsv(const DVec3& rgb) {
    const double value = std::max({rgb.x, rgb.y, rgb.z});
    const double chroma = value - std::min({rgb.x, rgb.y, rgb.z});
    if (value <= 0 || chroma <= 0) return {0, 0, value};
    double sextant; // [0, 6)
    if (value == rgb.x)
        sextant = (rgb.y - rgb.z) / chroma + (rgb.y < rgb.z ? 6 : 0);
    else if (value == rgb.y)
        sextant = (rgb.z - rgb.x) / chroma + 2;
    else
        sextant = (rgb.x - rgb.y) / chroma + 4;
    const double hue = 60 * sextant;
    return {hue < 360 ? hue : 0, chroma / value, value}; // red with a trace of blue rounds to 360
}

DVec3 from_hsv(const Hsv& hsv) {
    // A channel is full within 60 degrees of its own hue and gone beyond 120.
    const auto channel = [&](double own) {
        double apart = (hsv.hue - own) / 360;
        apart -= static_cast<double>(static_cast<long long>(apart)); // (-1, 1)
        const double near = std::min(apart < 0 ? -apart : apart, 1 - (apart < 0 ? -apart : apart));
        const double share = std::clamp(2 - 6 * near, 0.0, 1.0);
        return hsv.value * (1 - hsv.saturation * (1 - share));
    };
    return {channel(0), channel(120), channel(240)};
}

// The primaries x, y = (0.64, 0.33), (0.30, 0.60), (0.15, 0.06) and the white (0.3127, 0.3290) in
// whole numbers, so that the inverse below is one to the last bits.
constexpr double kToXyz[3][3] = {
    {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
    {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
    {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};

const DVec3 kWhite{23359437.0 / 24577794, 1.0, 80288307.0 / 73733382};

static double row(const double (&m)[3], const DVec3& v) {
    return (m[0] * v.x + m[1] * v.y) + m[2] * v.z;
}

DVec3 to_xyz(const DVec3& linear) {
    return {row(kToXyz[0], linear), row(kToXyz[1], linear), row(kToXyz[2], linear)};
}

DVec3 from_xyz(const DVec3& xyz) {
    // The inverse by cofactors; the compiler folds it.
    const auto& m = kToXyz;
    const double c00 = m[1][1] * m[2][2] - m[1][2] * m[2][1];
    const double c01 = m[1][2] * m[2][0] - m[1][0] * m[2][2];
    const double c02 = m[1][0] * m[2][1] - m[1][1] * m[2][0];
    const double determinant = (m[0][0] * c00 + m[0][1] * c01) + m[0][2] * c02;
    const double inverse[3][3] = {
        {c00, m[0][2] * m[2][1] - m[0][1] * m[2][2], m[0][1] * m[1][2] - m[0][2] * m[1][1]},
        {c01, m[0][0] * m[2][2] - m[0][2] * m[2][0], m[0][2] * m[1][0] - m[0][0] * m[1][2]},
        {c02, m[0][1] * m[2][0] - m[0][0] * m[2][1], m[0][0] * m[1][1] - m[0][1] * m[1][0]}};
    return DVec3(row(inverse[0], xyz), row(inverse[1], xyz), row(inverse[2], xyz)) / determinant;
}

// CIE's cube root with a straight start: 6/29 is where the two meet with the same slope.
constexpr double kBend = 6.0 / 29;

static double compressed(double t) {
    return t > kBend * kBend * kBend ? cbrt(t) : t / (3 * kBend * kBend) + 4.0 / 29;
}
static double expanded(double f) {
    return f > kBend ? f * f * f : (f - 4.0 / 29) * (3 * kBend * kBend);
}

Lab to_lab(const DVec3& linear) {
    const DVec3 ratio = to_xyz(linear) / kWhite;
    const double x = compressed(ratio.x), y = compressed(ratio.y), z = compressed(ratio.z);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

DVec3 from_lab(const Lab& lab) {
    const double y = (lab.lightness + 16) / 116, x = y + lab.a / 500, z = y - lab.b / 200;
    return from_xyz(DVec3(expanded(x), expanded(y), expanded(z)) * kWhite);
}

DVec3 linear_light(const Rgba8& p) {
    return {srgb_decode(p.r), srgb_decode(p.g), srgb_decode(p.b)};
}

} // namespace scanout::image
