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
    triangles_drawn = 0;
    pieces.clear();
    segments.clear();
    points.clear();
    bins.resize(static_cast<std::size_t>(tiles));
    for (Bin& bin : bins) {
        bin.triangles.clear();
        bin.pieces.clear();
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
    extent_ = extent_of(sample_pattern(options.samples));
    mesh_ = &mesh;
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

std::array<ScreenVertex, 3> Geometry::corners(std::uint32_t triangle) const {
    const std::uint32_t* index = mesh_->index.data() + std::size_t{triangle} * 3;
    return {vertices_[index[0]], vertices_[index[1]], vertices_[index[2]]};
}

bool Geometry::kept(const Task& task, const Triangle& triangle, bool clockwise,
                    image::Rect& bounds) const {
    // Counter-clockwise is front, unless the view mirrors.
    const bool front = !clockwise != task.options.mirrored;
    if (task.options.keep == Facing::front && !front) return false;
    if (task.options.keep == Facing::back && front) return false;
    bounds = pixel_bounds(triangle, width_, height_, extent_);
    return !bounds.empty();
}

void Geometry::add_triangle(const Task& task, Batch& batch, std::uint32_t triangle) const {
    const std::array<ScreenVertex, 3> v = corners(triangle);
    const std::uint32_t any = v[0].flags | v[1].flags | v[2].flags;
    if ((v[0].flags & v[1].flags & v[2].flags & kOutsideMask) != 0 || (any & kNotFinite) != 0)
        return;
    if ((any & kNeedsClip) != 0) return add_clipped(task, batch, triangle);
    const std::optional<SetUp> ready = set_up(v, triangle);
    image::Rect bounds;
    if (!ready || !kept(task, ready->triangle, ready->clockwise, bounds)) return;
    ++batch.triangles_drawn;
    for_tiles(bounds, [&](std::size_t tile) { batch.bins[tile].triangles.push_back(triangle); });
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
    // Pieces face where the whole does, whatever snapping did to them.
    const bool clockwise = whole.clockwise != whole.order.odd;
    for (std::size_t i = 2; i < count; ++i) {
        const std::optional<SetUp> piece = set_up({corner[0], corner[i - 1], corner[i]}, triangle);
        image::Rect bounds;
        if (!piece || !kept(task, piece->triangle, clockwise, bounds)) continue;
        ++batch.triangles_drawn;
        const auto number = static_cast<std::uint32_t>(batch.pieces.size());
        batch.pieces.push_back(piece->triangle);
        for_tiles(bounds, [&](std::size_t tile) { batch.bins[tile].pieces.push_back(number); });
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
        for (const std::uint32_t id : bin.triangles)
            if (const std::optional<SetUp> ready = set_up(corners(id), id))
                out.draw(ready->triangle);
        for (const std::uint32_t i : bin.pieces)
            out.draw(batch.pieces[i]);
        for (const std::uint32_t i : bin.segments)
            out.draw(batch.segments[i]);
        for (const std::uint32_t i : bin.points)
            out.draw(batch.points[i]);
    }
}

std::uint64_t Geometry::triangles_drawn() const {
    std::uint64_t drawn = 0;
    for (const Batch& batch : batches_)
        drawn += batch.triangles_drawn;
    return drawn;
}

} // namespace scanout::raster
