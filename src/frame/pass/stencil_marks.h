// Fills the frame's stencil buffer, and draws a picture from it (frame/stencil.h).
#pragma once

#include "base/jobs.h"
#include "frame/stencil.h"
#include "raster/stage/geometry.h"
#include "shade/transparency/transparency_pass.h"

namespace scanout::frame {

// Marks the pixels of a tile in which something is visible. A pixel of the picture is a square of
// `scale` x `scale` pixels of the tile, all within it. blended: bits of further pixels; null: none.
void mark_visible(const raster::VisibilityTile& tile,
                  const shade::TransparencyPass::Pixels* blended, int scale, StencilBuffer& out);
// The same for a tile of areas.
void mark_visible(raster::AreaTile& tile, StencilBuffer& out);

// Counts the triangles that cover each pixel of a tile (overdraw): hidden ones, too, but not culled
// ones. The geometry must treat all as opaque. `scratch` and `order` are scratch.
void count_covering(const raster::Geometry& geometry, int tile, raster::VisibilityTile& scratch,
                    raster::DepthRule rule, raster::Geometry::ById& order, StencilBuffer& out);

// Draws all rows; to be called after all marks are set.
void show_marks(Jobs& jobs, const Stencil& stencil, const StencilBuffer& marks,
                image::Image& picture);

} // namespace scanout::frame
