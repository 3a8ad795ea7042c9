// How far texture coordinates may move without a change of what a material shows: whole repeats of
// all its maps, after their -s.
#pragma once

#include "scene/material.h"

#include <vector>

namespace scanout::scene {

// For geom::BuildOptions::uv_step; one a material. 0 where a map is clamped (-clamp on), or its -s
// has no multiple below a thousand that is a whole number.
std::vector<DVec2> uv_steps(const std::vector<Material>& materials);

} // namespace scanout::scene
