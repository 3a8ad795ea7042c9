#include "frame/facts/back_faces.h"

#include "frame/view/eye.h"
#include "math/rotation.h"
#include "math/transcendental.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace scanout::frame {
namespace {

// The greatest distance of a near-plane corner from the eye, in mesh coordinates.
double near_reach(const scene::View& view) {
    const double x = std::abs(view.middle.x) + view.half_width,
                 y = std::abs(view.middle.y) + view.half_height;
    return view.near_distance * sqrt(1 + x * x + y * y) / scene::stretch_of(view.linear).least;
}

} // namespace

bool may_be_inside(const geom::MeshTopology& topology, const scene::View& view) {
    const std::optional<DVec4> eye = known_eye_of(view);
    // An orthographic eye is infinitely far away; but the caller may cut off what is near.
    if (eye && eye->w == 0) return std::isfinite(view.cut_near);
    if (!eye) return false;
    const DVec3 at(*eye);
    const double reach = near_reach(view);
    return std::any_of(topology.closed_boxes.begin(), topology.closed_boxes.end(),
                       [&](const geom::Box& box) {
                           bool inside = true;
                           for (int axis = 0; axis < 3; ++axis)
                               inside = inside && at[axis] > box.low[axis] - reach &&
                                        at[axis] < box.high[axis] + reach;
                           return inside;
                       });
}

BackFaces back_faces_in_view(const geom::MeshTopology& topology, const scene::View& view) {
    const std::optional<DVec4> eye = known_eye_of(view);
    if (!eye) return topology.open_triangles > 0 ? BackFaces::of_open_components : BackFaces::none;
    const auto& planes = topology.open_planes.planes();
    const bool visible = topology.open_planes.too_many() ||
                         std::any_of(planes.begin(), planes.end(), [&](const geom::Plane& plane) {
                             return geom::height(*eye, plane) < -0x1p-40;
                         });
    if (visible) return BackFaces::of_open_components;
    return may_be_inside(topology, view) ? BackFaces::from_inside : BackFaces::none;
}

std::vector<bool> back_facing(const geom::Mesh& mesh, const scene::View& view) {
    const std::optional<DVec4> eye = eye_of(view);
    std::vector<bool> back(mesh.triangles());
    for (std::size_t i = 0; eye && i < back.size(); ++i) {
        const std::uint32_t* v = &mesh.index[3 * i];
        const DVec3 a(mesh.position[v[0]]);
        const DVec3 n = cross3(DVec3(mesh.position[v[1]]) - a, DVec3(mesh.position[v[2]]) - a);
        back[i] = dot3(n, DVec3(*eye)) - eye->w * dot3(n, a) < 0;
    }
    return back;
}

} // namespace scanout::frame
