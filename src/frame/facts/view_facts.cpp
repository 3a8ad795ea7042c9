#include "frame/facts/view_facts.h"

#include "base/check.h"
#include "frame/facts/shadow_cull_facts.h"
#include "frame/view/bounding_sphere.h"

#include <algorithm>
#include <cmath>

namespace scanout::frame {
namespace {

scene::ViewLight in_view(const scene::Light& light, const scene::View& view,
                         const SceneFacts& facts) {
    geom::Mesh place; // all that lights ask of a mesh
    place.centre = facts.centre;
    place.exponent = facts.exponent;
    place.radius = facts.radius;
    return in_view(light, view, place);
}

LightFacts light_facts(const scene::Light& light, const FrameOptions& options,
                       const SceneFacts& facts, const scene::View& view) {
    LightFacts found;
    const bool casts = light.casts && !is_ambient(light.kind);
    const bool may_miss = light.kind == scene::LightKind::spot && view.near_distance > 0;
    if (!casts && !may_miss) return found;
    const scene::ViewLight placed = in_view(light, view, facts);
    found.reaches = !may_miss || may_be_lit(placed, view);
    if (!casts || !found.reaches) return found;
    const ShadowMapTexels map{options.shadow_size, options.shadow_filter};
    found.shadows_disjoint =
        shadows_are_disjoint(facts.topology.convex_components, placed, view, map);
    found.only_front_faces = only_front_faces_cast(facts.topology, placed, view);
    found.inner = inner_sides(facts.topology, facts.triangles, placed, view);
    return found;
}

} // namespace

// The near plane of a perspective view cuts triangles; the others end depths.
static void put_cuts(const scene::View& view, ViewFacts& found) {
    const bool perspective = view.projection == scene::Projection::perspective;
    const auto depth_at = [&](double distance) {
        return static_cast<float>(perspective ? view.near_distance / distance
                                              : (-distance - view.depth_origin) * view.depth_scale);
    };
    if (std::isfinite(view.cut_far)) found.farthest = depth_at(view.cut_far);
    if (!perspective && std::isfinite(view.cut_near)) found.nearest = depth_at(view.cut_near);
}

double depth_reach(const scene::View& view) {
    if (view.projection == scene::Projection::orthographic || !(view.near_distance > 0)) return 0;
    const BoundingSphere sphere = bounding_sphere(view);
    const double far = std::min(view.cut_far, sphere.radius - sphere.centre.z);
    return std::max(far / view.near_distance, 2.0);
}

ViewFacts view_facts(const FrameOptions& options, const SceneFacts& facts,
                     const scene::View& view) {
    ViewFacts found;
    found.in_view = may_be_visible(view);
    found.orthographic = view.projection == scene::Projection::orthographic;
    put_cuts(view, found);
    if (options.depth == "linear") found.reach = depth_reach(view);
    if (!found.in_view) return found;
    found.inside = may_be_inside(facts.topology, view);
    found.backs = back_faces_in_view(facts.topology, view);
    CHECK(options.lights.size() <= found.lights.size());
    for (std::size_t i = 0; i < options.lights.size(); ++i)
        if (!is_black(options.lights[i]))
            found.lights[i] = light_facts(options.lights[i], options, facts, view);
    return found;
}

} // namespace scanout::frame
