// Triangles a few pixels wide and high, the most of a fine mesh: cut up by the blocks of 8 x 8
// pixels that they may touch when they are handed to the tiles, and drawn a block a lane.
// Everything about their edges is a whole number of 32 bits, relative to the block.
#pragma once

#include "raster/block_walk.h"
#include "raster/coverage.h"
#include "raster/cull.h"

#include <cstdint>
#include <span>
#include <vector>

namespace scanout::raster {

inline constexpr int kSmallSide = 8; // pixels from the first to the last vertex, each way

// What one block has of such a triangle.
struct BlockPart {
    std::uint32_t triangle;
    std::uint32_t where;

    static constexpr int kFirstColumn = 6, kEndColumn = 10, kFirstRow = 14, kEndRow = 18; // bits

    // block: of the tile, eight a row; then the pixels of the block that may hold samples: columns
    // [x0, x1), rows [y0, y1).
    static BlockPart of(std::uint32_t triangle, int block, int x0, int y0, int x1, int y1) {
        return {triangle, static_cast<std::uint32_t>(block | x0 << kFirstColumn | x1 << kEndColumn |
                                                     y0 << kFirstRow | y1 << kEndRow)};
    }
};

// How blocks lie in the tiles of a picture.
struct BlockGrid {
    static constexpr int kSide = BlockWalk::kSide, kSideBits = 3;
    static_assert(kSide == 1 << kSideBits);
    int tile_bits; // a tile has 1 << tile_bits blocks a side
    int across;    // tiles in a row of the picture
};

// Of each triangle of a list the part that lies in one block alone, which most are, and its tile;
// kNone where the triangle is not small or lies in several blocks. They grow to have room for all.
// The list is that of a CullResult: whole registers of it are read.
struct PlacedParts {
    static constexpr std::int32_t kNone = -1;
    std::vector<std::int32_t> tile;
    std::vector<std::uint32_t> where; // of a BlockPart
};
void place_parts(const BlockGrid& grid, std::span<const KeptTriangle> triangles, PlacedParts& out);

// index: three vertices a triangle, all of which stand on the screen.
struct BlockPartList {
    std::span<const ScreenVertex> vertices;
    std::span<const std::uint32_t> index;
    std::span<const BlockPart> parts;
};

// Did any of them show? By the usual rule; the same bits as draw_triangles.
bool draw_parts(const TilePlanes& tile, const BlockPartList& list);
// Makes tile.farthest as great as what is drawn there allows.
void find_farthest(const TilePlanes& tile);
// The same as draw_parts, for parts most of which that hides: they are told by their vertices'
// depths alone. room: for those that are left.
bool draw_parts_behind(const TilePlanes& tile, const BlockPartList& list,
                       std::vector<BlockPart>& room);

} // namespace scanout::raster
