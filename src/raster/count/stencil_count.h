// Stencil counts: sums polygons over a tile's samples for shadow volumes and shadows projected onto
// a plane, after visibility. The same exact coverage as that of visible triangles; sums of small
// integers, so no order matters.
#pragma once

#include "image/image.h"
#include "raster/screen/primitive.h"
#include "raster/screen/sample_pattern.h"

#include <cstdint>
#include <span>

namespace scanout::raster {

struct StencilTriangle {
    Triangle triangle; // its id: of the scene's triangle that it is, or kNoPrimitive
    float weight;      // added to the count of the samples it covers
};

// Laid out as TilePlanes. depth, id: what is visible at the sample.
struct StencilPlanes {
    image::Rect area;
    std::span<const SampleOffset> pattern;
    const float* depth;
    const std::uint32_t* id;
    float* count;
};

// A triangle set up for one tile.
struct StencilSetup {
    double a[3], b[3], c[3], least[3]; // edge functions, and from what value on they are inside
    double depth_factor[3];            // depth of a vertex / area
    int x0, y0, x1, y1;                // pixels; x0 a multiple of 8 from the tile's corner
    int left, top;                     // of the tile
    float weight;
    std::int32_t id;
};

enum class StencilWhere : bool { everywhere, behind };
inline constexpr double kSameDepth = 0x1p-20; // of a depth: closer than this is the same

// behind: only where the triangle lies behind the visible surface, or on it. The visible triangle
// itself counts as on it, and so does what is as near but for kSameDepth: no surface occludes
// itself.
void add_to_stencil(const StencilPlanes& tile, const StencilTriangle& triangle, StencilWhere where);

// What the triangle adds at one point (1/256 pixel), where a surface of this depth and id is
// visible.
float stencil_at(const StencilTriangle& triangle, std::int32_t x, std::int32_t y, double depth,
                 std::uint32_t id, StencilWhere where);

} // namespace scanout::raster
