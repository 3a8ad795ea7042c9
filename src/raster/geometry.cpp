#include "raster/geometry.h"

#include "base/check.h"
#include "base/memory.h"
#include "raster/check_lanes.h"
#include "raster/clip.h"

#include <algorithm>
#include <atomic>
#include <bit>

namespace scanout::raster {

namespace {
constexpr int kLarge = 16;           // pixels each way: some block of 8 x 8 may be covered whole
constexpr std::size_t kLine = 64;    // bytes that memory gives at once
constexpr std::size_t kChunk = 4096; // of vertices, triangles or clusters: a worker's next work

int chunks(std::size_t n) {
    return static_cast<int>((n + kChunk - 1) / kChunk);
}

// And asks for the line that is written next: no processor foresees where so many lists go on.
void append(std::vector<TilePart>& parts, TilePart part) {
    parts.push_back(part);
    __builtin_prefetch(&parts.back() + kLine / sizeof(TilePart), 1);
}
} // namespace

void Geometry::Batch::clear(int tiles, bool layers) {
    triangles_drawn = 0;
    cut = false;
    pieces.clear();
    segments.clear();
    points.clear();
    asked.clear();
    bins.resize(static_cast<std::size_t>(tiles));
    layered.resize(layers ? static_cast<std::size_t>(tiles) : 0);
    for (auto* all : {&bins, &layered}) {
        for (Bin& bin : *all) {
            bin.triangles.clear();
            bin.pieces.clear();
            bin.segments.clear();
            bin.points.clear();
            bin.waiting.clear();
            bin.asked.clear();
            bin.large.clear();
            for (auto& parts : bin.parts)
                parts.clear();
        }
    }
}

void Geometry::Batch::Bin::put_large_first() {
    if (large.empty()) return;
    put_nearest_first(large);
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
    layers_.assign(options.layers.begin(), options.layers.end());
    hidden_ = options.hidden;
    late_drawn_ = 0;
    CHECK(hidden_ == nullptr || layers_.empty());
    CHECK_LE(mesh.position.size(), kMostVertices);
    if (vertices_.size() != mesh.position.size())
        vertices_ = LargeArray<ScreenVertex>(mesh.position.size());
    batches_.resize(static_cast<std::size_t>(jobs.threads()));
    for (Batch& batch : batches_)
        batch.clear(tiles(), !layers_.empty());

    find_needed(jobs, !options.triangles_only && mesh.lines() + mesh.points() > 0);
    transform_needed(jobs);

    const auto run_all = [&](std::size_t count, auto add) {
        jobs.for_each(chunks(count), [&](int chunk, int worker) {
            const std::size_t begin = static_cast<std::size_t>(chunk) * kChunk;
            add(batches_[static_cast<std::size_t>(worker)], begin, std::min(count, begin + kChunk));
        });
    };
    run_all(mesh.triangles(),
            [&](Batch& batch, std::size_t begin, std::size_t end) { add_seen(batch, begin, end); });
    jobs.for_each(tiles(), [&](int tile, int) {
        for (Batch& batch : batches_)
            batch.bins[static_cast<std::size_t>(tile)].put_large_first();
    });
    if (options.triangles_only) return;
    run_all(mesh.lines(), [&](Batch& batch, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            add_segment(batch, static_cast<std::uint32_t>(i));
    });
    run_all(mesh.points(), [&](Batch& batch, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            add_point(batch, static_cast<std::uint32_t>(i));
    });
}

// Lines and points are few and belong to no cluster: where there are some, all vertices are needed.
void Geometry::find_needed(Jobs& jobs, bool all_vertices) {
    using geom::Clusters;
    const Clusters& clusters = mesh_->clusters;
    seen_.clear();
    needed_.assign((mesh_->position.size() + Clusters::kVertices - 1) / Clusters::kVertices,
                   clusters.empty() || all_vertices ? 1 : 0);
    if (clusters.empty()) return;
    CHECK_EQ(clusters.cluster.size(),
             (mesh_->triangles() + Clusters::kTriangles - 1) / Clusters::kTriangles);
    seen_.resize(clusters.cluster.size());
    if (hidden_ != nullptr) hidden_->begin_frame(seen_.size());
    cluster_cull_.emplace(*transform_, cull_.keep);
    jobs.for_each(chunks(seen_.size()), [&](int chunk, int worker) {
        const std::size_t begin = static_cast<std::size_t>(chunk) * kChunk;
        Batch& batch = batches_[static_cast<std::size_t>(worker)];
        const std::size_t end = std::min(seen_.size(), begin + kChunk);
        cluster_cull_->find_hidden(std::span(clusters.cluster).subspan(begin, end - begin),
                                   seen_.data() + begin);
        for (std::size_t c = begin; c < end; ++c) {
            const bool hidden = seen_[c] != 0;
            seen_[c] = hidden || waits(batch, c) ? 0 : 1;
            if (seen_[c] == 0) continue;
            for (const std::uint32_t block : clusters.blocks_of(c))
                std::atomic_ref(needed_[block]).store(1, std::memory_order_relaxed);
        }
    });
}

void Geometry::transform_needed(Jobs& jobs) {
    constexpr std::size_t kBlock = geom::Clusters::kVertices, kBlocks = kChunk / kBlock;
    static_assert(kChunk % kBlock == 0);
    jobs.for_each(chunks(mesh_->position.size()), [&](int chunk, int) {
        std::size_t block = static_cast<std::size_t>(chunk) * kBlocks;
        const std::size_t last = std::min(block + kBlocks, needed_.size());
        while (block < last) {
            const std::size_t from = block;
            while (block < last && needed_[block] != 0)
                ++block;
            if (block > from)
                transform_blocks(from, block);
            else
                ++block;
        }
    });
}

void Geometry::transform_blocks(std::size_t begin, std::size_t end) {
    constexpr std::size_t kBlock = geom::Clusters::kVertices;
    const std::size_t first = begin * kBlock,
                      n = std::min(end * kBlock, mesh_->position.size()) - first;
    const auto out = std::span(vertices_).subspan(first, n);
    transform_vertices(*transform_, std::span(mesh_->position).subspan(first, n), out);
    check_lanes(out);
}

void Geometry::add_seen(Batch& batch, std::size_t begin, std::size_t end) const {
    if (seen_.empty()) return add_triangles(batch, begin, end);
    constexpr std::size_t kCluster = geom::Clusters::kTriangles;
    static_assert(kChunk % kCluster == 0);
    const std::size_t last = (end + kCluster - 1) / kCluster;
    for (std::size_t c = begin / kCluster; c < last; ++c) {
        const std::size_t from = c;
        while (c < last && seen_[c] != 0)
            ++c;
        if (c > from) add_triangles(batch, from * kCluster, std::min(c * kCluster, end));
    }
}

std::array<ScreenVertex, 3> Geometry::corners(std::uint32_t triangle) const {
    const std::uint32_t* index = mesh_->index.data() + std::size_t{triangle} * 3;
    return {vertices_[index[0]], vertices_[index[1]], vertices_[index[2]]};
}

void Geometry::add_large(Batch& batch, const KeptTriangle& t, std::uint32_t triangle) const {
    double nearest = 0;
    for (const ScreenVertex& v : corners(triangle))
        nearest = std::max(nearest, v.depth);
    const DepthAndId key = depth_and_id(static_cast<float>(nearest), triangle);
    for_tiles(t.x0(), t.y0(), t.x1(), t.y1(),
              [&](std::size_t tile) { batch.bins[tile].large.push_back(key); });
}

void Geometry::add_small(Batch& batch, const KeptTriangle& t) const {
    for (int y = t.y0() >> tile_bits_; y <= (t.y1() - 1) >> tile_bits_; ++y)
        for (int x = t.x0() >> tile_bits_; x <= (t.x1() - 1) >> tile_bits_; ++x)
            add_part(t, x << tile_bits_, y << tile_bits_,
                     batch.bins[static_cast<std::size_t>(y * across_ + x)].parts);
}

void Geometry::add_part(const KeptTriangle& t, int left, int top, PartsByKind& parts) const {
    const auto clamped = [&](int at, int begin) { return std::clamp(at - begin, 0, tile_size_); };
    const int x0 = clamped(t.x0(), left), x1 = clamped(t.x1(), left);
    const int y0 = clamped(t.y0(), top), y1 = clamped(t.y1(), top);
    const bool tiny = std::max(x1 - x0, y1 - y0) <= speck_side(PartKind::speck_astride);
    const PartKind kind = t.away() ? PartKind::back
                          : tiny   ? PartKind::speck_astride
                                   : PartKind::strip;
    append(parts[static_cast<std::size_t>(kind)], TilePart::of(t.place, x0, y0, x1, y1));
}

void Geometry::add_triangles(Batch& batch, std::size_t begin, std::size_t end) const {
    CullResult& found = batch.found;
    cull(cull_, vertices_, mesh_->index_by_place().subspan(begin * 3, (end - begin) * 3),
         static_cast<std::uint32_t>(begin), found);
    const auto kept = std::span<const KeptTriangle>(found.kept).first(found.kept_count);
    place_parts({tile_bits_, across_}, kept, batch.placed);
    const std::span<Batch::Bin> bins = batch.bins;
    const bool layered = !layers_.empty();
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const KeptTriangle& t = kept[i];
        if (layered) {
            const std::uint32_t triangle = mesh_->triangle_at(t.place);
            const Layer layer = layer_of(triangle);
            if (layer == Layer::nothing) continue;
            if (layer != Layer::opaque) {
                for_tiles(t.x0(), t.y0(), t.x1(), t.y1(), [&](std::size_t tile) {
                    batch.layered[tile].triangles.push_back(triangle);
                });
                continue;
            }
        }
        const std::int32_t tile = batch.placed.tile[i];
        if (tile != PlacedParts::kNone) {
            append(bins[static_cast<std::size_t>(tile)]
                       .parts[static_cast<std::size_t>(batch.placed.kind[i])],
                   {t.place, batch.placed.where[i]});
        } else if (t.small()) {
            add_small(batch, t);
        } else {
            const std::uint32_t triangle = mesh_->triangle_at(t.place);
            if (t.x1() - t.x0() >= kLarge && t.y1() - t.y0() >= kLarge)
                add_large(batch, t, triangle);
            else
                for_tiles(t.x0(), t.y0(), t.x1(), t.y1(),
                          [&](std::size_t at) { bins[at].triangles.push_back(triangle); });
        }
    }
    batch.triangles_drawn += kept.size();
    batch.cut |= found.cut_count > 0;
    for (std::size_t i = 0; i < found.cut_count; ++i)
        add_clipped(batch, mesh_->triangle_at(found.cut[i]));
}

