// Triangles a few pixels wide and high, the most of a fine mesh: set up side by side, one a lane,
// and drawn in strips of rows, or where they are tiny as specks (raster/specks-inl.h). Everything
// about their edges is a whole number of 32 bits, relative to the first of the blocks of 8 x 8
// pixels that they may touch.
#pragma once

#include "raster/block_walk.h"
#include "raster/coverage.h"
#include "raster/cull.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::raster {

inline constexpr int kSmallSide = 16; // pixels from the first to the last vertex, each way

// What is drawn side by side. Of fronts: specks have at most speck_side pixels each way in their
// tile, those within one block lie in that tile alone, those astride of several may be what a
// tile's edge leaves of a triangle; strips are all others. Backs are drawn last, because fronts
// hide the most of them.
enum class PartKind : std::uint8_t { speck_2, speck_3, speck_astride, strip, back };
inline constexpr std::size_t kPartKinds = 5;
inline constexpr std::array kFrontKinds = {PartKind::strip, PartKind::speck_2, PartKind::speck_3,
                                           PartKind::speck_astride}; // as they are drawn
// The most pixels each way; 0: not a speck.
constexpr int speck_side(PartKind kind) {
    switch (kind) {
    case PartKind::speck_2:
        return 2;
    case PartKind::speck_3:
    case PartKind::speck_astride:
        return 3;
    default:
        return 0;
    }
}

// What one tile has of such a triangle.
struct TilePart {
    std::uint32_t place; // in a TilePartList's index
    std::uint32_t where;

    static constexpr int kFirstRow = 6, kEndColumn = 12, kEndRow = 19; // bits

    // The pixels of the tile that may hold its samples: columns [x0, x1), rows [y0, y1).
    static TilePart of(std::uint32_t place, int x0, int y0, int x1, int y1) {
        return {place, static_cast<std::uint32_t>(x0 | y0 << kFirstRow | x1 << kEndColumn |
                                                  y1 << kEndRow)};
    }
    image::Rect box() const {
        const auto number = [&](int first, std::uint32_t most) {
            return static_cast<int>(where >> first & most);
        };
        return {number(0, 63), number(kFirstRow, 63), number(kEndColumn, 127),
                number(kEndRow, 127)};
    }
};

using PartsByKind = std::array<std::vector<TilePart>, kPartKinds>;

// How the tiles of a picture lie.
struct TileGrid {
    int bits;   // a tile has 1 << bits pixels a side
    int across; // tiles in a row of the picture
};

// Of each triangle of a list the part that lies in one tile alone, which most do, and the tile;
// kNone where the triangle is not small or lies in several. They grow to have room for all. The
// list is that of a CullResult: whole registers of it are read.
struct PlacedParts {
    static constexpr std::int32_t kNone = -1;
    std::vector<std::int32_t> tile;
    std::vector<std::uint32_t> where; // of a TilePart
    std::vector<std::int32_t> kind;   // a PartKind
};
void place_parts(const TileGrid& grid, std::span<const KeptTriangle> triangles, PlacedParts& out);

// index: three vertices a triangle, all of which stand on the screen. id: of triangles by place;
// empty: their places are their ids.
struct TilePartList {
    std::span<const ScreenVertex> vertices;
    std::span<const std::uint32_t> index;
    std::span<const TilePart> parts;
    PartKind kind = PartKind::strip; // of all of them; strip: of any
    std::span<const std::uint32_t> id = {};

    std::uint32_t id_of(const TilePart& part) const {
        return id.empty() ? part.place : id[part.place];
    }
};

// Puts parts that will be strips in order by how many rows they have, and how many of those lie in
// their first block, some at a time: loops over rows then mostly end where the last one did, as
// processors foretell.
void order_strips(std::span<TilePart> parts);

// Did any of them show? By the usual rule; the same bits as draw_triangles. Where depth alone is
// kept, specks count in any case.
bool draw_parts(const TilePlanes& tile, const TilePartList& list);
// Makes tile.farthest as great as what is drawn there allows.
void find_farthest(const TilePlanes& tile);
// Is all that is no nearer behind what is drawn in these pixels of the picture, or of their blocks
// in the tile? Makes tile.farthest greater where that tells.
bool hides(const TilePlanes& tile, const image::Rect& pixels, float nearest);
// The same as draw_parts, for parts most of which that hides: they are told by their vertices'
// depths alone. room: for those that are left.
bool draw_parts_behind(const TilePlanes& tile, const TilePartList& list,
                       std::vector<TilePart>& room);

} // namespace scanout::raster
