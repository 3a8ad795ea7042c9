#include "raster/micro/small_triangles.h"

#include <algorithm>

#define SIMD_FILE "raster/micro/small_triangles.cpp"
#include "simd/for_each_target.h"

#include "raster/micro/small_list-inl.h"

SIMD_BEGIN(scanout::raster)

bool draw_all_small(const TilePlanes& tile, const BinnedList& list) {
    if (tile.id != nullptr) return draw_kind<DepthWrite::nearest>(tile, list);
    return draw_kind<DepthWrite::depth_only>(
        tile, {list.vertices, list.index, list.triangles, list.kind});
}

constexpr int kMaxSorted = 512; // at a time

// A counting sort.
SIMD_INLINE void sort_chunk(BinnedTriangle* triangles, int count) {
    constexpr int kSide = PixelBlock::kSide;
    constexpr int kHeights = 8, kMin = 3; // up to 3 rows, 4, 5, ..., 9, and 10 or more
    std::uint32_t sort[kMaxSorted + kLanes], next[kHeights * kSide] = {};
    BinnedTriangle ordered[kMaxSorted];
    for (int i = 0; i < count; i += kLanes) {
        const int left = count - i < kLanes ? count - i : kLanes;
        const I32 where = load_binned<F32::Tag>(triangles + i, left).where;
        const I32 y0 = shift_right<BinnedTriangle::kFirstRow>(where) & I32(63),
                  rows = shift_right<BinnedTriangle::kEndRow>(where) - y0;
        const I32 height = minimum(maximum(rows - I32(kMin), I32(0)), I32(kHeights - 1));
        store(height * I32(kSide) + (y0 & I32(kSide - 1)), sort + i);
    }
    for (int i = 0; i < count; ++i)
        ++next[sort[i]];
    std::uint32_t sum = 0;
    for (std::uint32_t& first : next) {
        const std::uint32_t here = first;
        first = sum;
        sum += here;
    }
    for (int i = 0; i < count; ++i)
        ordered[next[sort[i]]++] = triangles[i];
    __builtin_memcpy(triangles, ordered, static_cast<std::size_t>(count) * sizeof *triangles);
}
void sort_all(BinnedTriangle* triangles, int count) {
    for (int i = 0; i < count; i += kMaxSorted)
        sort_chunk(triangles + i, count - i < kMaxSorted ? count - i : kMaxSorted);
}

// The farthest depth that hi_z has in the blocks that triangles may touch.
SIMD_INLINE F32x8 far_depth_of_blocks(const TilePlanes& tile, I32x8 where) {
    using P = BinnedTriangle;
    constexpr int kBlocks = kTileSize / PixelBlock::kSide;
    const auto block_of = [](I32x8 pixel) { return shift_right<3>(pixel); };
    const I32x8 x0 = block_of(where & I32x8(63)),
                y0 = block_of(shift_right<P::kFirstRow>(where) & I32x8(63)),
                x1 = block_of((shift_right<P::kEndColumn>(where) & I32x8(127)) - I32x8(1)),
                y1 = block_of(shift_right<P::kEndRow>(where) - I32x8(1));
    F32x8 farthest = 0x1p127F;
    for (I32x8 y = y0; any(y <= y1); y = y + I32x8(1))
        for (I32x8 x = x0; any(x <= x1); x = x + I32x8(1)) {
            const I32x8 block = minimum(y, y1) * I32x8(kBlocks) + minimum(x, x1);
            farthest = minimum(farthest, gather(tile.hi_z, block));
        }
    return farthest;
}

// Copies the triangles that hi_z does not reject; returns how many.
int reject_occluded(const TilePlanes& tile, const BinnedList& list, BinnedTriangle* out) {
    const auto* real = reinterpret_cast<const double*>(list.vertices.data());
    const auto all = static_cast<int>(list.triangles.size());
    int left = 0;
    VertexIndices<F32x8::Tag> vertex, next;
    read_vertices(list, 0, next);
    for (int begin = 0; begin < all; begin += kLanesX8) {
        const BinnedTriangle* binned = list.triangles.data() + begin;
        const int count = all - begin < kLanesX8 ? all - begin : kLanesX8;
        vertex = next;
        read_vertices(list, begin + kLanesX8, next);
        F64x8 nearest = 0.0;
        SIMD_FOR (int k = 0; k < 3; ++k)
            nearest = maximum(nearest, gather(real + 1, shift_left<1>(load<I32x8>(vertex.at[k]))));
        const F32x8 farthest =
            far_depth_of_blocks(tile, load_binned<F32x8::Tag>(binned, count).where);
        std::uint32_t rest =
            bits(to_f32(nearest * F64x8(1 + 0x1p-20)) >= farthest) & ((2U << (count - 1)) - 1);
        for (; rest != 0; rest &= rest - 1)
            out[left++] = binned[__builtin_ctz(rest)];
    }
    return left;
}

void build_hi_z_of_all(const TilePlanes& tile) {
    constexpr int kSide = PixelBlock::kSide, kBlocks = kTileSize / kSide;
    for (int y = 0; y < kBlocks; ++y)
        for (int x = 0; x < kBlocks; ++x)
            tile.hi_z[y * kBlocks + x] = far_depth_in(tile, (y * kTileSize + x) * kSide);
}

bool occluded_in_blocks(const TilePlanes& tile, int x0, int y0, int x1, int y1, float nearest) {
    constexpr int kBlocks = kTileSize / PixelBlock::kSide;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            if (!(nearest < tile.hi_z[y * kBlocks + x]) &&
                !occludes_after_refresh(tile, x, y, nearest))
                return false;
    return true;
}

