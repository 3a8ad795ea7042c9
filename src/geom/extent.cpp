#include "geom/extent.h"

#include "math/rotation.h"

#include <cmath>

namespace scanout::geom {
namespace {

// The sum over all triangles of a function of their corners.
template <class OfCorners>
double sum(const Mesh& mesh, OfCorners of_corners) {
    double total = 0;
    for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3)
        total +=
            of_corners(DVec3(mesh.position[mesh.index[i]]), DVec3(mesh.position[mesh.index[i + 1]]),
                       DVec3(mesh.position[mesh.index[i + 2]]));
    return total;
}

} // namespace

double surface_area(const Mesh& mesh) {
    const double twice = sum(mesh, [](const DVec3& a, const DVec3& b, const DVec3& c) {
        return length(cross3(b - a, c - a));
    });
    return std::ldexp(twice / 2, 2 * mesh.exponent);
}

double enclosed_volume(const Mesh& mesh) {
    const double six_times = sum(
        mesh, [](const DVec3& a, const DVec3& b, const DVec3& c) { return dot3(a, cross3(b, c)); });
    return std::ldexp(six_times / 6, 3 * mesh.exponent);
}

} // namespace scanout::geom
