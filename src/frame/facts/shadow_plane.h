// The plane that receives projected shadows: the model's floor, or a plane that the user names.
#pragma once

#include "frame/options.h"
#include "geom/mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scanout::frame {

// The points of mesh coordinates with normal . p = offset.
struct ShadowPlane {
    DVec3 normal{0}; // unit
    double offset = 0;
    std::size_t triangles = 0; // triangles in the plane; 0: nothing receives a shadow
    bool by_user = false;      // the user has named it
    friend bool operator==(const ShadowPlane&, const ShadowPlane&) = default;
};
// The side of the model's box, along the file's axes, that holds the largest flat area: the floor
// of most scenes, whichever axis is up.
ShadowPlane find_shadow_plane(const geom::Mesh& mesh);
ShadowPlane find_shadow_plane(const geom::Mesh& mesh, const FilePlane& by_user);
// For each triangle, 1 where it lies in the plane.
std::vector<std::uint8_t> in_shadow_plane(const geom::Mesh& mesh, const ShadowPlane& plane);

} // namespace scanout::frame
