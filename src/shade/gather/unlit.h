// Lines and points: their plain colour, without light.
#pragma once

#include "shade/gather/gather_input.h"

namespace scanout::shade {

// Kd times vertex colour of line or point `id` in pixel (x, y) of the picture.
Vec3 unlit_colour(const GatherInput& input, const scene::Material& material, std::uint32_t id,
                  int x, int y);

} // namespace scanout::shade