template <int kTileBits>
SIMD_INLINE void bin_lanes(const TileGrid& grid, const std::uint32_t* triangle, std::int32_t* tile,
                           std::uint32_t* where, std::int32_t* kind) {
    I32 spatial_index, from, to;
    load_interleaved(triangle, spatial_index, from, to);
    const I32 half = 0xffff, one = 1, below_flag = 0x7fff;
    const I32 x0 = from & below_flag, y0 = shift_right<16>(from) & below_flag;
    const I32 x1 = to & half, y1 = shift_right<16>(to);
    const I32 tile_x = shift_right<kTileBits>(x0), tile_y = shift_right<kTileBits>(y0);
    const auto one_tile =
        (tile_x == shift_right<kTileBits>(x1 - one)) & (tile_y == shift_right<kTileBits>(y1 - one));
    const I32 left = shift_left<kTileBits>(tile_x), top = shift_left<kTileBits>(tile_y);
    store((x0 - left) | shift_left<BinnedTriangle::kFirstRow>(y0 - top) |
              shift_left<BinnedTriangle::kEndColumn>(x1 - left) |
              shift_left<BinnedTriangle::kEndRow>(y1 - top),
          where);
    const I32 number = tile_y * I32(grid.across) + tile_x;
    store(select(one_tile & (from < I32(0)), number, I32(BinningResult::kNone)), tile);
    const auto one_block = (shift_right<3>(x0) == shift_right<3>(x1 - one)) &
                           (shift_right<3>(y0) == shift_right<3>(y1 - one));
    const I32 most = maximum(x1 - x0, y1 - y0);
    const auto is = [](SmallKind of) SIMD_LAMBDA { return I32(static_cast<std::int32_t>(of)); };
    const I32 micro = select(one_block, is(SmallKind::micro), is(SmallKind::micro_straddling));
    const I32 front = select(most <= I32(kMicroSide), micro, is(SmallKind::rows));
    const auto back_facing =
        !((from & I32(static_cast<std::int32_t>(VisibleTriangle::kBackFacing))) == I32(0));
    store(select(back_facing, is(SmallKind::back_facing), front), kind);
}

template <int kTileBits>
SIMD_INLINE void bin_each(const TileGrid& grid, const std::uint32_t* triangle, int count,
                          std::int32_t* tile, std::uint32_t* where, std::int32_t* kind) {
    for (int i = 0; i < count; i += kLanes)
        bin_lanes<kTileBits>(grid, triangle + std::ptrdiff_t{i} * 3, tile + i, where + i, kind + i);
}
void bin_all(const TileGrid& grid, const std::uint32_t* triangle, int count, std::int32_t* tile,
             std::uint32_t* where, std::int32_t* kind) {
    if (grid.bits == 6) bin_each<6>(grid, triangle, count, tile, where, kind);
    if (grid.bits == 5) bin_each<5>(grid, triangle, count, tile, where, kind);
    if (grid.bits == 4) bin_each<4>(grid, triangle, count, tile, where, kind);
    if (grid.bits == 3) bin_each<3>(grid, triangle, count, tile, where, kind);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(draw_all_small);
SIMD_REGISTER(sort_all);
SIMD_REGISTER(reject_occluded);
SIMD_REGISTER(build_hi_z_of_all);
SIMD_REGISTER(occluded_in_blocks);
SIMD_REGISTER(bin_all);

void bin_small_triangles(const TileGrid& grid, std::span<const VisibleTriangle> triangles,
                         BinningResult& out) {
    static_assert(sizeof(VisibleTriangle) == 3 * sizeof(std::uint32_t));
    if (out.tile.size() < triangles.size() + kRegisterPadding) {
        out.tile.resize(triangles.size() + kRegisterPadding);
        out.where.resize(triangles.size() + kRegisterPadding);
        out.kind.resize(triangles.size() + kRegisterPadding);
    }
    SIMD_CALL(bin_all, grid, &triangles.data()->spatial_index, static_cast<int>(triangles.size()),
              out.tile.data(), out.where.data(), out.kind.data());
}

void sort_by_rows(std::span<BinnedTriangle> triangles) {
    constexpr std::size_t kFew = 32; // are not worth it
    if (triangles.size() >= kFew)
        SIMD_CALL(sort_all, triangles.data(), static_cast<int>(triangles.size()));
}

bool draw_small_triangles(const TilePlanes& tile, const BinnedList& list) {
    return SIMD_CALL(draw_all_small, tile, list);
}

void build_hi_z(const TilePlanes& tile) {
    SIMD_CALL(build_hi_z_of_all, tile);
}

bool occludes(const TilePlanes& tile, const image::Rect& pixels, float nearest) {
    constexpr int kSide = PixelBlock::kSide;
    const auto first = [](int at, int begin) { return std::max(at - begin, 0) / kSide; };
    const auto end = [](int at, int begin) { return (at - begin + kSide - 1) / kSide; };
    const image::Rect& a = tile.area;
    return SIMD_CALL(occluded_in_blocks, tile, first(pixels.x0, a.x0), first(pixels.y0, a.y0),
                     end(std::min(pixels.x1, a.x1), a.x0), end(std::min(pixels.y1, a.y1), a.y0),
                     nearest);
}

bool draw_small_hi_z(const TilePlanes& tile, const BinnedList& list,
                     std::vector<BinnedTriangle>& scratch) {
    if (scratch.size() < list.triangles.size()) scratch.resize(list.triangles.size());
    const int left = SIMD_CALL(reject_occluded, tile, list, scratch.data());
    const auto visible =
        std::span<const BinnedTriangle>(scratch).first(static_cast<std::size_t>(left));
    return draw_small_triangles(tile,
                                {list.vertices, list.index, visible, SmallKind::rows, list.id});
}

} // namespace scanout::raster
#endif
