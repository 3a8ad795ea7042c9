// Small triangles, a few pixels wide and high: most of a fine mesh. They are set up side by side,
// one a lane, and drawn in rows as wide as a block (raster/micro/small_rows-inl.h), or, if tiny, as
// micro-triangles (raster/micro/micro_triangles-inl.h). Their edge functions are 32-bit integers
// relative to the first of the blocks of 8 x 8 pixels that they may touch.
#pragma once

#include "raster/coverage/block_traversal.h"
#include "raster/coverage/coverage.h"
#include "raster/culling/cull.h"
#include "raster/screen/tile_grid.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::raster {

inline constexpr int kSmallSide = 16; // pixels from the first to the last vertex, each way
inline constexpr int kMicroSide = 3; // pixels that a micro-triangle may cover in its tile, each way

// How a small triangle is rasterised. Front-facing ones: a micro-triangle lies within one block and
// one tile; a straddling one touches several blocks, or a tile's edge has cut it; all others are
// drawn in rows.
// Back-facing ones are drawn last, because front-facing ones occlude most of them.
//
// Time that the kinds save (Stanford's dragon, 871 000 triangles, 1920 x 1080): micro-triangles
// within a block 8 % of a frame of depth, straddling ones with set-up ahead of drawing 7 % more;
// back-facing ones 13 % where both sides are kept, 31 % with a shadow map.
// A kind of its own for 2 x 2 pixels would save 1.4 % on the dragon, 0 on Stanford's bunny.
enum class SmallKind : std::uint8_t { micro, micro_straddling, rows, back_facing };
inline constexpr std::size_t kSmallKinds = 4;
inline constexpr std::array kFrontFacingKinds = {SmallKind::rows, SmallKind::micro,
                                                 SmallKind::micro_straddling}; // in drawing order
constexpr bool is_micro(SmallKind kind) {
    return kind == SmallKind::micro || kind == SmallKind::micro_straddling;
}

// A small triangle in the bin of one tile.
struct BinnedTriangle {
    std::uint32_t spatial_index; // in a BinnedList's index
    std::uint32_t where;

    static constexpr int kFirstRow = 6, kEndColumn = 12, kEndRow = 19; // bits

    // The pixels of the tile that may hold its samples: columns [x0, x1), rows [y0, y1).
    static BinnedTriangle of(std::uint32_t spatial_index, int x0, int y0, int x1, int y1) {
        return {spatial_index, static_cast<std::uint32_t>(x0 | y0 << kFirstRow | x1 << kEndColumn |
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

using BinnedByKind = std::array<std::vector<BinnedTriangle>, kSmallKinds>;

// For each triangle of a list: its tile and its pixels there, if it lies in one tile alone, as most
// do; kNone where the triangle is not small or lies in several. The arrays grow to the size of the
// list of a CullResult, which is padded: kernels read whole registers of it.
struct BinningResult {
    static constexpr std::int32_t kNone = -1;
    std::vector<std::int32_t> tile;
    std::vector<std::uint32_t> where; // of a BinnedTriangle
    std::vector<std::int32_t> kind;   // a SmallKind
};
void bin_small_triangles(const TileGrid& grid, std::span<const VisibleTriangle> triangles,
                         BinningResult& out);

// index: three vertices a triangle, all on the screen. id: of triangles by spatial index; empty:
// the spatial index is the id.
struct BinnedList {
    std::span<const ScreenVertex> vertices;
    std::span<const std::uint32_t> index;
    std::span<const BinnedTriangle> triangles;
    SmallKind kind = SmallKind::rows; // of all of them; rows: of any kind
    std::span<const std::uint32_t> id = {};

    std::uint32_t id_of(const BinnedTriangle& binned) const {
        return id.empty() ? binned.spatial_index : id[binned.spatial_index];
    }
};

// Sorts triangles of kind rows by their number of rows, then by their first row within its block,
// in chunks of some hundred: most loops over rows then end where the previous one did, and the
// branch predictor learns it. Saves 5 % of the depth of Stanford's bunny, 2 % of its Blinn-Phong.
void sort_by_rows(std::span<BinnedTriangle> triangles);

// Draws by the default depth rule, with the same bits as draw_triangles. Returns whether any
// triangle passes the depth test; where only depth is stored, covered micro-triangles count as
// drawn.
bool draw_small_triangles(const TilePlanes& tile, const BinnedList& list);
// Builds the hierarchical Z of the tile (TilePlanes::hi_z) from its depths.
void build_hi_z(const TilePlanes& tile);
// Occlusion query: is everything at this depth or behind occluded in these pixels of the picture,
// or in their blocks in the tile? Refreshes tile.hi_z of the blocks that decide.
bool occludes(const TilePlanes& tile, const image::Rect& pixels, float nearest);
// The same as draw_small_triangles, for triangles of which most are occluded: tests the depths of
// their vertices against tile.hi_z before set-up. scratch: holds the triangles that remain.
bool draw_small_hi_z(const TilePlanes& tile, const BinnedList& list,
                     std::vector<BinnedTriangle>& scratch);

} // namespace scanout::raster
