#include "frame/facts/shadow_cull_facts.h"

#include "frame/view/eye.h"
#include "frame/view/light_view.h"
#include "math/rotation.h"

#include <algorithm>
#include <cmath>

namespace scanout::frame {
namespace {

// A box in view space: its centre, and the way from there to the middle of three of its sides.
struct ViewBox {
    DVec3 centre;
    DVec3 half[3];

    ViewBox(const geom::Box& box, const scene::View& view)
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

// Normals of candidate separating planes of two boxes: from one box to the other, and along the
// boxes' sides; each is made perpendicular to the light.
bool plane_between(const ViewBox& a, const ViewBox& b, const DVec3& towards_light, double margin) {
    const auto separates = [&](const DVec3& way) {
        const DVec3 across = way - towards_light * dot3(way, towards_light);
        const double long_is = length(across);
        if (!(long_is > 1e-9)) return false;
        const DVec3 normal = across / long_is;
        return std::abs(dot3(b.centre - a.centre, normal)) >
               a.extent(normal) + b.extent(normal) + 2 * margin;
    };
    return separates(b.centre - a.centre) ||
           std::any_of(std::begin(a.half), std::end(a.half), separates);
}

// The plane through the light's position that halves the angle between the boxes.
bool plane_between_from(const DVec3& place, const ViewBox& a, const ViewBox& b, double texel,
                        int texels) {
    const DVec3 to_a = a.centre - place, to_b = b.centre - place;
    const double far_a = length(to_a), far_b = length(to_b);
    if (!(far_a > 0 && far_b > 0)) return false;
    const DVec3 across = to_b / far_b - to_a / far_a;
    const double long_is = length(across);
    if (!(long_is > 1e-9)) return false;
    const DVec3 normal = across / long_is;
    const auto clear = [&](const ViewBox& box, double height, double far) {
        return height > box.extent(normal) + texels * texel * (far + box.radius());
    };
    return clear(a, -dot3(to_a, normal), far_a) && clear(b, dot3(to_b, normal), far_b);
}

} // namespace

bool shadows_are_disjoint(std::span<const geom::Box> boxes, const scene::ViewLight& light,
                          const scene::View& view, const ShadowMapTexels& map) {
    if (boxes.size() < 2) return true;
    if (is_ambient(light.kind)) return true;
    const int texels = map.filter + 4;
    const double inner = map.size / 4.0 - texels; // inner part of one of six views (light_views)
    if (!is_known(view) || light.size > 0 || inner < 1) return false;
    const bool directional = light.kind == scene::LightKind::directional;
    constexpr double kWidest = 1.75; // tangent of half the angle of a view, at most
    const double texel = (directional ? radius_of(view) : kWidest) / inner;
    const DVec3 towards(light.towards), place = directional ? DVec3(0) : place_of(light, view);
    for (std::size_t i = 1; i < boxes.size(); ++i) {
        const ViewBox a(boxes[i], view);
        for (std::size_t k = 0; k < i; ++k) {
            const ViewBox b(boxes[k], view);
            if (directional ? !plane_between(a, b, towards, texels * texel)
                            : !plane_between_from(place, a, b, texel, texels))
                return false;
        }
    }
    return true;
}

static bool stands_outside(const geom::MeshTopology& topology, const scene::ViewLight& light,
                           const scene::View& view) {
    if (!eye_of(view)) return false; // of a flat picture: either
    if (light.kind == scene::LightKind::directional) return true;
    return is_known(view) && !may_be_inside(topology, view_about(light, view));
}

bool only_front_faces_cast(const geom::MeshTopology& topology, const scene::ViewLight& light,
                           const scene::View& view) {
    return topology.fronts_hide_backs() && stands_outside(topology, light, view);
}

raster::Facing inner_sides(const geom::MeshTopology& topology, std::size_t triangles,
                           const scene::ViewLight& light, const scene::View& view) {
    using raster::Facing;
    if (!topology.closed || topology.back_to_back || !stands_outside(topology, light, view))
        return Facing::any;
    return topology.inside_out == 0           ? Facing::back
           : topology.inside_out == triangles ? Facing::front
                                              : Facing::any;
}

} // namespace scanout::frame
