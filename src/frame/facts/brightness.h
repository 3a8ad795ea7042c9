// An upper bound of a scene's light: decides between tone mapping by a clamp at 1 and by a filmic
// curve.
#pragma once

#include "scene/light.h"

#include <span>

namespace scanout::frame {

// The most diffuse light, ambient light included, that arrives at a white surface, however it is
// turned; of the brightest channel. Directional lights of one frame: the greatest sum of max(n.l,
// 0) is the length of a sum of some of their vectors, for up to 8 of them; else, and between camera
// and world, sums, which are no less. Lights at a place count as they shine on the model's centre.
double greatest_light(std::span<const scene::Light> lights);

} // namespace scanout::frame
