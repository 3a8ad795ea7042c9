#include "geom/extent.h"

#include "math/rotation.h"

#include <cmath>

namespace scanout::geom {

// A value of the normalised mesh in the units of the file.
static std::optional<double> in_units(double value, int exponent) {
    const double scaled = std::ldexp(value, exponent);
    if (value != 0 && !std::isnormal(scaled)) return std::nullopt;
    return scaled;
}

Extent extent_of(const Mesh& mesh) {
    double area = 0, volume = 0; // twice, and six times
    for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
        const DVec3 a(mesh.position[mesh.index[i]]), b(mesh.position[mesh.index[i + 1]]),
            c(mesh.position[mesh.index[i + 2]]);
        area += length(cross3(b - a, c - a));
        volume += dot3(a, cross3(b, c));
    }
    return {area > 0, in_units(area / 2, 2 * mesh.exponent),
            in_units(volume / 6, 3 * mesh.exponent)};
}

} // namespace scanout::geom
