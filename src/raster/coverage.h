// Exact coverage and depth of triangles in a tile's planes. A sample is inside when all three
// integer edge functions say so, by the top-left rule; of what covers it, the nearest is kept, at a
// tie the lower id.
#pragma once

#include "image/image.h"
#include "raster/piece.h"
#include "raster/primitive.h"
#include "raster/sample_pattern.h"
#include "raster/visible_rule.h"

#include <cstdint>
#include <span>

namespace scanout::raster {

inline constexpr int kTileSize = 64;

struct PieceSetUp;

// One plane a sample, kTileSize rows of kTileSize pixels each, whatever the area.
struct TilePlanes {
    image::Rect area; // of the picture; its corner is a multiple of 8 in x and y
    std::span<const SampleOffset> pattern;
    float* depth;
    std::uint32_t* id; // null: depth alone is kept, by the usual rule
    VisibleRule rule{};
    // By the usual rule: for each block of 8 x 8 pixels, row by row, a depth that nothing seen at
    // its samples is farther away than; 0 where nothing is known. What is farther is not drawn.
    // Large triangles keep it up as they are drawn, pieces look a block through that may hide them,
    // find_farthest looks all through.
    float* farthest = nullptr;
};

// Triangles of a mesh that stand on the screen whole: triangle number which[i] has its corners at
// index[3 which[i]] and the two behind it, and the name id[i].
struct TriangleList {
    std::span<const ScreenVertex> vertices;
    std::span<const std::uint32_t> index, which, id;
};

// Did any of them show? Where depth alone is kept: was any nearer than what was there? Pixels of
// the planes beyond the area may be drawn, too.
bool draw_triangles(const TilePlanes& tile, const TriangleList& triangles);
bool draw_piece(const TilePlanes& tile, const PieceSetUp& piece);

// The depth of a triangle at a sample, on one of two paths, each with a relative error below 2^-23
// of the exact plane through the snapped vertices (HARD-CASES 14, 15):
//
// - near to flat, in float: z = base + (rest + (x dz/dx + y dz/dy)) from the corner of the aligned
//   block of 8 x 8 pixels, where base + rest is that corner's depth in 24 + 24 bits. Used when
//   depth changes by less than 1/32 of itself across a block: then all but the last addition err
//   by less than 1/8 unit in the last place. Not where depth is below 2^-100 and its parts would
//   be denormal.
// - else in double: E_0 d_0 / area + E_1 d_1 / area + E_2 d_2 / area, no term of which is negative,
//   so nothing cancels, rounded to float once. d_i / area is d_i times 1 / area.
//
// Neither depends on the tile, the vertices' order or what else is drawn. Pieces have the same
// bound (raster/piece_coverage.cpp).
bool near_to_flat(const SnappedTriangle& triangle);

} // namespace scanout::raster
