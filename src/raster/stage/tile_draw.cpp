// Of raster/stage/geometry.h: drawing of one tile from the bins that run() filled.
#include "base/check.h"
#include "raster/check_lanes.h"
#include "raster/stage/geometry.h"

#include <algorithm>
#include <utility>

namespace scanout::raster {

namespace {
constexpr std::size_t kMinHiZTriangles =
    64; // in a tile: fewer are drawn sooner than tested against hi_z
} // namespace

template <class F>
void Geometry::Batch::Bin::for_small(F&& f) const {
    for (const auto& all : small)
        for (const BinnedTriangle& binned : all)
            f(binned.spatial_index);
}

image::Rect Geometry::tile_area(int tile) const {
    const int x = tile % across_ * tile_size_, y = tile / across_ * tile_size_;
    return {x, y, std::min(x + tile_size_, width_), std::min(y + tile_size_, height_)};
}

bool Geometry::is_empty(int tile) const {
    const auto at = static_cast<std::size_t>(tile);
    const auto bare = [](const Batch::Bin& bin) {
        return bin.triangles.empty() && bin.clipped.empty() && bin.segments.empty() &&
               bin.points.empty() && bin.deferred.empty() &&
               std::all_of(bin.small.begin(), bin.small.end(),
                           [](const auto& small) { return small.empty(); });
    };
    return std::all_of(batches_.begin(), batches_.end(), [&](const Batch& batch) {
        return bare(batch.bins[at]) && (batch.not_opaque.empty() || bare(batch.not_opaque[at]));
    });
}

void Geometry::draw(int tile, AreaTile& out) const {
    CHECK(occlusion_ == nullptr);
    const auto add = [&](std::uint32_t id) {
        if (const std::optional<SetUp> t = set_up(vertices_of(id), id)) out.add(t->triangle);
    };
    for (const Batch& batch : batches_) {
        const Batch::Bin& bin = batch.bins[static_cast<std::size_t>(tile)];
        std::for_each(bin.triangles.begin(), bin.triangles.end(), add);
        bin.for_small([&](std::uint32_t spatial_index) { add(mesh_->triangle_at(spatial_index)); });
        for (const std::uint32_t i : bin.clipped)
            out.add(batch.clipped[i].triangle);
    }
    out.finish();
}

void Geometry::draw(int tile, VisibilityTile& out) {
    draw_triangles(tile, out);
    draw_lines(tile, out, out);
}

void Geometry::draw_triangles(int tile, VisibilityTile& out) {
    // By another depth rule than the default one small triangles are drawn like all others.
    std::array<std::uint32_t, 64> some;
    std::size_t count = 0;
    const auto draw_some = [&] {
        const auto ids = std::span<const std::uint32_t>(some).first(std::exchange(count, 0));
        if (!ids.empty()) out.draw(TriangleList{vertices_, mesh_->index, ids, ids});
    };
    const auto add_whole = [&](std::uint32_t id) {
        some[count++] = id;
        if (count == some.size()) draw_some();
    };
    for (Batch& batch : batches_) {
        Batch::Bin& bin = batch.bins[static_cast<std::size_t>(tile)];
        if (!bin.triangles.empty())
            out.draw(TriangleList{vertices_, mesh_->index, bin.triangles, bin.triangles});
        if (out.rule().is_default()) {
            sort_by_rows(bin.small[static_cast<std::size_t>(SmallKind::rows)]);
            for (const SmallKind kind : kFrontFacingKinds)
                if (!bin.small_of(kind).empty()) out.draw(list_of(bin.small_of(kind), kind));
        } else {
            bin.for_small(
                [&](std::uint32_t spatial_index) { add_whole(mesh_->triangle_at(spatial_index)); });
            draw_some();
        }
        for (const std::uint32_t i : bin.clipped)
            out.draw(batch.clipped[i]);
    }
    if (out.rule().is_default()) draw_back_facing(tile, out);
    if (occlusion_ != nullptr) draw_deferred(tile, out);
    check_lanes(out);
}

void Geometry::draw_back_facing(int tile, VisibilityTile& out) const {
    bool found = false;
    for (const Batch& batch : batches_) {
        const std::span<const BinnedTriangle> backs =
            batch.bins[static_cast<std::size_t>(tile)].small_of(SmallKind::back_facing);
        const BinnedList list = list_of(backs, SmallKind::rows);
        if (backs.size() < kMinHiZTriangles) {
            if (!backs.empty()) out.draw(list);
            continue;
        }
        if (!std::exchange(found, true)) out.build_hi_z();
        out.draw_behind(list);
    }
}

void Geometry::draw_lines(int tile, const VisibilityTile& shown, VisibilityTile& out) const {
    if (mesh_->lines() == 0 && mesh_->points() == 0) return;
    const auto at = static_cast<std::size_t>(tile);
    const auto bare = [&](const Batch& batch) {
        return batch.bins[at].segments.empty() && batch.bins[at].points.empty();
    };
    if (std::all_of(batches_.begin(), batches_.end(), bare)) return;
    out.keep_support(shown);
    const LineSupport support(*mesh_, vertices_, *transform_);
    for (const Batch& batch : batches_) {
        for (const std::uint32_t i : batch.bins[at].segments)
            out.draw(batch.segments[i], support);
        for (const std::uint32_t i : batch.bins[at].points)
            out.draw(batch.points[i], support);
    }
    check_lanes(out);
}

void Geometry::of_mode(int tile, AlphaMode mode, std::vector<std::uint32_t>& out) const {
    out.clear();
    for (const Batch& batch : batches_) {
        if (batch.not_opaque.empty()) continue;
        const Batch::Bin& bin = batch.not_opaque[static_cast<std::size_t>(tile)];
        for (const std::uint32_t id : bin.triangles)
            if (alpha_mode_of(id) == mode) out.push_back(id);
        for (const std::uint32_t i : bin.clipped)
            if (alpha_mode_of(batch.clipped[i].triangle.id) == mode)
                out.push_back(batch.clipped[i].triangle.id);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end()); // two clipped triangles of one
}

image::Rect Geometry::draw_one(std::uint32_t triangle, VisibilityTile& out) const {
    const image::Rect& area = out.area();
    image::Rect drawn{area.x1, area.y1, area.x0, area.y0};
    const auto add = [&](const image::Rect& r) {
        drawn = {std::min(drawn.x0, std::max(r.x0, area.x0)),
                 std::min(drawn.y0, std::max(r.y0, area.y0)), std::max(drawn.x1, r.x1),
                 std::max(drawn.y1, r.y1)};
    };
    const std::array<ScreenVertex, 3> vertex = vertices_of(triangle);
    if (vertex[0].on_screen() && vertex[1].on_screen() && vertex[2].on_screen()) {
        const std::optional<SetUp> t = set_up(vertex, triangle);
        if (t && out.draw(t->triangle))
            add(pixel_bounds(t->triangle, area.x1, area.y1, cull_.extent));
        return drawn;
    }
    for (const ClippedTriangle& clipped : clipped_of(triangle))
        if (out.draw(clipped)) add(pixel_bounds(clipped, area.x1, area.y1, cull_.extent));
    return drawn;
}

void Geometry::draw_each(int tile, VisibilityTile& out, ById& order, const Drawn& drawn) const {
    CHECK(occlusion_ == nullptr);
    const auto at = static_cast<std::size_t>(tile);
    std::vector<std::uint32_t>& triangles = order.triangles;
    std::vector<Segment>& segments = order.segments;
    std::vector<Point>& points = order.points;
    triangles.clear();
    segments.clear();
    points.clear();
    for (const Batch& batch : batches_) {
        const Batch::Bin& bin = batch.bins[at];
        triangles.insert(triangles.end(), bin.triangles.begin(), bin.triangles.end());
        bin.for_small([&](std::uint32_t spatial_index) {
            triangles.push_back(mesh_->triangle_at(spatial_index));
        });
        for (const std::uint32_t i : bin.clipped)
            triangles.push_back(batch.clipped[i].triangle.id);
        for (const std::uint32_t i : bin.segments)
            segments.push_back(batch.segments[i]);
        for (const std::uint32_t i : bin.points)
            points.push_back(batch.points[i]);
    }
    const auto by_id = [](const auto& a, const auto& b) { return a.id < b.id; };
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()),
                    triangles.end()); // two clipped triangles of one
    std::sort(segments.begin(), segments.end(), by_id);
    std::sort(points.begin(), points.end(), by_id);

    const image::Rect& area = out.area();
    for (const std::uint32_t triangle : triangles)
        drawn(triangle, draw_one(triangle, out));
    const auto draw_all = [&](const auto& primitives) {
        for (const auto& primitive : primitives) {
            out.draw(primitive);
            const image::Rect box = pixel_bounds(primitive, area.x1, area.y1);
            drawn(primitive.id,
                  {std::max(box.x0, area.x0), std::max(box.y0, area.y0), box.x1, box.y1});
        }
    };
    draw_all(segments);
    draw_all(points);
}

} // namespace scanout::raster
