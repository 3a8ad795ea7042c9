// An upper bound of a scene's light: decides between tone mapping by a clamp at 1 and by a filmic
// curve.
#pragma once

#include "frame/facts/surroundings.h"
#include "scene/light.h"

#include <span>

namespace scanout::frame {

// The most diffuse light, with ambient light, that a white surface can receive at any orientation;
// of the brightest channel. The greatest sum of max(n.l, 0) over directional lights of one frame is
// the length of a sum of some of their vectors, exact for up to 8; beyond, and between camera and
// world, lengths are added, an upper bound. Point and spot lights count as at the model's centre,
// or, where more of their light falls on surfaces that are near to them, as there (lamp_light).
double greatest_light(std::span<const scene::Light> lights, const Surroundings& surroundings = {});

} // namespace scanout::frame
