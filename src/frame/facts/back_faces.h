// Can a back-facing triangle be seen in a view? Decided from the mesh's topology, before drawing.
#pragma once

#include "geom/mesh.h"
#include "geom/topology.h"
#include "scene/view.h"

#include <cstdint>
#include <vector>

namespace scanout::frame {

// Whether the eye may be inside of a closed component; not in a view that is not known.
bool may_be_inside(const geom::MeshTopology& topology, const scene::View& view);

// Which back faces a view may show. Whether other triangles hide them all is only known after
// drawing.
enum class BackFaces : std::uint8_t { none, of_open_components, from_inside };
BackFaces back_faces_in_view(const geom::MeshTopology& topology, const scene::View& view);

// For each triangle, whether it is back-facing, even if another triangle hides it.
std::vector<bool> back_facing(const geom::Mesh& mesh, const scene::View& view);

} // namespace scanout::frame
