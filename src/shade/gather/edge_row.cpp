#include "shade/gather/edge_row.h"

#include "base/check.h"

#define SIMD_FILE "shade/gather/edge_row.cpp"
#include "simd/for_each_target.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade)

// A register of pixels from x on.
template <int kSamples>
SIMD_INLINE void find_register(const std::uint32_t* ids, std::size_t plane, int x, EdgeRow& out) {
    const I32 none = static_cast<std::int32_t>(raster::kNoPrimitive);
    const F32 one = 1.0F, zero = 0.0F, part = 1.0F / kSamples;
    I32 id[kSamples];
    F32 background = zero;
    SIMD_FOR (int s = 0; s < kSamples; ++s) {
        id[s] = load<I32>(ids + static_cast<std::size_t>(s) * plane + x);
        background = background + select(id[s] == none, one, zero);
    }
    store(background * part, out.transmittance + x);
    SIMD_FOR (int s = 0; s < kSamples; ++s) {
        auto known = id[s] == none;
        for (int before = 0; before < s; ++before)
            known = known | (id[s] == id[before]);
        F32 like = one;
        for (int after = s + 1; after < kSamples; ++after)
            like = like + select(id[s] == id[after], one, zero);
        store(like * part, out.coverage[s] + x);
        out.first[s] |= static_cast<std::uint64_t>(bits(!known)) << x;
    }
}

template <int kSamples>
SIMD_INLINE void find_row(const std::uint32_t* ids, std::size_t plane, std::uint64_t edges,
                          EdgeRow& out) {
    constexpr std::uint64_t kRegister = (std::uint64_t{1} << kLanes) - 1;
    for (int s = 0; s < kSamples; ++s)
        out.first[s] = 0;
    for (int x = 0; x < raster::kTileSize; x += kLanes)
        if ((edges >> x & kRegister) != 0) find_register<kSamples>(ids, plane, x, out);
    for (int s = 0; s < kSamples; ++s)
        out.first[s] &= edges;
}

void find(const std::uint32_t* ids, int samples, std::size_t plane, std::uint64_t edges,
          EdgeRow& out) {
    switch (samples) {
    case 2:
        return find_row<2>(ids, plane, edges, out);
    case 4:
        return find_row<4>(ids, plane, edges, out);
    case 8:
        return find_row<8>(ids, plane, edges, out);
    default:
        return find_row<16>(ids, plane, edges, out);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

SIMD_REGISTER(find);

void find_edge_row(const raster::VisibilityTile& tile, int row, std::uint64_t edges, EdgeRow& out) {
    const int samples = tile.samples();
    CHECK(samples == 2 || samples == 4 || samples == 8 || samples == 16);
    SIMD_CALL(find, tile.ids(0).data() + std::ptrdiff_t{row} * raster::kTileSize, samples,
              raster::VisibilityTile::kPlane, edges, out);
}

} // namespace scanout::shade
#endif
