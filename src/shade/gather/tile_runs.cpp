#include "shade/gather/tile_runs.h"

#define SIMD_FILE "shade/gather/tile_runs.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::shade)

// ids: the row in the first sample's plane; the planes of the other samples follow `plane` ids
// apart.
SIMD_INLINE RowBits find_bits(const std::uint32_t* ids, int samples, std::size_t plane) {
    static_assert(raster::kTileSize == 64);
    RowBits row{0, 0, 0};
    const I32 none = static_cast<std::int32_t>(raster::kNoPrimitive);
    for (int x = 0; x < raster::kTileSize; x += kLanes) {
        const I32 here = load<I32>(ids + x), next = load<I32>(ids + x + 1);
        row.ends |= static_cast<std::uint64_t>(bits(!(here == next))) << x;
        row.visible |= static_cast<std::uint64_t>(bits(!(here == none))) << x;
        if (samples == 1) continue;
        auto same = here == here;
        for (int s = 1; s < samples; ++s)
            same = same & (load<I32>(ids + static_cast<std::size_t>(s) * plane + x) == here);
        row.edge |= static_cast<std::uint64_t>(bits(!same)) << x;
    }
    row.ends |= std::uint64_t{1} << (raster::kTileSize - 1);
    return row;
}

void find_all(const std::uint32_t* ids, int samples, std::size_t plane, int first, int end,
              RowBits* out) {
    for (int row = first; row < end; ++row)
        out[row] = find_bits(ids + std::ptrdiff_t{row} * raster::kTileSize, samples, plane);
}

// In a kernel's file because most targets count bits by one instruction.
void sort_out(const RowBits* rows, int first, int end, std::uint64_t columns, std::uint64_t* pixels,
              std::uint64_t* starts, std::uint64_t* ends, int* totals) {
    int count = 0, runs = 0;
    for (int row = first; row < end; ++row) {
        const RowBits& of = rows[row];
        pixels[row] = of.visible & ~of.edge & columns;
        ends[row] = of.ends | of.edge >> 1 | ~(columns >> 1);
        starts[row] = pixels[row] & ~((pixels[row] & ~ends[row]) << 1);
        count += __builtin_popcountll(pixels[row]);
        runs += __builtin_popcountll(starts[row]);
    }
    totals[0] = count;
    totals[1] = runs;
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

SIMD_REGISTER(find_all);
SIMD_REGISTER(sort_out);

void find_runs(const raster::VisibilityTile& tile, int first, int end, TileRows& out) {
    SIMD_CALL(find_all, tile.ids(0).data(), tile.samples(), raster::VisibilityTile::kPlane, first,
              end, out.data());
}

void find_interior(const TileRows& rows, int first, int end, std::uint64_t columns,
                   InteriorPixels& out) {
    int totals[2];
    SIMD_CALL(sort_out, rows.data(), first, end, columns, out.pixels.data(), out.starts.data(),
              out.ends.data(), totals);
    out.count = totals[0];
    out.runs = totals[1];
}

} // namespace scanout::shade
#endif
