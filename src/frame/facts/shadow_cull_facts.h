// Shadow caster culling: which shadow casters can be skipped, decided before drawing from the
// mesh's topology and the light's position.
#pragma once

#include "frame/facts/back_faces.h"
#include "raster/culling/cull.h"
#include "scene/light.h"

#include <span>

namespace scanout::frame {

struct ShadowMapTexels {
    int size = 0;   // texels a side of a map
    int filter = 0; // texels a side that the filter of one receiver reads
};

// No component casts a shadow on another: some plane through the light's position, or parallel to a
// directional light, separates any two, and no filter of a map mixes texels of both. Boxes in mesh
// coordinates. Always false for a light with a size, and in a view that is not known.
bool shadows_are_disjoint(std::span<const geom::Box> boxes, const scene::ViewLight& light,
                          const scene::View& view, const ShadowMapTexels& map);

// Back faces can be left out of the light's shadow map, because the nearest surface to the light is
// front-facing everywhere: the mesh is closed and wound outwards (MeshTopology::fronts_hide_backs,
// with its limit), and the light is outside of its components. Always false for a light with a
// position in a view that is not known.
bool only_front_faces_cast(const geom::MeshTopology& topology, const scene::ViewLight& light,
                           const scene::View& view);

// The sides of faces that no light reaches, because all lie within closed components, outside of
// which it stands: backs, where those are wound outwards, fronts, where all are wound inwards; any,
// where that is not known. triangles: of the mesh.
raster::Facing inner_sides(const geom::MeshTopology& topology, std::size_t triangles,
                           const scene::ViewLight& light, const scene::View& view);

} // namespace scanout::frame
