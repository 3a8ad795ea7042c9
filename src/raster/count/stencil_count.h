// Stencil counts: sums of polygons over a tile's samples, for shadow volumes and shadows projected
// onto a plane; added after visibility. They use the same exact coverage as visible triangles. They
// are sums of small integers, so the order does not matter.
#pragma once

#include "image/image.h"
#include "raster/screen/primitive.h"
#include "raster/screen/sample_pattern.h"

#include <cstdint>
#include <span>

namespace scanout::raster {

struct StencilTriangle {
    Triangle triangle; // id: the scene's triangle that it is, or kNoPrimitive
    float weight;      // added to the count of the samples it covers
};

// Laid out like TilePlanes. depth, id: of the visible surface at each sample.
struct StencilPlanes {
    image::Rect area;
    std::span<const SampleOffset> pattern;
    const float* depth;
    const std::uint32_t* id;
    float* count;
};

// A triangle set up for one tile.
struct StencilSetup {
    double a[3], b[3], c[3], least[3]; // edge functions; at least `least` is inside
    double depth_factor[3];            // depth of a vertex / area
    int x0, y0, x1, y1;                // pixels; x0 a multiple of 8 from the tile's corner
    int left, top;                     // of the tile
    float weight;
    std::int32_t id;
};

enum class StencilWhere : bool { everywhere, behind };
inline constexpr double kSameDepth = 0x1p-20; // relative; depths closer than this are equal

// behind: counts only where the triangle lies behind the visible surface or on it. The visible
// triangle itself counts as on it, and so does any triangle within kSameDepth of its depth: no
// surface shadows itself.
void add_to_stencil(const StencilPlanes& tile, const StencilTriangle& triangle, StencilWhere where);

// The weight that the triangle adds at one point (1/256 pixel), where a surface of this depth and
// id is visible.
float stencil_at(const StencilTriangle& triangle, std::int32_t x, std::int32_t y, double depth,
                 std::uint32_t id, StencilWhere where);

} // namespace scanout::raster
