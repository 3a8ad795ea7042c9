// Occlusion culling of clusters: each tile that a deferred cluster may touch queries, when its
// others are drawn, whether they occlude it, and transforms, culls and draws it only if not. Some
// clusters that are drawn at once are queried, too, for the frames to come.
#include "base/check.h"
#include "raster/stage/geometry.h"

#include <algorithm>
#include <atomic>

namespace scanout::raster {
namespace {
// A deferred cluster is all on the screen, because tiles do not clip triangles, and touches few
// tiles, because each culls it anew.
constexpr int kMaxTiles = 9;
} // namespace

bool Geometry::defers(Batch& batch, std::size_t cluster) const {
    using Action = OcclusionHistory::Action;
    const Action action = occlusion_ == nullptr ? Action::draw : occlusion_->next_action(cluster);
    if (action == Action::draw) return false;
    const auto bounds = cluster_cull_->bounds(mesh_->clusters.cluster[cluster]);
    int touched = 0;
    if (bounds) for_tiles(bounds->pixels, [&](std::size_t) { ++touched; });
    if (!bounds || touched > kMaxTiles) {
        occlusion_->set_visible(cluster); // draws it without a query in the next frame
        return false;
    }
    const auto number = static_cast<std::uint32_t>(batch.queries.size());
    batch.queries.push_back({static_cast<std::uint32_t>(cluster), *bounds});
    const auto list = action == Action::defer ? &Batch::Bin::deferred : &Batch::Bin::queries;
    for_tiles(bounds->pixels,
              [&](std::size_t tile) { (batch.bins[tile].*list).push_back(number); });
    return action == Action::defer;
}

void Geometry::transform_deferred(std::size_t cluster) {
    for (const std::uint32_t group : mesh_->clusters.vertex_groups_of(cluster)) {
        const std::atomic_ref needed(needed_groups_[group]);
        if (needed.load(std::memory_order_acquire) != 0) continue;
        const std::scoped_lock lock(deferred_locks_[group % deferred_locks_.size()]);
        if (needed.load(std::memory_order_relaxed) != 0) continue;
        transform_groups(group, group + 1);
        needed.store(1, std::memory_order_release);
    }
}

void Geometry::cull_deferred(std::size_t cluster, const image::Rect& area, DeferredTriangles& out) {
    const std::size_t begin = cluster * geom::Clusters::kTriangles,
                      end = std::min(begin + geom::Clusters::kTriangles, mesh_->triangles());
    cull(cull_, vertices_, mesh_->index_in_spatial_order().subspan(begin * 3, (end - begin) * 3),
         static_cast<std::uint32_t>(begin), out.found);
    CHECK_EQ(out.found.to_clip_count, std::size_t{0});
    std::uint64_t drawn = 0; // counted by the tile of the first pixel
    for (const VisibleTriangle& t : std::span(out.found.visible).first(out.found.visible_count)) {
        if (t.x0() >= area.x1 || t.x1() <= area.x0 || t.y0() >= area.y1 || t.y1() <= area.y0)
            continue;
        drawn += t.x0() >= area.x0 && t.y0() >= area.y0 ? 1 : 0;
        if (t.small())
            bin_small_part(t, area.x0, area.y0, out.small);
        else
            out.triangles.push_back(mesh_->triangle_at(t.spatial_index));
    }
    deferred_drawn_.fetch_add(drawn, std::memory_order_relaxed);
}

void Geometry::draw_deferred(int tile, VisibilityTile& out) {
    const auto at = static_cast<std::size_t>(tile);
    DeferredTriangles& deferred = out.deferred();
    deferred.clear();
    CHECK(out.rule().is_default());
    const auto shows = [&](const Batch::OcclusionQuery& a) {
        if (out.hides(a.bounds.pixels, a.bounds.nearest)) return false;
        occlusion_->set_visible(a.cluster);
        return true;
    };
    for (const Batch& batch : batches_) {
        for (const std::uint32_t i : batch.bins[at].queries)
            shows(batch.queries[i]);
        for (const std::uint32_t i : batch.bins[at].deferred) {
            const Batch::OcclusionQuery& a = batch.queries[i];
            if (!shows(a)) continue;
            transform_deferred(a.cluster);
            cull_deferred(a.cluster, out.area(), deferred);
        }
    }
    if (!deferred.triangles.empty())
        out.draw(TriangleList{vertices_, mesh_->index, deferred.triangles, deferred.triangles});
    sort_by_rows(deferred.small[static_cast<std::size_t>(SmallKind::rows)]);
    for (std::size_t kind = 0; kind < kSmallKinds; ++kind)
        if (!deferred.small[kind].empty())
            out.draw(list_of(deferred.small[kind], static_cast<SmallKind>(kind)));
}

} // namespace scanout::raster
