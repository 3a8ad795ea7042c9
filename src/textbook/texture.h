// The texel at u, v [Compendium 3.3]: texel centres at half-integers, v up, rows down.
#pragma once

#include "image/image.h"
#include "math/vec.h"
#include "scene/material.h"

namespace scanout::textbook {

// Linear colour of the nearest texel. Beyond the edges the picture repeats, or is clamped as the
// map says.
DVec3 nearest_texel(const image::Image& image, const scene::TextureMap& map, double u, double v);

} // namespace scanout::textbook
