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
constexpr std::size_t kLine = 64;    // bytes of a cache line
constexpr std::size_t kChunk = 4096; // of vertices, triangles or clusters: a worker's next work

int chunks(std::size_t n) {
    return static_cast<int>((n + kChunk - 1) / kChunk);
}

// Prefetches the cache line that is written next: with a list a tile, the hardware prefetcher loses
// track.
void append(std::vector<BinnedTriangle>& small, BinnedTriangle binned) {
    small.push_back(binned);
    __builtin_prefetch(&small.back() + kLine / sizeof(BinnedTriangle), 1);
}
} // namespace

void Geometry::Batch::clear(int tiles, bool alpha_modes) {
    triangles_drawn = 0;
    has_clipped = false;
    clipped.clear();
    segments.clear();
    points.clear();
    queries.clear();
    bins.resize(static_cast<std::size_t>(tiles));
    not_opaque.resize(alpha_modes ? static_cast<std::size_t>(tiles) : 0);
    for (auto* all : {&bins, &not_opaque}) {
        for (Bin& bin : *all) {
            bin.triangles.clear();
            bin.clipped.clear();
            bin.segments.clear();
            bin.points.clear();
            bin.deferred.clear();
            bin.queries.clear();
            bin.large.clear();
            for (auto& small : bin.small)
                small.clear();
        }
    }
}

void Geometry::Batch::Bin::prepend_large() {
    if (large.empty()) return;
    sort_front_to_back(large);
    const std::size_t small = triangles.size();
    triangles.resize(small + large.size());
    std::move_backward(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(small),
                       triangles.end());
    std::transform(large.begin(), large.end(), triangles.begin(),
                   [](DepthAndId of) { return id_of(of); });
}

void Geometry::run(Jobs& jobs, const geom::Mesh& mesh, const ScreenTransform& transform,
                   const GeometryOptions& options) {
    tile_size_ = options.tile_size;
    CHECK(std::has_single_bit(static_cast<unsigned>(tile_size_)) && tile_size_ >= 8 &&
          tile_size_ <= kTileSize);
    tile_bits_ = std::countr_zero(static_cast<unsigned>(tile_size_));
    width_ = options.width;
    height_ = options.height;
    across_ = (width_ + tile_size_ - 1) / tile_size_;
    down_ = (height_ + tile_size_ - 1) / tile_size_;
    cull_ = {width_,
             height_,
             options.keep,
             options.mirrored,
             options.areas ? SampleExtent{} : extent_of(sample_pattern(options.samples)),
             options.areas ? std::span<const SampleOffset>() : sample_pattern(options.samples)};
    mesh_ = &mesh;
    transform_ = transform;
    alpha_modes_.assign(options.alpha_modes.begin(), options.alpha_modes.end());
    occlusion_ = options.occlusion;
    deferred_drawn_ = 0;
    CHECK(occlusion_ == nullptr || alpha_modes_.empty());
    CHECK_LE(mesh.position.size(), kMaxVertices);
    if (vertices_.size() != mesh.position.size())
        vertices_ = LargeArray<ScreenVertex>(mesh.position.size());
    batches_.resize(static_cast<std::size_t>(jobs.threads()));
    for (Batch& batch : batches_)
        batch.clear(tiles(), !alpha_modes_.empty());

    find_needed(jobs, !options.triangles_only && mesh.lines() + mesh.points() > 0);
    transform_needed(jobs);

    const auto run_all = [&](std::size_t count, auto add) {
        jobs.for_each(chunks(count), [&](int chunk, int worker) {
            const std::size_t begin = static_cast<std::size_t>(chunk) * kChunk;
            add(batches_[static_cast<std::size_t>(worker)], begin, std::min(count, begin + kChunk));
        });
    };
    run_all(mesh.triangles(), [&](Batch& batch, std::size_t begin, std::size_t end) {
        bin_visible(batch, begin, end);
    });
    jobs.for_each(tiles(), [&](int tile, int) {
        for (Batch& batch : batches_)
            batch.bins[static_cast<std::size_t>(tile)].prepend_large();
    });
    if (options.triangles_only) return;
    run_all(mesh.lines(), [&](Batch& batch, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            bin_segment(batch, static_cast<std::uint32_t>(i));
    });
    run_all(mesh.points(), [&](Batch& batch, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            bin_point(batch, static_cast<std::uint32_t>(i));
    });
}