std::uint32_t Geometry::flags(std::uint32_t vertex) const {
    const ScreenVertex& v = vertices_[vertex];
    return v.on_screen() ? transform_->classify(transform_->to_clip(mesh_->position[vertex]))
                         : v.flags();
}

void Geometry::add_clipped(Batch& batch, std::uint32_t triangle) const {
    const Layer layer = layers_.empty() ? Layer::opaque : layer_of(triangle);
    if (layer == Layer::nothing) return;
    std::vector<Batch::Bin>& bins = layer == Layer::opaque ? batch.bins : batch.layered;
    const std::uint32_t* index = mesh_->index.data() + std::size_t{triangle} * 3;
    if ((flags(index[0]) & flags(index[1]) & flags(index[2]) & kOutsideMask) != 0) return;
    bool drawn = false;
    for (const Piece& piece : pieces(triangle)) {
        const image::Rect bounds = pixel_bounds(piece, width_, height_, cull_.extent);
        if (bounds.empty()) continue;
        drawn = true;
        const auto number = static_cast<std::uint32_t>(batch.pieces.size());
        batch.pieces.emplace_back(piece, cull_.extent);
        for_tiles(bounds, [&](std::size_t tile) { bins[tile].pieces.push_back(number); });
    }
    batch.triangles_drawn += drawn ? 1 : 0;
}

