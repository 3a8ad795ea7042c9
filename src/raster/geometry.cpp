#include "raster/geometry.h"

#include "raster/clip.h"

#include <algorithm>
#include <tuple>

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
        add_snapped(task, batch, v, triangle, std::nullopt);
}

// clockwise: of the whole triangle; pieces of a clipped triangle face where the whole does,
// whatever snapping did to them. Not given: taken from the vertices.
void Geometry::add_snapped(const Task& task, Batch& batch, const ScreenVertex* v, std::uint32_t id,
                           std::optional<bool> clockwise) const {
    const std::array<std::int32_t, 3> x = {v[0].x, v[1].x, v[2].x}, y = {v[0].y, v[1].y, v[2].y};
    const std::int64_t area = signed_area(x, y);
    if (area == 0) return; // snapped to nothing: covers no sample (HARD-CASES R6, 4)
    // Counter-clockwise is front; on the screen y runs down, so front has a negative area.
    const bool front = !clockwise.value_or(area > 0) != task.options.mirrored;
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
    const HomogeneousTriangle whole =
        homogeneous_triangle({polygon.vertex[0], polygon.vertex[1], polygon.vertex[2]});
    if (!whole.seen) return;
    clip(polygon, task.transform.near_w());
    const auto count = static_cast<std::size_t>(polygon.count);
    if (count < 3) return;
    std::array<ScreenVertex, std::tuple_size_v<decltype(polygon.vertex)>> corner;
    for (std::size_t i = 0; i < count; ++i)
        corner[i] = task.transform.to_screen(polygon.vertex[i]);
    // The fan's hub is the first corner in canonical order, not the first that the file names.
    const auto before = [](const ScreenVertex& a, const ScreenVertex& b) {
        return std::tie(a.y, a.x, a.depth) < std::tie(b.y, b.x, b.depth);
    };
    const auto end = corner.begin() + static_cast<std::ptrdiff_t>(count);
    std::rotate(corner.begin(), std::min_element(corner.begin(), end, before), end);
    for (std::size_t i = 2; i < count; ++i) {
        const ScreenVertex piece[3] = {corner[0], corner[i - 1], corner[i]};
        add_snapped(task, batch, piece, triangle, whole.clockwise != whole.order.odd);
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
        v[0] = task.transform.to_screen(a);
        v[1] = task.transform.to_screen(b);
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
