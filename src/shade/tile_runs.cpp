#include "shade/tile_runs.h"

#define SIMD_FILE "shade/tile_runs.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::shade)

// ids: the row in the first sample's plane; the others follow `plane` ids apart.
RowBits find_bits(const std::uint32_t* ids, int samples, std::size_t plane) {
    static_assert(raster::kTileSize == 64);
    RowBits row{0, 0};
    for (int x = 0; x < raster::kTileSize; x += kLanes) {
        const I32 here = load<I32>(ids + x), next = load<I32>(ids + x + 1);
        row.ends |= static_cast<std::uint64_t>(bits(!(here == next))) << x;
        if (samples == 1) continue;
        auto same = here == here;
        for (int s = 1; s < samples; ++s)
            same = same & (load<I32>(ids + static_cast<std::size_t>(s) * plane + x) == here);
        row.shared |= static_cast<std::uint64_t>(bits(!same)) << x;
    }
    row.ends |= std::uint64_t{1} << (raster::kTileSize - 1);
    return row;
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

SIMD_REGISTER(find_bits);

RowBits row_bits(const raster::VisibilityTile& tile, int row) {
    const std::uint32_t* ids =
        tile.ids(0).data() + static_cast<std::size_t>(row * raster::kTileSize);
    return SIMD_CALL(find_bits)(ids, tile.samples(), raster::VisibilityTile::kPlane);
}

} // namespace scanout::shade
#endif
