#include "frame/shadow_reach.h"

#include "frame/eye.h"
#include "frame/light_view.h"
#include "math/rotation.h"

#include <algorithm>
#include <cmath>

namespace scanout::frame {
namespace {

// A box in view space: its centre, and the way from there to the middle of three of its sides.
struct Body {
    DVec3 centre;
    DVec3 half[3];

    Body(const geom::Box& box, const scene::View& view)
        : centre(view.linear * ((box.low + box.high) / 2.0) + view.translation) {
        for (int axis = 0; axis < 3; ++axis)
            half[axis] = view.linear[axis] * ((box.high[axis] - box.low[axis]) / 2);
    }
    // Half its extent along a unit normal.
    double extent(const DVec3& normal) const {
        double sum = 0;
        for (const DVec3& h : half)
            sum += std::abs(dot3(h, normal));
        return sum;
    }
    double radius() const { return length(half[0]) + length(half[1]) + length(half[2]); }
};

// Of normals that a plane between two bodies may have: across from one to the other, and along the
// boxes' sides; each at right angles to the light.
bool plane_between(const Body& a, const Body& b, const DVec3& towards_light, double room) {
    const auto separates = [&](const DVec3& way) {
        const DVec3 across = way - towards_light * dot3(way, towards_light);
        const double long_is = length(across);
        if (!(long_is > 1e-9)) return false;
        const DVec3 normal = across / long_is;
        return std::abs(dot3(b.centre - a.centre, normal)) >
               a.extent(normal) + b.extent(normal) + 2 * room;
    };
    return separates(b.centre - a.centre) ||
           std::any_of(std::begin(a.half), std::end(a.half), separates);
}

// The plane through the light's place that halves the angle between the bodies.
bool plane_between_from(const DVec3& place, const Body& a, const Body& b, double texel,
                        int texels) {
    const DVec3 to_a = a.centre - place, to_b = b.centre - place;
    const double far_a = length(to_a), far_b = length(to_b);
    if (!(far_a > 0 && far_b > 0)) return false;
    const DVec3 across = to_b / far_b - to_a / far_a;
    const double long_is = length(across);
    if (!(long_is > 1e-9)) return false;
    const DVec3 normal = across / long_is;
    const auto clear = [&](const Body& body, double height, double far) {
        return height > body.extent(normal) + texels * texel * (far + body.radius());
    };
    return clear(a, -dot3(to_a, normal), far_a) && clear(b, dot3(to_b, normal), far_b);
}

} // namespace

bool stand_apart(std::span<const geom::Box> bodies, const scene::ViewLight& light,
                 const scene::View& view, const ShadowTexels& map) {
    if (bodies.size() < 2) return true;
    if (light.kind == scene::LightKind::ambient) return true;
    const int texels = map.filter + 4;
    const double inner = map.size / 4.0 - texels; // as of one of six views (light_views)
    if (!is_known(view) || light.size > 0 || inner < 1) return false;
    const bool directional = light.kind == scene::LightKind::directional;
    constexpr double kWidest = 1.75; // tangent of half the angle of a view, at most
    const double texel = (directional ? radius_of(view) : kWidest) / inner;
    const DVec3 towards(light.towards), place = directional ? DVec3(0) : place_of(light, view);
    for (std::size_t i = 1; i < bodies.size(); ++i) {
        const Body a(bodies[i], view);
        for (std::size_t k = 0; k < i; ++k) {
            const Body b(bodies[k], view);
            if (directional ? !plane_between(a, b, towards, texels * texel)
                            : !plane_between_from(place, a, b, texel, texels))
                return false;
        }
    }
    return true;
}

} // namespace scanout::frame
