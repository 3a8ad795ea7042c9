// Can the shadow of one body reach another? Told from their boxes and the light's place alone.
#pragma once

#include "frame/back_faces.h"
#include "scene/light.h"

#include <span>

namespace scanout::frame {

struct ShadowTexels {
    int size = 0;   // texels a side of a map
    int filter = 0; // texels a side that one receiver asks
};

// Between any two there is a plane that holds a directional light's direction, or a light's place:
// neither stands in the other's light. And no filter of a map mixes texels of both. Boxes in mesh
// coordinates. Never true of a light with a size, nor in a view that is not known.
bool stand_apart(std::span<const geom::Box> bodies, const scene::ViewLight& light,
                 const scene::View& view, const ShadowTexels& map);

} // namespace scanout::frame
