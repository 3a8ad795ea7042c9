#include "frame/view/eye.h"

#include "math/transcendental.h"

#include <algorithm>
#include <cmath>

namespace scanout::frame {

bool is_known(const scene::View& view) {
    return view.projection == scene::Projection::orthographic || view.near_distance > 0;
}

std::optional<DVec4> eye_of(const scene::View& view) {
    const DMat3& m = view.linear;
    const DVec3 rows[] = {cross3(m[1], m[2]), cross3(m[2], m[0]), cross3(m[0], m[1])};
    const double determinant = dot3(m[0], rows[0]);
    if (!(std::abs(determinant) > 0)) return std::nullopt;
    const bool everywhere = view.projection == scene::Projection::orthographic;
    const DVec3 at = everywhere ? DVec3(0, 0, 1) : -view.translation;
    return DVec4(dot3(rows[0], at) / determinant, dot3(rows[1], at) / determinant,
                 dot3(rows[2], at) / determinant, everywhere ? 0 : 1);
}

std::optional<DVec4> known_eye_of(const scene::View& view) {
    return is_known(view) ? eye_of(view) : std::nullopt;
}

double slant(const geom::Plane& plane, const scene::View& view, double farthest) {
    const DVec3 normal = view.normal * plane.normal;
    const double square = dot3(normal, normal);
    if (!(square > 0)) return INFINITY;
    const DVec3 unit = normal / sqrt(square);
    if (view.projection == scene::Projection::orthographic) return 1 / std::abs(unit.z);
    const DVec3 point = view.linear * (plane.normal * plane.offset) + view.translation;
    return std::max(farthest / std::abs(dot3(unit, point)), 1.0);
}

} // namespace scanout::frame
