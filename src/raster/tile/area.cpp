#include "raster/tile/area.h"

#include "raster/check_lanes.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace scanout::raster {
namespace {

constexpr double kBox = double{kSubpixel} * kSubpixel; // a pixel's area
constexpr double kNothing = kBox * 0x1p-32;            // smaller cells are rounding

// Depths closer than this fraction of themselves are equal: the lower id stays.
constexpr double kSameDepth = 0x1p-24;

} // namespace

void AreaTile::reset(const image::Rect& area) {
    area_ = area;
    sources_.clear();
    constexpr auto kPixels = static_cast<std::size_t>(kTileSize) * kTileSize;
    pixels_.resize(kPixels);
    for (PixelCells& cells : pixels_)
        cells.clear();
    filled_.assign(kPixels, kNoPrimitive);
}

void AreaTile::add(const Triangle& t) {
    const Edges e = edges_of(t);
    Source source{
        {}, {}, t.id, pixel_bounds(t, area_.x1, area_.y1), {t.y[0], t.x[0], t.y[1], t.x[1]}};
    for (std::size_t k = 0; k < 3; ++k) {
        source.edges.a[k] = e.a[k];
        source.edges.b[k] = e.b[k];
        source.edges.c[k] = e.c[k];
        source.depth_factor[k] = t.depth[k] / static_cast<double>(e.area);
    }
    sources_.push_back(source);
}

void AreaTile::add(const raster::ClippedTriangle& clipped) {
    const auto& v = clipped.vertex;
    Source source{edges_of(clipped),
                  {},
                  clipped.id,
                  pixel_bounds(clipped, area_.x1, area_.y1, {}),
                  {v[0].y, v[0].x, v[1].y, v[1].x}};
    const double size = size_of(clipped);
    for (std::size_t k = 0; k < 3; ++k)
        source.depth_factor[k] = v[k].z / size;
    sources_.push_back(source);
}

// Calls use(number of the pixel, the source in it) for the pixels that a triangle touches.
template <class Use>
void AreaTile::for_pixels(std::int32_t source, Use&& use) {
    const Source& s = sources_[static_cast<std::size_t>(source)];
    for (int y = std::max(s.box.y0, area_.y0); y < s.box.y1; ++y)
        for (int x = std::max(s.box.x0, area_.x0); x < s.box.x1; ++x) {
            const std::array<Linear, 3> edge = edges_in(s, x, y);
            bool touched = true, whole = true;
            for (const Linear& e : edge) {
                const double right = e.x * kSubpixel, down = e.y * kSubpixel;
                touched = touched && e.at + (std::max(right, 0.0) + std::max(down, 0.0)) > 0;
                whole = whole && e.at + (std::min(right, 0.0) + std::min(down, 0.0)) >= 0;
            }
            if (touched) use(at(x, y), Incoming{source, depth_of(s, edge), edge, whole});
        }
}

// Triangles behind one that covers all of a pixel are left out there: of a stack of layers few are
// cut into cells, whatever their order in the file.
void AreaTile::finish() {
    std::sort(sources_.begin(), sources_.end(), [](const Source& a, const Source& b) {
        return std::tie(a.id, a.order) < std::tie(b.id, b.order);
    });
    covered_.assign(pixels_.size(), 0);
    const auto all = static_cast<std::int32_t>(sources_.size());
    for (std::int32_t i = 0; i < all; ++i)
        for_pixels(i, [&](std::size_t pixel, const Incoming& incoming) {
            if (incoming.whole)
                covered_[pixel] = std::max(covered_[pixel], range_of(incoming.depth).low);
        });
    for (std::int32_t i = 0; i < all; ++i)
        for_pixels(i, [&](std::size_t pixel, const Incoming& incoming) {
            if (range_of(incoming.depth).high >= covered_[pixel]) insert(pixels_[pixel], incoming);
        });
}

// Of a pixel, and beyond all rounding.
AreaTile::Range AreaTile::range_of(const Linear& depth) {
    const double right = depth.x * kSubpixel, down = depth.y * kSubpixel;
    const double margin = 0x1p-30 * (std::abs(depth.at) + (std::abs(right) + std::abs(down)));
    return {depth.at + (std::min(right, 0.0) + std::min(down, 0.0)) - margin,
            depth.at + (std::max(right, 0.0) + std::max(down, 0.0)) + margin};
}

// Exact at the pixel's corner, but for one rounding.
std::array<AreaTile::Linear, 3> AreaTile::edges_in(const Source& s, int x, int y) const {
    std::array<Linear, 3> edge;
    for (std::size_t k = 0; k < 3; ++k)
        edge[k] = {static_cast<double>(
                       s.edges.at(k, std::int64_t{x} * kSubpixel, std::int64_t{y} * kSubpixel)),
                   static_cast<double>(s.edges.a[k]), static_cast<double>(s.edges.b[k])};
    return edge;
}