Pieces Geometry::pieces(std::uint32_t triangle) const {
    const std::uint32_t* index = mesh_->index.data() + std::size_t{triangle} * 3;
    const auto vertex = [&](std::size_t i) {
        return transform_->to_clip(mesh_->position[index[i]]);
    };
    const Pieces all = pieces_of({vertex(0), vertex(1), vertex(2)}, corners(triangle),
                                 transform_->box.near_w, triangle);
    Pieces kept;
    for (const Piece& piece : all)
        if (faces_as_wanted(cull_, piece.clockwise))
            kept.piece[static_cast<std::size_t>(kept.count++)] = piece;
    return kept;
}

void Geometry::add_segment(Batch& batch, std::uint32_t segment) const {
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

void Geometry::add_point(Batch& batch, std::uint32_t point) const {
    const ScreenVertex& v = vertices_[mesh_->point_index[point]];
    if (!v.on_screen()) return;
    const Point p{v.x, v.y, v.depth,
                  static_cast<std::uint32_t>(mesh_->triangles() + mesh_->lines()) + point};
    const auto number = static_cast<std::uint32_t>(batch.points.size());
    batch.points.push_back(p);
    for_tiles(pixel_bounds(p, width_, height_),
              [&](std::size_t tile) { batch.bins[tile].points.push_back(number); });
}

bool Geometry::all_whole() const {
    return std::none_of(batches_.begin(), batches_.end(),
                        [](const Batch& batch) { return batch.cut; });
}

std::uint64_t Geometry::triangles_drawn() const {
    std::uint64_t drawn = late_drawn_;
    for (const Batch& batch : batches_)
        drawn += batch.triangles_drawn;
    return drawn;
}

} // namespace scanout::raster
