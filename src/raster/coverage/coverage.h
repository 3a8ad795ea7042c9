// Exact coverage and depth of triangles in a tile's planes. A sample is inside when all three
// integer edge functions say so, by the top-left rule; the nearest of the primitives that cover it
// is stored, at a tie the lower id.
#pragma once

#include "image/image.h"
#include "raster/clipped/clipped_triangle.h"
#include "raster/coverage/depth_rule.h"
#include "raster/screen/primitive.h"
#include "raster/screen/sample_pattern.h"

#include <cstdint>
#include <span>

namespace scanout::raster {

inline constexpr int kTileSize = 64;

struct ClippedSetup;

// One plane a sample, kTileSize rows of kTileSize pixels each, whatever the area.
struct TilePlanes {
    image::Rect area; // of the picture; its corner is a multiple of 8 in x and y
    std::span<const SampleOffset> pattern;
    float* depth;
    std::uint32_t* id; // null: depth alone is stored, by the default rule
    DepthRule rule{};
    // Hierarchical Z (Hi-Z), by the default rule: for each of the 64 blocks of 8 x 8 pixels, row by
    // row, a depth that nothing stored at its samples is farther than; 0 where nothing is known.
    // What is farther is rejected. Large triangles update it as they are drawn, clipped ones
    // refresh a block that may occlude them, build_hi_z reads all depths.
    float* hi_z = nullptr;
};

// Unclipped triangles of a mesh: triangle number which[i] has its vertices at index[3 which[i]] and
// the two behind it, and the id id[i].
struct TriangleList {
    std::span<const ScreenVertex> vertices;
    std::span<const std::uint32_t> index, which, id;
};

// Does any of them pass the depth test? Where depth alone is stored: is any nearer than what was
// there? Pixels of the planes beyond the area may be drawn, too.
bool draw_triangles(const TilePlanes& tile, const TriangleList& triangles);
bool draw_clipped(const TilePlanes& tile, const ClippedSetup& triangle);

// The depth of a triangle at a sample, on one of two paths, each with a relative error below 2^-23
// of the exact plane through the snapped vertices (HARD-CASES 14, 15):
//
// - float depth: z = base + (rest + (x dz/dx + y dz/dy)) from the corner of the aligned block of
//   8 x 8 pixels, where base + rest is that corner's depth in 24 + 24 bits. Used when depth changes
//   by less than 1/32 of itself across a block: then all but the last addition err by less than 1/8
//   unit in the last place. Not where depth is below 2^-100 and its parts would be denormal.
// - else double depth: E_0 d_0 / area + E_1 d_1 / area + E_2 d_2 / area, no term of which is
//   negative, so nothing cancels, rounded to float once. d_i / area is d_i times 1 / area.
//
// Neither depends on the tile, the vertices' order or what else is drawn. Clipped triangles have
// the same bound (raster/clipped/clipped_coverage.cpp).
bool has_float_depth(const SnappedTriangle& triangle);

} // namespace scanout::raster