// Lines and points are few and belong to no cluster: where there are some, all vertices are needed.
void Geometry::find_needed(Jobs& jobs, bool all_vertices) {
    using geom::Clusters;
    const Clusters& clusters = mesh_->clusters;
    visible_clusters_.clear();
    needed_groups_.assign((mesh_->position.size() + Clusters::kGroupVertices - 1) /
                              Clusters::kGroupVertices,
                          clusters.empty() || all_vertices ? 1 : 0);
    if (clusters.empty()) return;
    CHECK_EQ(clusters.cluster.size(),
             (mesh_->triangles() + Clusters::kTriangles - 1) / Clusters::kTriangles);
    visible_clusters_.resize(clusters.cluster.size());
    if (occlusion_ != nullptr) occlusion_->begin_frame(visible_clusters_.size());
    cluster_cull_.emplace(*transform_, cull_.keep);
    jobs.for_each(chunks(visible_clusters_.size()), [&](int chunk, int worker) {
        const std::size_t begin = static_cast<std::size_t>(chunk) * kChunk;
        Batch& batch = batches_[static_cast<std::size_t>(worker)];
        const std::size_t end = std::min(visible_clusters_.size(), begin + kChunk);
        cluster_cull_->find_hidden(std::span(clusters.cluster).subspan(begin, end - begin),
                                   visible_clusters_.data() + begin);
        for (std::size_t c = begin; c < end; ++c) {
            const bool hidden = visible_clusters_[c] != 0;
            visible_clusters_[c] = hidden || defers(batch, c) ? 0 : 1;
            if (visible_clusters_[c] == 0) continue;
            for (const std::uint32_t group : clusters.vertex_groups_of(c))
                std::atomic_ref(needed_groups_[group]).store(1, std::memory_order_relaxed);
        }
    });
}

void Geometry::transform_needed(Jobs& jobs) {
    constexpr std::size_t kGroupVertices = geom::Clusters::kGroupVertices,
                          kGroups = kChunk / kGroupVertices;
    static_assert(kChunk % kGroupVertices == 0);
    jobs.for_each(chunks(mesh_->position.size()), [&](int chunk, int) {
        std::size_t group = static_cast<std::size_t>(chunk) * kGroups;
        const std::size_t last = std::min(group + kGroups, needed_groups_.size());
        while (group < last) {
            const std::size_t from = group;
            while (group < last && needed_groups_[group] != 0)
                ++group;
            if (group > from)
                transform_groups(from, group);
            else
                ++group;
        }
    });
}

void Geometry::transform_groups(std::size_t begin, std::size_t end) {
    constexpr std::size_t kGroupVertices = geom::Clusters::kGroupVertices;
    const std::size_t first = begin * kGroupVertices,
                      n = std::min(end * kGroupVertices, mesh_->position.size()) - first;
    const auto out = std::span(vertices_).subspan(first, n);
    transform_vertices(*transform_, std::span(mesh_->position).subspan(first, n), out);
    check_lanes(out);
}

void Geometry::bin_visible(Batch& batch, std::size_t begin, std::size_t end) const {
    if (visible_clusters_.empty()) return bin_triangles(batch, begin, end);
    constexpr std::size_t kCluster = geom::Clusters::kTriangles;
    static_assert(kChunk % kCluster == 0);
    const std::size_t last = (end + kCluster - 1) / kCluster;
    for (std::size_t c = begin / kCluster; c < last; ++c) {
        const std::size_t from = c;
        while (c < last && visible_clusters_[c] != 0)
            ++c;
        if (c > from) bin_triangles(batch, from * kCluster, std::min(c * kCluster, end));
    }
}

