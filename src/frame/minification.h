// Whether a view shows textures minified, more than a texel a pixel: only then are there mipmaps.
// Told without drawing, from bounds that are gathered once.
#pragma once

#include "scene/scene.h"
#include "scene/view.h"
#include "shade/mip_chain.h"

#include <vector>

namespace scanout::frame {

// The triangles of one material under one of its maps.
struct TexturedSurface {
    std::size_t material = 0;
    shade::Map map{};
    shade::MipUse texture{};
    bool clamp = false; // -clamp on
    // At most, in any direction; normalised object units. By the model's uv, and by a mapping.
    double texels_per_unit = 0, texels_per_unit_mapped = 0;
    DVec3 box_min{0}, box_max{0}; // of the triangles
};
// One for each map that a triangle's material has and that could be read.
std::vector<TexturedSurface> textured_surfaces(const scene::Scene& scene);

// How many texels a pixel spans where the surface lies farthest away, if it faces the eye there;
// 0 where all of it lies behind the eye. mapped: its uv are not the model's.
double texels_per_pixel(const TexturedSurface& surface, const scene::View& view, int width,
                        int height, bool mapped = false);

// Slanted surfaces span more. Every curved one has a rim where it is infinitely many, a pixel wide
// or less: what counts is a surface at up to 75 degrees, which spans this many times more.
inline constexpr double kMostSlant = 4;

} // namespace scanout::frame
