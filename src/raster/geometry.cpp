#include "raster/geometry.h"

#include "raster/clip.h"

#include <algorithm>

namespace scanout::raster {

struct Geometry::Task {
    const geom::Mesh& mesh;
    const ScreenTransform& transform;
    const GeometryOptions& options;
};

void Geometry::Batch::clear(int tiles) {
    triangles.clear();
    segments.clear();
    points.clear();
    bins.resize(static_cast<std::size_t>(tiles));
    for (Bin& bin : bins) {
        bin.triangles.clear();
        bin.segments.clear();
        bin.points.clear();
    }
}

template <class F>
void Geometry::for_tiles(const image::Rect& bounds, F&& f) const {
    if (bounds.empty()) return;
    for (int y = bounds.y0 / kTileSize; y <= (bounds.y1 - 1) / kTileSize; ++y)
        for (int x = bounds.x0 / kTileSize; x <= (bounds.x1 - 1) / kTileSize; ++x)
            f(static_cast<std::size_t>(y * across_ + x));
}

void Geometry::run(Jobs& jobs, const geom::Mesh& mesh, const ScreenTransform& transform,
                   const GeometryOptions& options) {
    width_ = options.width;
    height_ = options.height;
    across_ = (width_ + kTileSize - 1) / kTileSize;
    down_ = (height_ + kTileSize - 1) / kTileSize;
    vertices_.resize(mesh.position.size());
    batches_.resize(static_cast<std::size_t>(jobs.threads()));
    for (Batch& batch : batches_)
        batch.clear(tiles());

    constexpr std::size_t kChunk = 4096;
    const auto chunks = [](std::size_t n) { return static_cast<int>((n + kChunk - 1) / kChunk); };
    jobs.for_each(chunks(mesh.position.size()), [&](int chunk, int) {
        const std::size_t begin = static_cast<std::size_t>(chunk) * kChunk;
        const std::size_t n = std::min(kChunk, mesh.position.size() - begin);
        transform_vertices(transform, std::span(mesh.position).subspan(begin, n),
                           std::span(vertices_).subspan(begin, n));
    });

    const Task task{mesh, transform, options};
    const auto run_all = [&](std::size_t count, auto add) {
        jobs.for_each(chunks(count), [&](int chunk, int worker) {
            const std::size_t begin = static_cast<std::size_t>(chunk) * kChunk;
            const std::size_t end = std::min(count, begin + kChunk);
            Batch& batch = batches_[static_cast<std::size_t>(worker)];
            for (std::size_t i = begin; i < end; ++i)
                (this->*add)(task, batch, static_cast<std::uint32_t>(i));
        });
    };
    run_all(mesh.triangles(), &Geometry::add_triangle);
    run_all(mesh.lines(), &Geometry::add_segment);
    run_all(mesh.points(), &Geometry::add_point);
}

void Geometry::add_triangle(const Task& task, Batch& batch, std::uint32_t triangle) const {
    const std::uint32_t* index = task.mesh.index.data() + std::size_t{triangle} * 3;
    const ScreenVertex v[3] = {vertices_[index[0]], vertices_[index[1]], vertices_[index[2]]};
    const std::uint32_t any = v[0].flags | v[1].flags | v[2].flags;
    if ((v[0].flags & v[1].flags & v[2].flags & kOutsideMask) != 0 || (any & kNotFinite) != 0)
        return;
    if ((any & kNeedsClip) != 0)
        add_clipped(task, batch, triangle);
    else
        add_snapped(task, batch, v, triangle, 0);
}

// facing: the sign of the unclipped triangle's area (> 0: clockwise on the screen), 0: take it from
// the vertices. Pieces of a clipped triangle face where the whole does, whatever snapping did to
// them.
void Geometry::add_snapped(const Task& task, Batch& batch, const ScreenVertex* v, std::uint32_t id,
                           int facing) const {
    const std::array<std::int32_t, 3> x = {v[0].x, v[1].x, v[2].x}, y = {v[0].y, v[1].y, v[2].y};
    const std::int64_t area = signed_area(x, y);
    if (area == 0) return; // snapped to nothing: covers no sample (HARD-CASES R6, 4)
    // Counter-clockwise is front; on the screen y runs down, so front has a negative area.
    const bool front = ((facing != 0 ? facing : (area < 0 ? -1 : 1)) < 0) != task.options.mirrored;
    if (task.options.keep == Facing::front && !front) return;
    if (task.options.keep == Facing::back && front) return;
    const CanonicalOrder order = canonical_order(x, y);
    Triangle t{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t from = order.vertex[i];
        t.x[i] = x[from];
        t.y[i] = y[from];
        t.depth[i] = v[from].depth;
    }
    t.id = id;
    t.flipped = (area < 0) != order.odd;
    const image::Rect bounds = pixel_bounds(t, width_, height_);
    if (bounds.empty()) return;
    const auto number = static_cast<std::uint32_t>(batch.triangles.size());
    batch.triangles.push_back(t);
    for_tiles(bounds, [&](std::size_t tile) { batch.bins[tile].triangles.push_back(number); });
}

void Geometry::add_clipped(const Task& task, Batch& batch, std::uint32_t triangle) const {
    const std::uint32_t* index = task.mesh.index.data() + std::size_t{triangle} * 3;
    ClipPolygon polygon;
    polygon.count = 3;
    for (std::size_t i = 0; i < 3; ++i)
        polygon.vertex[i] = task.transform.to_clip(task.mesh.position[index[i]]);
    const ClipVertex &a = polygon.vertex[0], &b = polygon.vertex[1], &c = polygon.vertex[2];
    // The homogeneous determinant has the sign of the visible part's area (Olano and Greer 1997).
    const double det = (a.x * (b.y * c.w - c.y * b.w) - a.y * (b.x * c.w - c.x * b.w)) +
                       a.w * (b.x * c.y - c.x * b.y);
    const int facing = det > 0 ? 1 : -1;
    clip(polygon, task.transform.near_w());
    ScreenVertex corner[3];
    for (int i = 2; i < polygon.count; ++i) {
        corner[0] = ScreenTransform::to_screen(polygon.vertex[0]);
        corner[1] = ScreenTransform::to_screen(polygon.vertex[static_cast<std::size_t>(i - 1)]);
        corner[2] = ScreenTransform::to_screen(polygon.vertex[static_cast<std::size_t>(i)]);
        add_snapped(task, batch, corner, triangle, facing);
    }
}

void Geometry::add_segment(const Task& task, Batch& batch, std::uint32_t segment) const {
    const std::uint32_t* index = task.mesh.line_index.data() + std::size_t{segment} * 2;
    ScreenVertex v[2] = {vertices_[index[0]], vertices_[index[1]]};
    const std::uint32_t any = v[0].flags | v[1].flags;
    if ((v[0].flags & v[1].flags & kOutsideMask) != 0 || (any & kNotFinite) != 0) return;
    if ((any & kNeedsClip) != 0) {
        ClipVertex a = task.transform.to_clip(task.mesh.position[index[0]]);
        ClipVertex b = task.transform.to_clip(task.mesh.position[index[1]]);
        if (!clip(a, b, task.transform.near_w())) return;
        v[0] = ScreenTransform::to_screen(a);
        v[1] = ScreenTransform::to_screen(b);
    }
    const Segment s{{v[0].x, v[1].x},
                    {v[0].y, v[1].y},
                    {v[0].depth, v[1].depth},
                    static_cast<std::uint32_t>(task.mesh.triangles()) + segment};
    const auto number = static_cast<std::uint32_t>(batch.segments.size());
    batch.segments.push_back(s);
    for_tiles(pixel_bounds(s, width_, height_),
              [&](std::size_t tile) { batch.bins[tile].segments.push_back(number); });
}

void Geometry::add_point(const Task& task, Batch& batch, std::uint32_t point) const {
    const ScreenVertex& v = vertices_[task.mesh.point_index[point]];
    if (v.flags != 0) return;
    const Point p{v.x, v.y, v.depth,
                  static_cast<std::uint32_t>(task.mesh.triangles() + task.mesh.lines()) + point};
    const auto number = static_cast<std::uint32_t>(batch.points.size());
    batch.points.push_back(p);
    for_tiles(pixel_bounds(p, width_, height_),
              [&](std::size_t tile) { batch.bins[tile].points.push_back(number); });
}

image::Rect Geometry::tile_area(int tile) const {
    const int x = tile % across_ * kTileSize, y = tile / across_ * kTileSize;
    return {x, y, std::min(x + kTileSize, width_), std::min(y + kTileSize, height_)};
}

void Geometry::draw(int tile, VisibilityTile& out) const {
    for (const Batch& batch : batches_) {
        const Batch::Bin& bin = batch.bins[static_cast<std::size_t>(tile)];
        for (const std::uint32_t i : bin.triangles)
            out.draw(batch.triangles[i]);
        for (const std::uint32_t i : bin.segments)
            out.draw(batch.segments[i]);
        for (const std::uint32_t i : bin.points)
            out.draw(batch.points[i]);
    }
}

std::uint64_t Geometry::triangles_drawn() const {
    std::uint64_t drawn = 0;
    for (const Batch& batch : batches_)
        drawn += batch.triangles.size();
    return drawn;
}

} // namespace scanout::raster
