// A view of scanout as GL wants it: the same picture, in clip space -1 to 1 with a far plane.
#pragma once

#include "bench/peers/load.h"

#include <glm/mat4x4.hpp>

namespace scanout::bench {

struct DepthRange {
    double near, far; // from the eye, bounding radii
};
// As tight as the model allows: 24 bits are few.
DepthRange depth_range(const scene::View& view, bool inside);

glm::mat4 to_view(const scene::View& view);
glm::mat4 to_clip(const scene::View& view, bool inside);
// Mesh coordinates to the shadow map's clip space: a parallel view of the bounding sphere from the
// light.
glm::mat4 to_light_clip(const scene::View& view);

} // namespace scanout::bench
