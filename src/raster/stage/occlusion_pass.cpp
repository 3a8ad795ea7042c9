#include "raster/stage/occlusion_pass.h"

#include <cstdint>

namespace scanout::raster {

void OcclusionPass::begin(OcclusionHistory* history, std::size_t clusters) {
    history_ = history;
    if (is_on() && clusters > 0) history_->begin_frame(clusters);
}

bool OcclusionPass::defers(const ClusterCull& cull, const geom::Cluster& cluster,
                           std::size_t number, const TileGrid& grid, WorkerBins& worker) const {
    // A deferred cluster lies on the screen entirely, because tiles do not clip triangles, and
    // touches few tiles, because each tile culls it anew.
    constexpr int kMaxTiles = 9;
    using Action = OcclusionHistory::Action;
    const Action action = is_on() ? history_->next_action(number) : Action::draw;
    if (action == Action::draw) return false;
    const auto bounds = cull.bounds(cluster);
    int touched = 0;
    if (bounds) grid.for_tiles(bounds->pixels, [&](std::size_t) { ++touched; });
    if (!bounds || touched > kMaxTiles) {
        history_->set_visible(number); // draws it without a query in the next frame
        return false;
    }
    const auto query = static_cast<std::uint32_t>(worker.queries.size());
    worker.queries.push_back({static_cast<std::uint32_t>(number), *bounds});
    const auto list = action == Action::defer ? &TileBin::deferred : &TileBin::queries;
    grid.for_tiles(bounds->pixels,
                   [&](std::size_t tile) { (worker.bins[tile].*list).push_back(query); });
    return action == Action::defer;
}

bool OcclusionPass::is_visible(const OcclusionQuery& query, VisibilityTile& tile) const {
    if (tile.occludes(query.bounds.pixels, query.bounds.nearest)) return false;
    history_->set_visible(query.cluster);
    return true;
}

} // namespace scanout::raster
