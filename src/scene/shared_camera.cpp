#include "scene/shared_camera.h"

#include "scene/fit.h"

namespace scanout::scene {
namespace {

// The vertices of both, in the normalised coordinates of the first; nothing else of a mesh.
geom::Mesh vertices_of_both(const geom::Mesh& first, const geom::Mesh& second) {
    geom::Mesh both;
    both.position = first.position;
    both.centre = first.centre;
    both.exponent = first.exponent;
    both.radius = first.radius;
    const double unit =
        radii_per_unit(first) / radii_per_unit(second); // of second, in first's radii
    const DVec3 centre = radii_from_centre(first, second.centre);
    both.position.reserve(first.position.size() + second.position.size());
    for (const Vec3& position : second.position)
        both.position.push_back(
            Vec3((centre + DVec3(position) * (unit / second.radius)) * first.radius));
    return both;
}

// The same planes and window, in radii that are so many times as many.
CameraOptions with_planes_at(CameraOptions camera, double radii) {
    for (std::optional<double>* const plane : {&camera.near, &camera.far})
        if (*plane) **plane *= radii;
    if (camera.window)
        for (double* const side : {&camera.window->left, &camera.window->right,
                                   &camera.window->bottom, &camera.window->top})
            *side *= radii;
    return camera;
}

} // namespace

std::pair<CameraOptions, CameraOptions> shared_cameras(const geom::Mesh& first,
                                                       const geom::Mesh& second,
                                                       const CameraOptions& camera, double aspect) {
    const double radii = radii_per_unit(second) / radii_per_unit(first);
    if (camera.eye) return {camera, with_planes_at(camera, radii)};
    CameraOptions of_first = fitted(vertices_of_both(first, second), {}, camera, aspect);
    of_first.pivot = first.centre;
    CameraOptions of_second = with_planes_at(of_first, radii);
    of_second.distance *= radii;
    of_second.shift *= radii;
    return {of_first, of_second};
}

} // namespace scanout::scene
