// How a frame fills its stencil buffer, and draws what becomes of it (frame/stencil.h).
#pragma once

#include "base/jobs.h"
#include "frame/stencil.h"
#include "raster/stage/geometry.h"
#include "shade/layers.h"

namespace scanout::frame {

// What a tile shows. A pixel of the picture is a square of `scale` pixels of the tile on each side,
// all within it. blended: pixels that also show something; null: none.
void mark_visible(const raster::VisibilityTile& tile, const shade::Layers::Pixels* blended,
                  int scale, StencilBuffer& out);
// The same by areas.
void mark_visible(raster::AreaTile& tile, StencilBuffer& out);

// Counts what lies over the pixels of a tile, hidden or not; of what the geometry culled, nothing.
// The geometry must have taken all for opaque. scratch is drawn over, order is room.
void count_covering(const raster::Geometry& geometry, int tile, raster::VisibilityTile& scratch,
                    raster::Geometry::ById& order, StencilBuffer& out);

// All rows, after all marks.
void show_marks(Jobs& jobs, const Stencil& stencil, const StencilBuffer& marks,
                image::Image& picture);

} // namespace scanout::frame