std::array<ScreenVertex, 3> Geometry::vertices_of(std::uint32_t triangle) const {
    const std::uint32_t* index = mesh_->index.data() + std::size_t{triangle} * 3;
    return {vertices_[index[0]], vertices_[index[1]], vertices_[index[2]]};
}

void Geometry::bin_large(Batch& batch, const VisibleTriangle& t, std::uint32_t triangle) const {
    double nearest = 0;
    for (const ScreenVertex& v : vertices_of(triangle))
        nearest = std::max(nearest, v.depth);
    const DepthAndId key = depth_and_id(static_cast<float>(nearest), triangle);
    for_tiles(t.x0(), t.y0(), t.x1(), t.y1(),
              [&](std::size_t tile) { batch.bins[tile].large.push_back(key); });
}

void Geometry::bin_small(Batch& batch, const VisibleTriangle& t) const {
    for (int y = t.y0() >> tile_bits_; y <= (t.y1() - 1) >> tile_bits_; ++y)
        for (int x = t.x0() >> tile_bits_; x <= (t.x1() - 1) >> tile_bits_; ++x)
            bin_small_part(t, x << tile_bits_, y << tile_bits_,
                           batch.bins[static_cast<std::size_t>(y * across_ + x)].small);
}

void Geometry::bin_small_part(const VisibleTriangle& t, int left, int top,
                              BinnedByKind& small) const {
    const auto clamped = [&](int at, int begin) { return std::clamp(at - begin, 0, tile_size_); };
    const int x0 = clamped(t.x0(), left), x1 = clamped(t.x1(), left);
    const int y0 = clamped(t.y0(), top), y1 = clamped(t.y1(), top);
    const bool tiny = std::max(x1 - x0, y1 - y0) <= micro_side(SmallKind::micro_straddling);
    const SmallKind kind = t.back_facing() ? SmallKind::back_facing
                           : tiny          ? SmallKind::micro_straddling
                                           : SmallKind::rows;
    append(small[static_cast<std::size_t>(kind)],
           BinnedTriangle::of(t.spatial_index, x0, y0, x1, y1));
}

void Geometry::bin_triangles(Batch& batch, std::size_t begin, std::size_t end) const {
    CullResult& found = batch.found;
    cull(cull_, vertices_, mesh_->index_in_spatial_order().subspan(begin * 3, (end - begin) * 3),
         static_cast<std::uint32_t>(begin), found);
    const auto visible = std::span<const VisibleTriangle>(found.visible).first(found.visible_count);
    bin_small_triangles({tile_bits_, across_}, visible, batch.binning);
    const std::span<Batch::Bin> bins = batch.bins;
    const bool not_opaque = !alpha_modes_.empty();
    for (std::size_t i = 0; i < visible.size(); ++i) {
        const VisibleTriangle& t = visible[i];
        if (not_opaque) {
            const std::uint32_t triangle = mesh_->triangle_at(t.spatial_index);
            const AlphaMode mode = alpha_mode_of(triangle);
            if (mode == AlphaMode::nothing) continue;
            if (mode != AlphaMode::opaque) {
                for_tiles(t.x0(), t.y0(), t.x1(), t.y1(), [&](std::size_t tile) {
                    batch.not_opaque[tile].triangles.push_back(triangle);
                });
                continue;
            }
        }
        const std::int32_t tile = batch.binning.tile[i];
        if (tile != BinningResult::kNone) {
            append(bins[static_cast<std::size_t>(tile)]
                       .small[static_cast<std::size_t>(batch.binning.kind[i])],
                   {t.spatial_index, batch.binning.where[i]});
        } else if (t.small()) {
            bin_small(batch, t);
        } else {
            const std::uint32_t triangle = mesh_->triangle_at(t.spatial_index);
            if (t.x1() - t.x0() >= kLarge && t.y1() - t.y0() >= kLarge)
                bin_large(batch, t, triangle);
            else
                for_tiles(t.x0(), t.y0(), t.x1(), t.y1(),
                          [&](std::size_t at) { bins[at].triangles.push_back(triangle); });
        }
    }
    batch.triangles_drawn += visible.size();
    batch.has_clipped |= found.to_clip_count > 0;
    for (std::size_t i = 0; i < found.to_clip_count; ++i)
        bin_clipped(batch, mesh_->triangle_at(found.to_clip[i]));
}

