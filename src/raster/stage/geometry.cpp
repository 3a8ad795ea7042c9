#include "raster/stage/geometry.h"

#include "base/check.h"
#include "base/memory.h"
#include "raster/check_lanes.h"
#include "raster/screen/clip.h"

#include <algorithm>
#include <atomic>
#include <bit>

namespace scanout::raster {

namespace {
constexpr int kLarge = 16;           // pixels each way: some block of 8 x 8 may be covered whole
constexpr std::size_t kChunk = 4096; // vertices, triangles or clusters: a worker's next work

int chunks(std::size_t n) {
    return static_cast<int>((n + kChunk - 1) / kChunk);
}
} // namespace

void Geometry::run(Jobs& jobs, const geom::Mesh& mesh, const ScreenTransform& transform,
                   const GeometryOptions& options) {
    const int size = options.tile_size;
    CHECK(std::has_single_bit(static_cast<unsigned>(size)) && size >= 8 && size <= kTileSize);
    width_ = options.width;
    height_ = options.height;
    grid_ = {std::countr_zero(static_cast<unsigned>(size)), (width_ + size - 1) / size};
    down_ = (height_ + size - 1) / size;
    const auto pattern = options.areas     ? std::span<const SampleOffset>()
                         : options.centres ? pattern_and_centre(options.samples)
                                           : sample_pattern(options.samples);
    cull_ = {width_,
             height_,
             options.keep,
             options.mirrored,
             options.areas ? SampleExtent{} : extent_of(pattern),
             pattern};
    mesh_ = &mesh;
    first_line_ =
        options.first_line > 0 ? options.first_line : static_cast<std::uint32_t>(mesh.triangles());
    line_width_ = options.line_width;
    point_size_ = options.point_size;
    transform_ = transform;
    alpha_modes_.assign(options.alpha_modes.begin(), options.alpha_modes.end());
    one_sided_.assign(options.one_sided.begin(), options.one_sided.end());
    CHECK(one_sided_.empty() || options.keep == Facing::any); // which marks back faces
    deferred_drawn_ = 0;
    CHECK(options.occlusion == nullptr || (alpha_modes_.empty() && one_sided_.empty()));
    CHECK_LE(mesh.position.size(), kMaxVertices);
    workers_.resize(static_cast<std::size_t>(jobs.threads()));
    for (WorkerBins& worker : workers_)
        worker.clear(tiles(), !alpha_modes_.empty());

    // Lines and points are few and belong to no cluster: with them all vertices are needed.
    const bool others = !options.triangles_only && mesh.lines() + mesh.points() > 0;
    vertex_stage_.begin(mesh, *transform_, mesh.clusters.empty() || others || options.all_vertices);
    occlusion_.begin(options.occlusion, mesh.clusters.cluster.size());
    find_visible_clusters(jobs);
    vertex_stage_.transform(jobs);

    const auto run_all = [&](std::size_t count, auto add) {
        jobs.for_each(chunks(count), [&](int chunk, int number) {
            const std::size_t begin = static_cast<std::size_t>(chunk) * kChunk;
            add(workers_[static_cast<std::size_t>(number)], begin, std::min(count, begin + kChunk));
        });
    };
    run_all(mesh.triangles(), [&](WorkerBins& worker, std::size_t begin, std::size_t end) {
        bin_visible(worker, begin, end);
    });
    jobs.for_each(tiles(), [&](int tile, int) {
        for (WorkerBins& worker : workers_)
            worker.bins[static_cast<std::size_t>(tile)].prepend_large();
    });
    if (options.triangles_only) return;
    run_all(mesh.lines(), [&](WorkerBins& worker, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            bin_segment(worker, static_cast<std::uint32_t>(i));
    });
    run_all(mesh.points(), [&](WorkerBins& worker, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            bin_point(worker, static_cast<std::uint32_t>(i));
    });
}

void Geometry::find_visible_clusters(Jobs& jobs) {
    using geom::Clusters;
    const Clusters& clusters = mesh_->clusters;
    visible_clusters_.clear();
    if (clusters.empty()) return;
    CHECK_EQ(clusters.cluster.size(),
             (mesh_->triangles() + Clusters::kTriangles - 1) / Clusters::kTriangles);
    visible_clusters_.resize(clusters.cluster.size());
    const ClusterCull cluster_cull(*transform_, cull_.keep);
    jobs.for_each(chunks(visible_clusters_.size()), [&](int chunk, int worker) {
        const std::size_t begin = static_cast<std::size_t>(chunk) * kChunk;
        WorkerBins& bins = workers_[static_cast<std::size_t>(worker)];
        const std::size_t end = std::min(visible_clusters_.size(), begin + kChunk);
        cluster_cull.find_culled(std::span(clusters.cluster).subspan(begin, end - begin),
                                 visible_clusters_.data() + begin);
        for (std::size_t c = begin; c < end; ++c) {
            const bool culled = visible_clusters_[c] != 0;
            const bool draws =
                !culled && !occlusion_.defers(cluster_cull, clusters.cluster[c], c, grid_, bins);
            visible_clusters_[c] = draws ? 1 : 0;
            if (draws) vertex_stage_.need(c);
        }
    });
}

void Geometry::bin_visible(WorkerBins& worker, std::size_t begin, std::size_t end) const {
    if (visible_clusters_.empty()) return bin_triangles(worker, begin, end);
    constexpr std::size_t kCluster = geom::Clusters::kTriangles;
    static_assert(kChunk % kCluster == 0);
    const std::size_t last = (end + kCluster - 1) / kCluster;
    for (std::size_t c = begin / kCluster; c < last; ++c) {
        const std::size_t from = c;
        while (c < last && visible_clusters_[c] != 0)
            ++c;
        if (c > from) bin_triangles(worker, from * kCluster, std::min(c * kCluster, end));
    }
}

std::array<ScreenVertex, 3> Geometry::vertices_of(std::uint32_t triangle) const {
    const std::uint32_t* index = mesh_->index.data() + std::size_t{triangle} * 3;
    return {vertices()[index[0]], vertices()[index[1]], vertices()[index[2]]};
}

void Geometry::bin_large(WorkerBins& worker, const VisibleTriangle& t,
                         std::uint32_t triangle) const {
    double nearest = 0;
    for (const ScreenVertex& v : vertices_of(triangle))
        nearest = std::max(nearest, v.depth);
    const DepthAndId key = depth_and_id(static_cast<float>(nearest), triangle);
    grid_.for_tiles(t.x0(), t.y0(), t.x1(), t.y1(),
                    [&](std::size_t tile) { worker.bins[tile].large.push_back(key); });
}

void Geometry::bin_small(WorkerBins& worker, const VisibleTriangle& t) const {
    for (int y = t.y0() >> grid_.bits; y <= (t.y1() - 1) >> grid_.bits; ++y)
        for (int x = t.x0() >> grid_.bits; x <= (t.x1() - 1) >> grid_.bits; ++x)
            bin_small_in_tile(t, x << grid_.bits, y << grid_.bits,
                              worker.bins[static_cast<std::size_t>(y * grid_.across + x)].small);
}

void Geometry::bin_small_in_tile(const VisibleTriangle& t, int left, int top,
                                 BinnedByKind& small) const {
    const auto clamped = [&](int at, int begin) {
        return std::clamp(at - begin, 0, 1 << grid_.bits);
    };
    const int x0 = clamped(t.x0(), left), x1 = clamped(t.x1(), left);
    const int y0 = clamped(t.y0(), top), y1 = clamped(t.y1(), top);
    const bool micro = std::max(x1 - x0, y1 - y0) <= kMicroSide;
    const SmallKind kind = t.back_facing() ? SmallKind::back_facing
                           : micro         ? SmallKind::micro_straddling
                                           : SmallKind::rows;
    append(small[static_cast<std::size_t>(kind)],
           BinnedTriangle::of(t.spatial_index, x0, y0, x1, y1));
}

void Geometry::bin_triangles(WorkerBins& worker, std::size_t begin, std::size_t end) const {
    CullResult& found = worker.found;
    cull_triangles(cull_, vertices(),
                   mesh_->index_in_spatial_order().subspan(begin * 3, (end - begin) * 3),
                   static_cast<std::uint32_t>(begin), found);
    const auto visible = std::span<const VisibleTriangle>(found.visible).first(found.visible_count);
    bin_small_triangles(grid_, visible, worker.binning);
    const std::span<TileBin> bins = worker.bins;
    const bool not_opaque = !alpha_modes_.empty(), some_one_sided = !one_sided_.empty();
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < visible.size(); ++i) {
        const VisibleTriangle& t = visible[i];
        if (some_one_sided && t.back_facing() &&
            is_one_sided(mesh_->triangle_at(t.spatial_index))) {
            ++left_out;
            continue;
        }
        if (not_opaque) {
            const std::uint32_t triangle = mesh_->triangle_at(t.spatial_index);
            const AlphaMode mode = alpha_mode_of(triangle);
            if (mode == AlphaMode::nothing) continue;
            if (mode != AlphaMode::opaque) {
                grid_.for_tiles(t.x0(), t.y0(), t.x1(), t.y1(), [&](std::size_t tile) {
                    worker.not_opaque[tile].triangles.push_back(triangle);
                });
                continue;
            }
        }
        const std::int32_t tile = worker.binning.tile[i];
        if (tile != BinningResult::kNone) {
            append(bins[static_cast<std::size_t>(tile)]
                       .small[static_cast<std::size_t>(worker.binning.kind[i])],
                   {t.spatial_index, worker.binning.where[i]});
        } else if (t.small()) {
            bin_small(worker, t);
        } else {
            const std::uint32_t triangle = mesh_->triangle_at(t.spatial_index);
            if (t.x1() - t.x0() >= kLarge && t.y1() - t.y0() >= kLarge)
                bin_large(worker, t, triangle);
            else
                grid_.for_tiles(t.x0(), t.y0(), t.x1(), t.y1(),
                                [&](std::size_t at) { bins[at].triangles.push_back(triangle); });
        }
    }
    worker.triangles_drawn += visible.size() - left_out;
    worker.has_clipped |= found.to_clip_count > 0;
    for (std::size_t i = 0; i < found.to_clip_count; ++i)
        bin_clipped(worker, mesh_->triangle_at(found.to_clip[i]));
}

