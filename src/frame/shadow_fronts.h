// Does a light's shadow map need the backs of faces? Told from the mesh's topology and the light's
// place alone.
#pragma once

#include "frame/back_faces.h"
#include "scene/light.h"

namespace scanout::frame {

// Wherever the light looks, what is nearest to it is a front: the mesh is closed and wound
// outwards (geom::MeshTopology::fronts_hide_backs, with its limit), and the light stands outside of
// its parts. Never true of a light at a place in a view that is not known.
bool meets_fronts_first(const geom::MeshTopology& topology, const scene::ViewLight& light,
                        const scene::View& view);

} // namespace scanout::frame
