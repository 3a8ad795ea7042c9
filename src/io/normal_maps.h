// Tells a normal map from a height map by its texels: exporters that know no `norm` write both as
// map_bump.
#pragma once

#include "geom/polygon_mesh.h"
#include "image/image.h"
#include "scene/material.h"

#include <cstdint>
#include <span>

namespace scanout::io {

// Bluish everywhere, and unit vectors.
bool holds_normals(const image::Image& image);

// The same of what the faces show of the map, sampled: baked maps have a background of any colour
// between their islands.
bool shows_normals(const image::Image& image, const scene::TextureMap& map,
                   const geom::PolygonMesh& mesh, std::span<const std::uint32_t> faces);

} // namespace scanout::io
