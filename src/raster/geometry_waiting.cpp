// Clusters that wait: each tile that one may touch asks, when its others are drawn, whether they
// hide it, and only if not is it transformed, culled and drawn. And of some that are drawn at once
// tiles say the same, for the frames to come.
#include "base/check.h"
#include "raster/geometry.h"

#include <algorithm>
#include <atomic>

namespace scanout::raster {
namespace {
// One that waits is all on the screen, because tiles do not cut triangles, and touches few of them,
// because each culls it anew.
constexpr int kMostTiles = 9;
} // namespace

bool Geometry::waits(Batch& batch, std::size_t cluster) const {
    using Order = HiddenClusters::Order;
    const Order order = hidden_ == nullptr ? Order::draw : hidden_->order(cluster);
    if (order == Order::draw) return false;
    const auto bounds = cluster_cull_->bounds(mesh_->clusters.cluster[cluster]);
    int touched = 0;
    if (bounds) for_tiles(bounds->pixels, [&](std::size_t) { ++touched; });
    if (!bounds || touched > kMostTiles) {
        hidden_->show(cluster); // as good as
        return false;
    }
    const auto number = static_cast<std::uint32_t>(batch.asked.size());
    batch.asked.push_back({static_cast<std::uint32_t>(cluster), *bounds});
    const auto list = order == Order::wait ? &Batch::Bin::waiting : &Batch::Bin::asked;
    for_tiles(bounds->pixels,
              [&](std::size_t tile) { (batch.bins[tile].*list).push_back(number); });
    return order == Order::wait;
}

void Geometry::transform_late(std::size_t cluster) {
    for (const std::uint32_t block : mesh_->clusters.blocks_of(cluster)) {
        const std::atomic_ref needed(needed_[block]);
        if (needed.load(std::memory_order_acquire) != 0) continue;
        const std::scoped_lock lock(late_[block % late_.size()]);
        if (needed.load(std::memory_order_relaxed) != 0) continue;
        transform_blocks(block, block + 1);
        needed.store(1, std::memory_order_release);
    }
}

void Geometry::find_late(std::size_t cluster, const image::Rect& area, LateParts& out) {
    const std::size_t begin = cluster * geom::Clusters::kTriangles,
                      end = std::min(begin + geom::Clusters::kTriangles, mesh_->triangles());
    cull(cull_, vertices_, mesh_->index_by_place().subspan(begin * 3, (end - begin) * 3),
         static_cast<std::uint32_t>(begin), out.found);
    CHECK_EQ(out.found.cut_count, std::size_t{0});
    std::uint64_t drawn = 0; // each by the tile of its first pixel
    for (const KeptTriangle& t : std::span(out.found.kept).first(out.found.kept_count)) {
        if (t.x0() >= area.x1 || t.x1() <= area.x0 || t.y0() >= area.y1 || t.y1() <= area.y0)
            continue;
        drawn += t.x0() >= area.x0 && t.y0() >= area.y0 ? 1 : 0;
        if (t.small())
            add_part(t, area.x0, area.y0, out.parts);
        else
            out.triangles.push_back(mesh_->triangle_at(t.place));
    }
    late_drawn_.fetch_add(drawn, std::memory_order_relaxed);
}

void Geometry::draw_waiting(int tile, VisibilityTile& out) {
    const auto at = static_cast<std::size_t>(tile);
    LateParts& late = out.late_parts();
    late.clear();
    CHECK(out.rule().usual());
    const auto shows = [&](const Batch::Asked& a) {
        if (out.hides(a.bounds.pixels, a.bounds.nearest)) return false;
        hidden_->show(a.cluster);
        return true;
    };
    for (const Batch& batch : batches_) {
        for (const std::uint32_t i : batch.bins[at].asked)
            shows(batch.asked[i]);
        for (const std::uint32_t i : batch.bins[at].waiting) {
            const Batch::Asked& a = batch.asked[i];
            if (!shows(a)) continue;
            transform_late(a.cluster);
            find_late(a.cluster, out.area(), late);
        }
    }
    if (!late.triangles.empty())
        out.draw(TriangleList{vertices_, mesh_->index, late.triangles, late.triangles});
    order_strips(late.parts[static_cast<std::size_t>(PartKind::strip)]);
    for (std::size_t kind = 0; kind < kPartKinds; ++kind)
        if (!late.parts[kind].empty())
            out.draw(list_of(late.parts[kind], static_cast<PartKind>(kind)));
}

} // namespace scanout::raster
