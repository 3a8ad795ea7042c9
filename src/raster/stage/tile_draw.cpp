// Of raster/stage/geometry.h: drawing of one tile from the bins that run() filled.
#include "base/check.h"
#include "raster/check_lanes.h"
#include "raster/stage/geometry.h"

#include <algorithm>
#include <utility>

namespace scanout::raster {

namespace {
// Back-facing triangles in a tile: fewer are drawn sooner than tested against hi_z.
constexpr std::size_t kMinHiZTriangles = 64;
} // namespace

image::Rect Geometry::tile_area(int tile) const {
    const int size = 1 << grid_.bits;
    const int x = tile % grid_.across * size, y = tile / grid_.across * size;
    return {x, y, std::min(x + size, width_), std::min(y + size, height_)};
}

bool Geometry::is_empty(int tile) const {
    const auto at = static_cast<std::size_t>(tile);
    return std::all_of(workers_.begin(), workers_.end(), [&](const WorkerBins& worker) {
        return worker.bins[at].is_empty() &&
               (worker.not_opaque.empty() || worker.not_opaque[at].is_empty());
    });
}

void Geometry::draw(int tile, AreaTile& out) const {
    CHECK(!occlusion_.is_on());
    const auto add = [&](std::uint32_t id) {
        if (const std::optional<SetUp> t = set_up(vertices_of(id), id)) out.add(t->triangle);
    };
    for (const WorkerBins& worker : workers_) {
        const TileBin& bin = worker.bins[static_cast<std::size_t>(tile)];
        std::for_each(bin.triangles.begin(), bin.triangles.end(), add);
        bin.for_small([&](std::uint32_t spatial_index) { add(mesh_->triangle_at(spatial_index)); });
        for (const std::uint32_t i : bin.clipped)
            out.add(worker.clipped[i].triangle);
    }
    out.finish();
}

void Geometry::draw(int tile, VisibilityTile& out, DeferredTriangles* scratch) {
    draw_triangles(tile, out, scratch);
    if (!has_lines(tile)) return;
    out.keep_support(out);
    draw_lines(tile, line_support(), out);
}

void Geometry::draw_triangles(int tile, VisibilityTile& out, DeferredTriangles* scratch) {
    CHECK(!occlusion_.is_on() || scratch != nullptr);
    if (out.rule().wants_order()) {
        std::vector<std::uint32_t> order;
        return draw_in_order(tile, out, scratch != nullptr ? scratch->triangles : order);
    }
    // By another depth rule than the default one small triangles are drawn like all others.
    std::array<std::uint32_t, 64> some;
    std::size_t count = 0;
    const auto draw_some = [&] {
        const auto ids = std::span<const std::uint32_t>(some).first(std::exchange(count, 0));
        if (!ids.empty()) out.draw(TriangleList{vertices(), mesh_->index, ids, ids});
    };
    const auto add_whole = [&](std::uint32_t id) {
        some[count++] = id;
        if (count == some.size()) draw_some();
    };
    for (WorkerBins& worker : workers_) {
        TileBin& bin = worker.bins[static_cast<std::size_t>(tile)];
        if (!bin.triangles.empty())
            out.draw(TriangleList{vertices(), mesh_->index, bin.triangles, bin.triangles});
        if (out.rule().is_default()) {
            sort_by_rows(bin.small[static_cast<std::size_t>(SmallKind::rows)]);
            for (const SmallKind kind : kFrontFacingKinds)
                if (!bin.small_of(kind).empty()) out.draw_small(list_of(bin.small_of(kind), kind));
        } else {
            bin.for_small(
                [&](std::uint32_t spatial_index) { add_whole(mesh_->triangle_at(spatial_index)); });
            draw_some();
        }
        for (const std::uint32_t i : bin.clipped)
            out.draw_clipped(worker.clipped[i]);
    }
    if (out.rule().is_default()) draw_back_facing(tile, out);
    if (occlusion_.is_on()) draw_deferred(tile, out, *scratch);
    check_lanes(out);
}

void Geometry::draw_back_facing(int tile, VisibilityTile& out) const {
    bool found = false;
    for (const WorkerBins& worker : workers_) {
        const std::span<const BinnedTriangle> back_facing =
            worker.bins[static_cast<std::size_t>(tile)].small_of(SmallKind::back_facing);
        const BinnedList list = list_of(back_facing, SmallKind::rows);
        if (back_facing.size() < kMinHiZTriangles) {
            if (!back_facing.empty()) out.draw_small(list);
            continue;
        }
        if (!std::exchange(found, true)) out.build_hi_z();
        out.draw_small_hi_z(list);
    }
}

void Geometry::cull_deferred(std::size_t cluster, const image::Rect& area, DeferredTriangles& out) {
    const std::size_t begin = cluster * geom::Clusters::kTriangles,
                      end = std::min(begin + geom::Clusters::kTriangles, mesh_->triangles());
    cull_triangles(cull_, vertices(),
                   mesh_->index_in_spatial_order().subspan(begin * 3, (end - begin) * 3),
                   static_cast<std::uint32_t>(begin), out.found);
    CHECK_EQ(out.found.to_clip_count, std::size_t{0});
    std::uint64_t drawn = 0; // counted by the tile of the first pixel
    for (const VisibleTriangle& t : std::span(out.found.visible).first(out.found.visible_count)) {
        if (t.x0() >= area.x1 || t.x1() <= area.x0 || t.y0() >= area.y1 || t.y1() <= area.y0)
            continue;
        drawn += t.x0() >= area.x0 && t.y0() >= area.y0 ? 1 : 0;
        if (t.small())
            bin_small_in_tile(t, area.x0, area.y0, out.small);
        else
            out.triangles.push_back(mesh_->triangle_at(t.spatial_index));
    }
    deferred_drawn_.fetch_add(drawn, std::memory_order_relaxed);
}

void Geometry::draw_deferred(int tile, VisibilityTile& out, DeferredTriangles& deferred) {
    const auto at = static_cast<std::size_t>(tile);
    deferred.clear();
    CHECK(out.rule().is_default());
    for (const WorkerBins& worker : workers_) {
        for (const std::uint32_t i : worker.bins[at].queries)
            occlusion_.is_visible(worker.queries[i], out);
        for (const std::uint32_t i : worker.bins[at].deferred) {
            const OcclusionQuery& query = worker.queries[i];
            if (!occlusion_.is_visible(query, out)) continue;
            vertex_stage_.transform_deferred(query.cluster);
            cull_deferred(query.cluster, out.area(), deferred);
        }
    }
    if (!deferred.triangles.empty())
        out.draw(TriangleList{vertices(), mesh_->index, deferred.triangles, deferred.triangles});
    sort_by_rows(deferred.small[static_cast<std::size_t>(SmallKind::rows)]);
    for (std::size_t kind = 0; kind < kSmallKinds; ++kind)
        if (!deferred.small[kind].empty())
            out.draw_small(list_of(deferred.small[kind], static_cast<SmallKind>(kind)));
}

bool Geometry::has_lines(int tile) const {
    if (mesh_->lines() == 0 && mesh_->points() == 0) return false;
    const auto at = static_cast<std::size_t>(tile);
    return std::any_of(workers_.begin(), workers_.end(), [&](const WorkerBins& worker) {
        return !worker.bins[at].segments.empty() || !worker.bins[at].points.empty();
    });
}

void Geometry::draw_lines(int tile, const LineSupport& support, VisibilityTile& out) const {
    const auto at = static_cast<std::size_t>(tile);
    for (const WorkerBins& worker : workers_) {
        for (const std::uint32_t i : worker.bins[at].segments)
            out.draw_line(worker.segments[i], support);
        for (const std::uint32_t i : worker.bins[at].points)
            out.draw_point(worker.points[i], support);
    }
    check_lanes(out);
}

void Geometry::of_mode(int tile, AlphaMode mode, std::vector<std::uint32_t>& out) const {
    out.clear();
    for (const WorkerBins& worker : workers_) {
        if (worker.not_opaque.empty()) continue;
        const TileBin& bin = worker.not_opaque[static_cast<std::size_t>(tile)];
        for (const std::uint32_t id : bin.triangles)
            if (alpha_mode_of(id) == mode) out.push_back(id);
        for (const std::uint32_t i : bin.clipped)
            if (alpha_mode_of(worker.clipped[i].triangle.id) == mode)
                out.push_back(worker.clipped[i].triangle.id);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end()); // two clipped triangles of one
}

// Widens a box by the part of another one that lies in the area.
static void include(image::Rect& box, const image::Rect& other, const image::Rect& area) {
    box = {std::min(box.x0, std::max(other.x0, area.x0)),
           std::min(box.y0, std::max(other.y0, area.y0)),
           std::max(box.x1, std::min(other.x1, area.x1)),
           std::max(box.y1, std::min(other.y1, area.y1))};
}

image::Rect Geometry::box_of(std::uint32_t triangle, const image::Rect& area,
                             VisibilityTile* out) const {
    image::Rect box{area.x1, area.y1, area.x0, area.y0}; // of nothing
    const std::array<ScreenVertex, 3> vertex = vertices_of(triangle);
    if (vertex[0].on_screen() && vertex[1].on_screen() && vertex[2].on_screen()) {
        const std::optional<SetUp> t = set_up(vertex, triangle);
        if (t && (out == nullptr || out->draw(t->triangle)))
            include(box, pixel_bounds(t->triangle, area.x1, area.y1, cull_.extent), area);
        return box;
    }
    for (const ClippedTriangle& clipped : clipped_of(triangle))
        if (out == nullptr || out->draw_clipped(clipped))
            include(box, pixel_bounds(clipped, area.x1, area.y1, cull_.extent), area);
    return box;
}

image::Rect Geometry::draw_one(std::uint32_t triangle, VisibilityTile& out) const {
    return box_of(triangle, out.area(), &out);
}

image::Rect Geometry::pixels_of(std::uint32_t triangle, const image::Rect& area) const {
    return box_of(triangle, area, nullptr);
}

void Geometry::sort_triangles(int tile, std::vector<std::uint32_t>& out) const {
    out.clear();
    for (const WorkerBins& worker : workers_) {
        const TileBin& bin = worker.bins[static_cast<std::size_t>(tile)];
        out.insert(out.end(), bin.triangles.begin(), bin.triangles.end());
        bin.for_small(
            [&](std::uint32_t spatial_index) { out.push_back(mesh_->triangle_at(spatial_index)); });
        for (const std::uint32_t i : bin.clipped)
            out.push_back(worker.clipped[i].triangle.id);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end()); // two clipped triangles of one
}

void Geometry::draw_in_order(int tile, VisibilityTile& out,
                             std::vector<std::uint32_t>& order) const {
    CHECK(!occlusion_.is_on());
    sort_triangles(tile, order);
    for (const std::uint32_t triangle : order)
        draw_one(triangle, out);
    order.clear();
}

void Geometry::draw_each(int tile, VisibilityTile& out, ById& order, const Drawn& drawn) const {
    CHECK(!occlusion_.is_on());
    const auto at = static_cast<std::size_t>(tile);
    std::vector<std::uint32_t>& triangles = order.triangles;
    std::vector<Segment>& segments = order.segments;
    std::vector<Point>& points = order.points;
    sort_triangles(tile, triangles);
    segments.clear();
    points.clear();
    for (const WorkerBins& worker : workers_) {
        const TileBin& bin = worker.bins[at];
        for (const std::uint32_t i : bin.segments)
            segments.push_back(worker.segments[i]);
        for (const std::uint32_t i : bin.points)
            points.push_back(worker.points[i]);
    }
    const auto by_id = [](const auto& a, const auto& b) { return a.id < b.id; };
    std::sort(segments.begin(), segments.end(), by_id);
    std::sort(points.begin(), points.end(), by_id);

    const image::Rect& area = out.area();
    for (const std::uint32_t triangle : triangles)
        drawn(triangle, draw_one(triangle, out));
    const auto pixels_of = [&](const auto& primitive) {
        const image::Rect box = pixel_bounds(primitive, area.x1, area.y1);
        return image::Rect{std::max(box.x0, area.x0), std::max(box.y0, area.y0), box.x1, box.y1};
    };
    for (const Segment& segment : segments) {
        out.draw_line(segment);
        drawn(segment.id, pixels_of(segment));
    }
    for (const Point& point : points) {
        out.draw_point(point);
        drawn(point.id, pixels_of(point));
    }
}

} // namespace scanout::raster
