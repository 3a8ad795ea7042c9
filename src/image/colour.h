// Colour spaces for overlays and metrics: HSV (Smith 1978) and CIELAB (CIE 2004) of linear light
// with sRGB's primaries and its white, D65. In double, by our own transcendentals: the same bits
// everywhere.
#pragma once

#include "image/image.h"
#include "math/vec.h"

namespace scanout::image {

// hue in degrees, [0, 360), 0 is red, 120 green; saturation and value in [0, 1]. Grey has hue 0,
// black has saturation 0, too.
struct Hsv {
    double hue, saturation, value;
};
// Red, green and blue in [0, 1], as they are shown (codes / 255).
Hsv to_hsv(const DVec3& rgb);
DVec3 from_hsv(const Hsv& hsv); // any hue: it is taken round the circle

// Linear light <-> XYZ (IEC 1999). White (1, 1, 1) is kWhite.
DVec3 to_xyz(const DVec3& linear);
DVec3 from_xyz(const DVec3& xyz);
extern const DVec3 kWhite;

// L in [0, 100] for colours between black and white; a towards red, b towards yellow. Negative
// light, which XYZ outside the gamut has, is allowed.
struct Lab {
    double lightness, a, b;
};
Lab to_lab(const DVec3& linear);
DVec3 from_lab(const Lab& lab);

// sRGB codes -> linear light; alpha is not looked at.
DVec3 linear_light(const Rgba8& pixel);

} // namespace scanout::image
