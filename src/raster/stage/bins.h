// Tile bins: each worker of the geometry stage has a bin for each tile, with the primitives that
// may touch the tile. The contents of a tile do not depend on which worker found them.
#pragma once

#include "raster/clipped/clipped_setup.h"
#include "raster/culling/cluster_cull.h"
#include "raster/culling/cull.h"
#include "raster/culling/depth_sort.h"
#include "raster/micro/small_triangles.h"
#include "raster/screen/primitive.h"

#include <cstdint>
#include <vector>

namespace scanout::raster {

// The bin of one tile and one worker. Unclipped triangles are stored as ids, small ones as
// BinnedTriangle: four or eight bytes each instead of sixty, and the tile that draws them sets them
// up again. All other numbers are indices into the WorkerBins.
struct TileBin {
    std::vector<std::uint32_t> triangles, clipped, segments, points;
    // Clusters: deferred ones, and queried ones that are drawn at once.
    std::vector<std::uint32_t> deferred, queries;
    BinnedByKind small;
    // Triangles that may cover whole blocks, until prepend_large() sorts them front to back and
    // puts them before the other `triangles`, so that they occlude those drawn later. Saves 4.6 %
    // of the instructions of a building from inside, 1.5 % of those of the Cornell box.
    std::vector<DepthAndId> large;

    const std::vector<BinnedTriangle>& small_of(SmallKind kind) const {
        return small[static_cast<std::size_t>(kind)];
    }
    // Calls f(spatial index) for the small triangles.
    template <class F>
    void for_small(F&& f) const {
        for (const auto& of_kind : small)
            for (const BinnedTriangle& binned : of_kind)
                f(binned.spatial_index);
    }
    void prepend_large();
    bool is_empty() const; // queries may remain
    void clear();
};

struct OcclusionQuery {
    std::uint32_t cluster;
    ClusterBounds bounds;
};

struct WorkerBins {
    std::vector<ClippedSetup> clipped;
    std::vector<Segment> segments;
    std::vector<Point> points;
    std::vector<OcclusionQuery> queries;
    std::vector<TileBin> bins;
    std::vector<TileBin> not_opaque; // cut-outs and blended ones; no bins where all are opaque
    CullResult found;                // scratch: of one chunk
    BinningResult binning;           // scratch: of its visible triangles
    std::uint64_t triangles_drawn = 0;
    bool has_clipped = false; // some triangle was

    void clear(int tiles, bool alpha_modes);
};

// Appends to a bin and prefetches the cache line that it writes next: with one list a tile, there
// are too many streams for the hardware prefetcher.
inline void append(std::vector<BinnedTriangle>& bin, BinnedTriangle triangle) {
    constexpr std::size_t kLine = 64; // bytes of a cache line
    bin.push_back(triangle);
    __builtin_prefetch(&bin.back() + kLine / sizeof(BinnedTriangle), 1);
}

} // namespace scanout::raster
