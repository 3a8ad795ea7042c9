// Shadow caster culling: which shadows need not be drawn, told from a mesh's topology and a light's
// position before anything is drawn.
#pragma once

#include "frame/facts/back_faces.h"
#include "scene/light.h"

#include <span>

namespace scanout::frame {

struct ShadowMapTexels {
    int size = 0;   // texels a side of a map
    int filter = 0; // texels a side that the filter of one receiver reads
};

// No component casts a shadow on another: between any two there is a plane that holds the direction
// of a directional light, or the position of another, and no filter of a map mixes texels of both.
// Boxes in mesh coordinates. Never true of a light with a size, nor in a view that is not known.
bool shadows_are_disjoint(std::span<const geom::Box> boxes, const scene::ViewLight& light,
                          const scene::View& view, const ShadowMapTexels& map);

// Back faces need not be drawn into the light's shadow map, for what is nearest to the light is
// front-facing everywhere: the mesh is closed and wound outwards (MeshTopology::fronts_hide_backs,
// with its limit), and the light is outside of its components. Never true of a light with a
// position in a view that is not known.
bool only_front_faces_cast(const geom::MeshTopology& topology, const scene::ViewLight& light,
                           const scene::View& view);

} // namespace scanout::frame
