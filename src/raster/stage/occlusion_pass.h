// Occlusion culling of clusters within a frame: each tile that a deferred cluster may touch
// queries, when its others are drawn, whether they occlude it, and transforms, culls and draws it
// only if not. Some clusters that are drawn at once are queried, too, for the frames to come.
#pragma once

#include "raster/culling/cluster_cull.h"
#include "raster/culling/occlusion.h"
#include "raster/screen/tile_grid.h"
#include "raster/stage/bins.h"
#include "raster/tile/tile.h"

#include <cstddef>

namespace scanout::raster {

class OcclusionPass {
public:
    // history: null where no cluster is deferred or queried.
    void begin(OcclusionHistory* history, std::size_t clusters);
    bool is_on() const { return history_ != nullptr; }
    // Is a cluster deferred? Bins it, and a queried one, in the tiles that it may touch.
    bool defers(const ClusterCull& cull, const geom::Cluster& cluster, std::size_t number,
                const TileGrid& grid, WorkerBins& worker) const;
    // The query, when the tile has drawn all clusters that are not deferred.
    bool is_visible(const OcclusionQuery& query, VisibilityTile& tile) const;

private:
    OcclusionHistory* history_ = nullptr;
};

} // namespace scanout::raster
