// From light to codes, in double: tone curve and encoding. Samples are mixed as light.
#pragma once

#include <string_view>

namespace scanout::trace {

// Of a channel of light; `white` is the light that becomes 1.
using Tone = double (*)(double light, double white);
Tone find_tone(std::string_view name); // null where there is none

// sRGB (IEC 1999): light, clamped to [0, 1], as a code from 0 to 255, not a whole number.
double code_of(double light);

} // namespace scanout::trace
