#include "trace/display.h"

#include "math/transcendental.h"

#include <algorithm>
#include <utility>

namespace scanout::trace {
namespace {

double clamp_tone(double light, double /*white*/) {
    return light;
}

// Narkowicz 2015.
double filmic(double light, double /*white*/) {
    const double x = std::clamp(light, 0.0, 16.0);
    return std::min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 1.0);
}

// Untouched up to 1 / white; above, Reinhard et al. 2002, eq. 4, scaled to begin with slope 1 and
// to reach 1 at `white`.
double shoulder(double light, double white) {
    const double knee = 1 / white, room = 1 - knee, x = std::min(light, white);
    if (x <= knee) return x;
    const double t = (x - knee) / room, s = white + 1;
    return std::min(knee + room * t * (1 + t / (s * s)) / (1 + t), 1.0);
}

} // namespace

Tone find_tone(std::string_view name) {
    constexpr std::pair<std::string_view, Tone> kRows[] = {
        {"clamp", clamp_tone}, {"shoulder", shoulder}, {"filmic", filmic}};
    for (const auto& [known, tone] : kRows)
        if (known == name) return tone;
    return nullptr;
}

double code_of(double light) {
    const double x = std::clamp(light, 0.0, 1.0);
    return 255 * (x > 0.0031308 ? 1.055 * pow(x, 1 / 2.4) - 0.055 : 12.92 * x);
}

} // namespace scanout::trace
