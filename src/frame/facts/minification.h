// Texture minification: the greatest number of texels that a pixel spans in a view. Mip levels are
// made when it exceeds one. Computed before drawing, from bounds that are gathered once.
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
    scene::Wrap wrap_u{}, wrap_v{};
    bool constant = false; // all its texels are one colour
    // The greatest number of texels that a normalised object unit spans in any direction: by the
    // model's uv, and by a mapping.
    double texels_per_unit = 0, texels_per_unit_mapped = 0;
    DVec3 box_min{0}, box_max{0}; // of the triangles
    geom::PlaneSet planes{};      // planes of the triangles
};
// One for each map that a triangle's material has and that could be read.
std::vector<TexturedSurface> textured_surfaces(const scene::Scene& scene);

// The greatest number of texels that a pixel spans.
struct Minification {
    double facing = 0;  // at the farthest point, if the surface faced the eye there
    double slanted = 0; // at the slant that the surface has
};

// The limit for slanted surfaces: a surface at 75 degrees spans this many times the texels of one
// that faces the eye. The rim of a curved surface spans infinitely many, but it is a pixel wide or
// less, so it does not count.
inline constexpr double kMaxSlant = 4;

// 0 where the whole surface lies behind the eye. mapped: a mapping computes its uv.
Minification texels_per_pixel(const TexturedSurface& surface, const scene::View& view, int width,
                              int height, bool mapped = false);

} // namespace scanout::frame
