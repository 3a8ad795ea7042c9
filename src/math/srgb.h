// sRGB (IEC 61966-2-1): linear light <-> 8-bit codes. Decode is the correctly rounded value of the
// formula; encode is the nearest code (0.5 code plus rounding of the thresholds; D3D allows 0.6).
#pragma once

#include <cstdint>

namespace scanout {

float srgb_decode(std::uint8_t code);        // linear light in [0, 1]; 0 -> 0 and 255 -> 1 exactly
std::uint8_t srgb_encode(float linear);      // clamps to [0, 1]; NaN gives 0; monotone

}  // namespace scanout