void AreaTile::fill(int x, int y, std::uint32_t id) {
    filled_[at(x, y)] = id;
}

AreaTile::Linear AreaTile::depth_of(const Source& s, const std::array<Linear, 3>& edge) {
    Linear depth{0, 0, 0};
    for (std::size_t k = 0; k < 3; ++k) {
        depth.at += edge[k].at * s.depth_factor[k];
        depth.x += edge[k].x * s.depth_factor[k];
        depth.y += edge[k].y * s.depth_factor[k];
    }
    return depth;
}

double AreaTile::area_of(const Cell& p) {
    double twice_area = 0;
    for (int i = 2; i < p.vertices; ++i) { // a fan from vertex 0
        const CellVertex &o = p.vertex[0], &a = p.vertex[static_cast<std::size_t>(i - 1)],
                         &b = p.vertex[static_cast<std::size_t>(i)];
        twice_area += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    }
    return 0.5 * (twice_area < 0 ? -twice_area : twice_area);
}

// Where all of the cell clearly lies: what is cut from it lies there, too, for all rounding.
AreaTile::Side AreaTile::side_of(const Cell& cell, const Linear& line) {
    const auto size = [](double x) { return x < 0 ? -x : x; };
    const double margin = 0x1p-30 * (size(line.at) + kSubpixel * (size(line.x) + size(line.y)));
    bool inside = true, outside = true;
    for (int i = 0; i < cell.vertices; ++i) {
        const double at = line(cell.vertex[static_cast<std::size_t>(i)]);
        inside = inside && at > margin;
        outside = outside && at < -margin;
    }
    return inside ? Side::inside : outside ? Side::outside : Side::unclear;
}

// Is everything `ahead` of the owner at most this fraction of the owner's depth?
bool AreaTile::is_behind(const Cell& cell, const Linear& ahead, const Linear& owner, double same) {
    bool behind = true;
    for (int i = 0; i < cell.vertices; ++i) {
        const CellVertex& c = cell.vertex[static_cast<std::size_t>(i)];
        behind = behind && ahead(c) <= same * owner(c);
    }
    return behind;
}

bool AreaTile::is_before(const Cell& cell, const Linear& ahead, const Linear& owner) {
    bool before = true;
    for (int i = 0; i < cell.vertices; ++i) {
        const CellVertex& c = cell.vertex[static_cast<std::size_t>(i)];
        before = before && ahead(c) >= -kSameDepth * owner(c);
    }
    return before;
}

