#include "frame/view/bounding_sphere.h"

#include "frame/view/light_view.h"
#include "math/rotation.h"
#include "math/transcendental.h"

#include <algorithm>
#include <cmath>

namespace scanout::frame {
namespace {

constexpr double kMargin = 1.05;

} // namespace

BoundingSphere bounding_sphere(const scene::View& view) {
    return {view.translation, scene::stretch_of(view.linear).most * kMargin};
}

bool may_be_visible(const scene::View& view) {
    if (!(view.near_distance > 0)) return true;
    const auto [at, radius] = bounding_sphere(view);
    const bool parallel = view.projection == scene::Projection::orthographic;
    const auto beside = [&, &at = at, &radius = radius](double across, double half, double middle) {
        const double edge = (half + std::abs(middle)) * kMargin;
        return parallel ? std::abs(across) - radius > edge
                        : std::abs(across) + edge * at.z > radius * scanout::sqrt(1 + edge * edge);
    };
    const bool behind = !parallel && radius - at.z < view.near_distance;
    return !(behind || beside(at.x, view.half_width, view.middle.x) ||
             beside(at.y, view.half_height, view.middle.y));
}

bool may_be_lit(const scene::ViewLight& light, const scene::View& view) {
    if (light.kind != scene::LightKind::spot) return true;
    const BoundingSphere sphere = bounding_sphere(view);
    const DVec3 way = sphere.centre - place_of(light, view);
    const double distance = length(way);
    if (!(distance > sphere.radius)) return true;
    // Compares the angle between axis and centre with the sum of the cone's and the sphere's half
    // angles.
    const double sine = sphere.radius / distance, cosine = scanout::sqrt(1 - sine * sine);
    const double cone = double{light.cos_outer};
    if (cone <= -cosine) return true;
    const double together = cone * cosine - scanout::sqrt(std::max(1 - cone * cone, 0.0)) * sine;
    return dot3(DVec3(light.axis), way) > together * distance;
}

} // namespace scanout::frame
