// Occlusion culling of clusters within a frame. A tile that a deferred cluster may touch draws its
// other clusters, queries whether they occlude the deferred one, and only if not, transforms, culls
// and draws it. Some clusters that are drawn at once are also queried, for later frames.
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
    // Is a cluster deferred? Bins it, or a queried one, in the tiles that it may touch.
    bool defers(const ClusterCull& cull, const geom::Cluster& cluster, std::size_t number,
                const TileGrid& grid, WorkerBins& worker) const;
    // Runs the query, when the tile has drawn all clusters that are not deferred.
    bool is_visible(const OcclusionQuery& query, VisibilityTile& tile) const;

private:
    OcclusionHistory* history_ = nullptr;
};

} // namespace scanout::raster