std::uint32_t Geometry::flags(std::uint32_t vertex) const {
    const ScreenVertex& v = vertices_[vertex];
    return v.on_screen() ? transform_->classify(transform_->to_clip(mesh_->position[vertex]))
                         : v.flags();
}

void Geometry::bin_clipped(Batch& batch, std::uint32_t triangle) const {
    const AlphaMode mode = alpha_modes_.empty() ? AlphaMode::opaque : alpha_mode_of(triangle);
    if (mode == AlphaMode::nothing) return;
    std::vector<Batch::Bin>& bins = mode == AlphaMode::opaque ? batch.bins : batch.not_opaque;
    const std::uint32_t* index = mesh_->index.data() + std::size_t{triangle} * 3;
    if ((flags(index[0]) & flags(index[1]) & flags(index[2]) & kOutsideMask) != 0) return;
    bool drawn = false;
    for (const ClippedTriangle& clipped : clipped_of(triangle)) {
        const image::Rect bounds = pixel_bounds(clipped, width_, height_, cull_.extent);
        if (bounds.empty()) continue;
        drawn = true;
        const auto number = static_cast<std::uint32_t>(batch.clipped.size());
        batch.clipped.emplace_back(clipped, cull_.extent);
        for_tiles(bounds, [&](std::size_t tile) { bins[tile].clipped.push_back(number); });
    }
    batch.triangles_drawn += drawn ? 1 : 0;
}

ClippedTriangles Geometry::clipped_of(std::uint32_t triangle) const {
    const std::uint32_t* index = mesh_->index.data() + std::size_t{triangle} * 3;
    const auto vertex = [&](std::size_t i) {
        return transform_->to_clip(mesh_->position[index[i]]);
    };
    const ClippedTriangles all = clip_triangle(
        {vertex(0), vertex(1), vertex(2)}, vertices_of(triangle), transform_->box.near_w, triangle);
    ClippedTriangles visible;
    for (const ClippedTriangle& clipped : all)
        if (keeps_facing(cull_, clipped.clockwise))
            visible.triangle[static_cast<std::size_t>(visible.count++)] = clipped;
    return visible;
}

void Geometry::bin_segment(Batch& batch, std::uint32_t segment) const {
    const std::uint32_t* index = mesh_->line_index.data() + std::size_t{segment} * 2;
    ScreenVertex v[2] = {vertices_[index[0]], vertices_[index[1]]};
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
                    static_cast<std::uint32_t>(mesh_->triangles()) + segment};
    const auto number = static_cast<std::uint32_t>(batch.segments.size());
    batch.segments.push_back(s);
    for_tiles(pixel_bounds(s, width_, height_),
              [&](std::size_t tile) { batch.bins[tile].segments.push_back(number); });
}

void Geometry::bin_point(Batch& batch, std::uint32_t point) const {
    const ScreenVertex& v = vertices_[mesh_->point_index[point]];
    if (!v.on_screen()) return;
    const Point p{v.x, v.y, v.depth,
                  static_cast<std::uint32_t>(mesh_->triangles() + mesh_->lines()) + point};
    const auto number = static_cast<std::uint32_t>(batch.points.size());
    batch.points.push_back(p);
    for_tiles(pixel_bounds(p, width_, height_),
              [&](std::size_t tile) { batch.bins[tile].points.push_back(number); });
}

bool Geometry::all_unclipped() const {
    return std::none_of(batches_.begin(), batches_.end(),
                        [](const Batch& batch) { return batch.has_clipped; });
}

std::uint64_t Geometry::triangles_drawn() const {
    std::uint64_t drawn = deferred_drawn_;
    for (const Batch& batch : batches_)
        drawn += batch.triangles_drawn;
    return drawn;
}

} // namespace scanout::raster