std::uint32_t Geometry::flags(std::uint32_t vertex) const {
    const ScreenVertex& v = vertices()[vertex];
    return v.on_screen() ? transform_->classify(transform_->to_clip(mesh_->position[vertex]))
                         : v.flags();
}

void Geometry::bin_clipped(WorkerBins& worker, std::uint32_t triangle) const {
    const AlphaMode mode = alpha_modes_.empty() ? AlphaMode::opaque : alpha_mode_of(triangle);
    if (mode == AlphaMode::nothing) return;
    std::vector<TileBin>& bins = mode == AlphaMode::opaque ? worker.bins : worker.not_opaque;
    const std::uint32_t* index = mesh_->index.data() + std::size_t{triangle} * 3;
    if ((flags(index[0]) & flags(index[1]) & flags(index[2]) & kOutsideMask) != 0) return;
    bool drawn = false;
    for (const ClippedTriangle& clipped : clipped_of(triangle)) {
        const image::Rect bounds = pixel_bounds(clipped, width_, height_, cull_.extent);
        if (bounds.empty()) continue;
        drawn = true;
        const auto number = static_cast<std::uint32_t>(worker.clipped.size());
        worker.clipped.emplace_back(clipped, cull_.extent);
        grid_.for_tiles(bounds, [&](std::size_t tile) { bins[tile].clipped.push_back(number); });
    }
    worker.triangles_drawn += drawn ? 1 : 0;
}

