#include "shade/setup/interpolation_step.h"

#include "math/transcendental.h"

#include <algorithm>

namespace scanout::shade {
namespace {

constexpr double kSlack = 1.02; // covers the rounding of the bound and of the interpolation
constexpr double kPixel = 256;

double bend(double ratio) {
    const double root = sqrt(ratio);
    return (root - 1) / (root + 1);
}

// The common denominator of all attributes, D = sum(b_i / w_i), on the screen.
struct Denominator {
    double least; // at a vertex
    double ratio; // the greatest to the least
    double x;     // change a pixel
};

struct Bound {
    const Primitive& t;
    Denominator d;

    // The error of an attribute that is divided every `step` pixels; 0: never.
    double error(const float (&f)[3], int step) const {
        const double low = double{std::min({f[0], f[1], f[2]})},
                     high = double{std::max({f[0], f[1], f[2]})};
        if (step == 0) return kSlack * bend(d.ratio) * (high - low);
        double numerator = 0; // change a pixel of sum(b_i f_i / w_i), from `low` on
        for (int k = 0; k < 3; ++k)
            numerator += t.a[k] * kPixel * double{t.inverse_w[k]} * (double{f[k]} - low);
        // The slope is (N' - f D') / D: greatest where f is at one end and D is least.
        const auto magnitude = [](double x) { return x < 0 ? -x : x; };
        const double slope =
            std::max(magnitude(numerator), magnitude(numerator - (high - low) * d.x)) / d.least;
        const double ratio = std::min(1 + step * magnitude(d.x) / d.least, d.ratio);
        return kSlack * bend(ratio) * std::min(high - low, step * slope);
    }
};

bool within(const Bound& bound, const StepLimits& limits, int step) {
    const Primitive& t = bound.t;
    if (limits.attributes.uv)
        for (const auto& component : t.uv)
            if (bound.error(component, step) > limits.uv) return false;
    double normal = 0;
    for (int c = 0; c < 3; ++c) {
        if (limits.attributes.colour && bound.error(t.colour[c], step) > limits.colour)
            return false;
        if (limits.attributes.position && bound.error(t.position[c], step) > limits.position)
            return false;
        if (!limits.attributes.normal) continue;
        const auto& n = t.normal[c];
        const float range = std::max({n[0], n[1], n[2]}) - std::min({n[0], n[1], n[2]});
        if (range > 0.5F) return false; // their mean may be short: its direction is uncertain
        const double error = bound.error(n, step);
        normal += error * error;
    }
    return normal <= limits.normal * limits.normal;
}

} // namespace

std::int8_t step_for(const Primitive& t, const StepLimits& limits) {
    if (t.clipped) return 0;
    const double area = (t.c[0] + t.c[1]) + t.c[2];
    const double least = double{std::min({t.inverse_w[0], t.inverse_w[1], t.inverse_w[2]})};
    const double most = double{std::max({t.inverse_w[0], t.inverse_w[1], t.inverse_w[2]})};
    if (!(least > 0) || !(area > 0)) return 0;
    Bound bound{t, {area * least, most / least, 0}};
    for (int k = 0; k < 3; ++k)
        bound.d.x += t.a[k] * kPixel * double{t.inverse_w[k]};
    if (within(bound, limits, 0)) return kAffine;
    for (const int step : {16, 8})
        if (within(bound, limits, step)) return static_cast<std::int8_t>(step);
    return 0;
}

} // namespace scanout::shade
