// Coordinates: not finite, unused, not normal floats, far from the origin, of an unusual size.
#include "geom/diagnose/families.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace scanout::geom {
namespace {

void examine_positions(const Surface& surface, Findings& findings) {
    const std::vector<DVec3>& positions = surface.mesh().positions;
    Tally not_finite, unused, denormal;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        HazardPlace place;
        place.position = static_cast<std::uint32_t>(i);
        if (!is_finite(positions[i])) {
            not_finite.add(0, place);
            continue;
        }
        place.at = positions[i];
        if (surface.usable().position[i] == 0) {
            unused.add(0, place);
            continue;
        }
        const auto is_denormal = [](double x) { return x != 0 && std::abs(x) < double{FLT_MIN}; };
        const DVec3& p = positions[i];
        if (is_denormal(p.x) || is_denormal(p.y) || is_denormal(p.z)) denormal.add(0, place);
    }
    findings.add(Hazard::not_finite, not_finite);
    findings.add(Hazard::unreferenced, unused);
    findings.add(Hazard::denormals, denormal);
}

// From one float to the next, where they are as large as x.
double float_step(double x) {
    int exponent = 0; // x is at least half of 2^exponent, and below it
    std::frexp(x, &exponent);
    return std::ldexp(1.0, exponent - 24);
}

void examine_extent(const Surface& surface, Findings& findings) {
    const Framing& framing = surface.framing();
    const auto largest = [](const DVec3& v) {
        return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    };
    const double far = std::max(largest(framing.box_min), largest(framing.box_max));
    const double radius = framing.radius * surface.unit();
    if (!(radius > 0)) return;
    HazardPlace place;
    place.at = framing.centre;
    // A picture is some 1000 pixels wide: floats step by a tenth of a pixel.
    constexpr double kStep = 1e-4;
    const double step = float_step(far);
    Tally away, unusual;
    if (step > kStep * radius) away.add(step, place);
    if (radius < 1e-4 || radius > 1e6) unusual.add(radius, place);
    findings.add(Hazard::far_from_origin, away);
    findings.add(Hazard::unusual_unit, unusual);
}

} // namespace

void examine_numbers(const Surface& surface, Findings& findings) {
    examine_positions(surface, findings);
    if (surface.places() == 0) return;
    examine_extent(surface, findings);
}

} // namespace scanout::geom