ClippedTriangles Geometry::clipped_of(std::uint32_t triangle) const {
    const std::uint32_t* index = mesh_->index.data() + std::size_t{triangle} * 3;
    const auto vertex = [&](std::size_t i) {
        return transform_->to_clip(mesh_->position[index[i]]);
    };
    const ClippedTriangles all = clip_triangle(
        {vertex(0), vertex(1), vertex(2)}, vertices_of(triangle), transform_->box.near_w, triangle);
    ClippedTriangles visible;
    CullOptions cull = cull_;
    if (is_one_sided(triangle)) cull.keep = Facing::front;
    for (const ClippedTriangle& clipped : all)
        if (keeps_facing(cull, clipped.clockwise))
            visible.triangle[static_cast<std::size_t>(visible.count++)] = clipped;
    return visible;
}

void Geometry::bin_segment(WorkerBins& worker, std::uint32_t segment) const {
    const std::uint32_t* index = mesh_->line_index.data() + std::size_t{segment} * 2;
    ScreenVertex v[2] = {vertices()[index[0]], vertices()[index[1]]};
    const std::uint32_t of_first = flags(index[0]), of_second = flags(index[1]);
    if ((of_first & of_second & kOutsideMask) != 0) return;
    if (((of_first | of_second) & kNotFinite) != 0) return;
    if (((of_first | of_second) & kNeedsClip) != 0) {
        ClipVertex a = transform_->to_clip(mesh_->position[index[0]]);
        ClipVertex b = transform_->to_clip(mesh_->position[index[1]]);
        if (!clip(a, b, transform_->box)) return;
        check_before_snap(a, index[0]);
        check_before_snap(b, index[1]);
        v[0] = transform_->to_screen(a);
        v[1] = transform_->to_screen(b);
    }
    const Segment s{{v[0].x, v[1].x},
                    {v[0].y, v[1].y},
                    {v[0].depth, v[1].depth},
                    first_line_ + segment,
                    line_width_};
    const auto number = static_cast<std::uint32_t>(worker.segments.size());
    worker.segments.push_back(s);
    grid_.for_tiles(pixel_bounds(s, width_, height_),
                    [&](std::size_t tile) { worker.bins[tile].segments.push_back(number); });
}

void Geometry::bin_point(WorkerBins& worker, std::uint32_t point) const {
    const ScreenVertex& v = vertices()[mesh_->point_index[point]];
    if (!v.on_screen()) return;
    const Point p{v.x, v.y, v.depth,
                  first_line_ + static_cast<std::uint32_t>(mesh_->lines()) + point, point_size_};
    const auto number = static_cast<std::uint32_t>(worker.points.size());
    worker.points.push_back(p);
    grid_.for_tiles(pixel_bounds(p, width_, height_),
                    [&](std::size_t tile) { worker.bins[tile].points.push_back(number); });
}

bool Geometry::all_unclipped() const {
    return std::none_of(workers_.begin(), workers_.end(),
                        [](const WorkerBins& worker) { return worker.has_clipped; });
}

std::uint64_t Geometry::triangles_drawn() const {
    std::uint64_t drawn = deferred_drawn_;
    for (const WorkerBins& worker : workers_)
        drawn += worker.triangles_drawn;
    return drawn;
}

} // namespace scanout::raster
