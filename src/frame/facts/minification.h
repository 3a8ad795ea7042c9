// Texture minification: how many texels a pixel spans in a view, at most. Above one, mip levels are
// made. Found before drawing, from bounds that are gathered once.
#pragma once

#include "frame/view/eye.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "shade/mip/mip_chain.h"

#include <vector>

namespace scanout::frame {

// The triangles of one material under one of its maps.
struct TexturedSurface {
    std::size_t material = 0;
    shade::Map map{};
    shade::MipUse texture{};
    bool clamp = false;    // -clamp on
    bool constant = false; // all its texels are one colour
    // At most, in any direction; normalised object units. By the model's uv, and by a mapping.
    double texels_per_unit = 0, texels_per_unit_mapped = 0;
    DVec3 box_min{0}, box_max{0}; // of the triangles
    geom::PlaneSet planes{};      // in which they lie
};
// One for each map that a triangle's material has and that could be read.
std::vector<TexturedSurface> textured_surfaces(const scene::Scene& scene);

// At most, in texels that a pixel spans.
struct Minification {
    double facing = 0;  // where the surface lies farthest away, if it faces the eye there
    double slanted = 0; // and as it stands
};

// Curved surfaces have a rim where a pixel spans infinitely many texels, a pixel wide or less: what
// counts is a surface at up to 75 degrees, which spans this many times more than one that faces the
// eye.
inline constexpr double kMaxSlant = 4;

// 0 where all of the surface lies behind the eye. mapped: its uv are not the model's.
Minification texels_per_pixel(const TexturedSurface& surface, const scene::View& view, int width,
                              int height, bool mapped = false);

} // namespace scanout::frame