// Along line = 0. Too many vertices: the cell goes whole to the side where most of them are.
void AreaTile::split(const Cell& cell, const Linear& line, Cell& inside, Cell& outside) {
    inside.vertices = outside.vertices = 0;
    inside.source = outside.source = cell.source;
    inside.depth = outside.depth = cell.depth;
    const auto add = [](Cell& to, const CellVertex& c) {
        if (to.vertices < kMaxVertices) to.vertex[static_cast<std::size_t>(to.vertices)] = c;
        ++to.vertices;
    };
    for (int i = 0; i < cell.vertices; ++i) {
        const CellVertex& here = cell.vertex[static_cast<std::size_t>(i)];
        const CellVertex& next = cell.vertex[static_cast<std::size_t>((i + 1) % cell.vertices)];
        const double at = line(here), then = line(next);
        if (at >= 0) add(inside, here);
        if (at <= 0) add(outside, here);
        if ((at > 0 && then < 0) || (at < 0 && then > 0)) {
            // From the inner end, so that the cells on both sides of an edge get the same vertex.
            const double t = at > 0 ? at / (at - then) : then / (then - at);
            const CellVertex &from = at > 0 ? here : next, &to = at > 0 ? next : here;
            const CellVertex cut{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
            add(inside, cut);
            add(outside, cut);
        }
    }
    if (inside.vertices > kMaxVertices || outside.vertices > kMaxVertices) {
        const bool in = inside.vertices >= outside.vertices;
        (in ? inside : outside) = cell;
        (in ? outside : inside).vertices = 0;
    }
}

void AreaTile::insert(PixelCells& cells, const Incoming& incoming) {
    if (cells.empty()) {
        constexpr double kSide = kSubpixel;
        Cell box;
        box.vertices = 4;
        box.vertex[0] = {0, 0};
        box.vertex[1] = {kSide, 0};
        box.vertex[2] = {kSide, kSide};
        box.vertex[3] = {0, kSide};
        cells.push_back(box);
    }
    const std::size_t before = cells.size();
    for (std::size_t i = 0; i < before; ++i)
        take(cells, i, incoming);
    // Cells of a pixel that one triangle covers whole become one cell again.
    const bool all = incoming.whole && std::all_of(cells.begin(), cells.end(), [&](const Cell& p) {
                         return p.source == incoming.source;
                     });
    if (all && cells.size() > 1) {
        cells.clear();
        insert(cells, incoming);
    }
}

// The visible part of the source in one cell becomes its own; the rest is appended.
void AreaTile::take(PixelCells& cells, std::size_t index, const Incoming& incoming) {
    const std::size_t edges = incoming.whole ? 0 : 3;
    const auto& edge = incoming.edge;
    // Most cells of a pixel with many are far from the edges: nothing is cut, nor copied.
    Cell& cell = cells[index];
    std::array<Side, 3> side{};
    bool is_cut = false;
    for (std::size_t k = 0; k < edges; ++k) {
        side[k] = side_of(cell, edge[k]);
        if (side[k] == Side::outside) return;
        is_cut = is_cut || side[k] == Side::unclear;
    }
    const bool owned = cell.source >= 0;
    const Linear owner = cell.depth, mine = incoming.depth;
    const Linear ahead{mine.at - owner.at, mine.x - owner.x, mine.y - owner.y};
    if (owned && is_behind(cell, ahead, owner, kSameDepth / 2)) return; // and so is each part
    if (!is_cut &&
        (!owned || (!is_behind(cell, ahead, owner, kSameDepth) && is_before(cell, ahead, owner)))) {
        cell.source = incoming.source;
        cell.depth = incoming.depth;
        return;
    }
    Cell inside = cell, rest;
    std::array<Cell, 4> left; // beyond each edge, and behind the old owner
    std::size_t lefts = 0;
    for (std::size_t k = 0; k < edges; ++k) {
        if (side[k] == Side::inside) continue;
        const Cell whole = inside;
        split(whole, edge[k], inside, rest);
        if (area_of(inside) <= kNothing) return;
        if (area_of(rest) > kNothing) left[lefts++] = rest;
    }
    if (owned) {
        if (is_behind(inside, ahead, owner, kSameDepth)) return;
        if (!is_before(inside, ahead, owner)) { // the planes cross here
            const Cell whole = inside;
            split(whole, ahead, inside, rest);
            if (area_of(inside) <= kNothing) return;
            if (area_of(rest) > kNothing) left[lefts++] = rest;
        }
    }
    if (lefts > 0 && cells.size() + lefts > kMaxCells) return;
    inside.source = incoming.source;
    inside.depth = incoming.depth;
    cell = inside;
    cells.insert(cells.end(), left.begin(), left.begin() + static_cast<std::ptrdiff_t>(lefts));
}

std::span<const AreaFragment> AreaTile::fragments(int x, int y) {
    found_.clear();
    const std::size_t pixel = at(x, y);
    if (filled_[pixel] != kNoPrimitive) {
        found_.push_back({filled_[pixel], 1.0F, kSubpixel / 2, kSubpixel / 2});
        return found_;
    }
    sums_.clear();
    for (const Cell& cell : pixels_[pixel]) {
        if (cell.source < 0) continue;
        const std::uint32_t id = sources_[static_cast<std::size_t>(cell.source)].id;
        auto sum =
            std::find_if(sums_.begin(), sums_.end(), [&](const auto& s) { return s.first == id; });
        if (sum == sums_.end()) sum = sums_.insert(sums_.end(), {id, {}});
        const double area = area_of(cell);
        sum->second.area += area;
        if (area <= sum->second.largest) continue;
        sum->second.largest = area;
        CellVertex middle{0, 0};
        for (int i = 0; i < cell.vertices; ++i) {
            middle.x += cell.vertex[static_cast<std::size_t>(i)].x / cell.vertices;
            middle.y += cell.vertex[static_cast<std::size_t>(i)].y / cell.vertices;
        }
        sum->second.middle = middle;
    }
    for (const auto& [id, sum] : sums_) {
        const auto from = [](double middle) {
            return std::clamp(static_cast<std::int32_t>(middle), 0, kSubpixel - 1);
        };
        const double coverage = sum.area / kBox;
        found_.push_back({id, static_cast<float>(coverage > 1 - 0x1p-24 ? 1.0 : coverage),
                          from(sum.middle.x), from(sum.middle.y)});
    }
    check_lanes(found_);
    std::sort(found_.begin(), found_.end(), [](const AreaFragment& a, const AreaFragment& b) {
        return a.coverage != b.coverage ? a.coverage > b.coverage : a.id < b.id;
    });
    if (!found_.empty() && found_[0].coverage == 1.0F)
        found_.erase(found_.begin() + 1, found_.end()); // the rest is rounding
    return found_;
}

} // namespace scanout::raster
