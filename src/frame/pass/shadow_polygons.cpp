#include "frame/pass/shadow_polygons.h"

#include "base/check.h"
#include "frame/view/light_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace scanout::frame {
namespace {

using raster::ClipVertex;
using raster::StencilSign;

// Stands for infinity where a parallel view cannot show a point at infinity: this many times the
// distance from the light, or the model's depth, is beyond all that can be seen.
constexpr double kFar = 0x1p20;
// Triangles nearer to the plane than this, in bounding radii, cast no shadow onto it.
constexpr double kNearPlane = 0x1p-14;

void add_edges(const std::array<std::uint32_t, 3>& v, std::vector<ShadowEdge>& edges) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t from = v[i], to = v[(i + 1) % 3];
        edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1, 1});
    }
}

// Merges the entries of each edge into one.
void merge(std::vector<ShadowEdge>& edges) {
    std::sort(edges.begin(), edges.end(), [](const ShadowEdge& a, const ShadowEdge& b) {
        return std::tie(a.low, a.high, a.net) < std::tie(b.low, b.high, b.net);
    });
    std::size_t kept = 0;
    for (const ShadowEdge& e : edges) {
        if (kept > 0 && edges[kept - 1].low == e.low && edges[kept - 1].high == e.high) {
            edges[kept - 1].net += e.net;
            edges[kept - 1].uses += e.uses;
        } else {
            edges[kept++] = e;
        }
    }
    edges.resize(kept);
}

std::array<std::uint32_t, 3> vertex_lighting_of(const geom::Mesh& mesh, const Welded& welded,
                                                std::size_t triangle) {
    std::array<std::uint32_t, 3> v{};
    for (std::size_t i = 0; i < 3; ++i)
        v[i] = welded.vertex[mesh.index[triangle * 3 + i]];
    return v;
}

bool has_edges(const std::array<std::uint32_t, 3>& v) {
    return v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
}

void bin(const ScreenTiles& grid, ShadowPolygons& polygons) {
    const auto tiles = [&](int pixels) { return (pixels + grid.tile_size - 1) / grid.tile_size; };
    const int across = tiles(grid.width);
    polygons.tiles.resize(static_cast<std::size_t>(across) *
                          static_cast<std::size_t>(tiles(grid.height)));
    const raster::SampleExtent extent =
        grid.areas ? raster::SampleExtent{} : extent_of(raster::sample_pattern(grid.samples));
    for (std::size_t i = 0; i < polygons.triangles.size(); ++i) {
        const image::Rect box =
            pixel_bounds(polygons.triangles[i].triangle, grid.width, grid.height, extent);
        if (box.empty()) continue;
        for (int y = box.y0 / grid.tile_size; y <= (box.y1 - 1) / grid.tile_size; ++y)
            for (int x = box.x0 / grid.tile_size; x <= (box.x1 - 1) / grid.tile_size; ++x)
                polygons.tiles[static_cast<std::size_t>(y * across + x)].push_back(
                    static_cast<std::uint32_t>(i));
    }
}

// Builds the volumes of one light.
struct VolumeBuilder {
    const geom::Mesh& mesh;
    std::span<const std::uint8_t> casts;
    const Welded& welded;
    const scene::ViewLight& light;
    const scene::View& view;
    const raster::ScreenTransform& transform;
    std::vector<ShadowEdge>& edges; // scratch
    std::vector<raster::StencilTriangle>& out;
    DVec3 place = place_of(light, view);

    bool parallel() const { return light.kind == scene::LightKind::directional; }
    DVec3 position(std::uint32_t v) const {
        return view.linear * DVec3(mesh.position[v]) + view.translation;
    }
    DVec3 away(const DVec3& from) const {
        return parallel() ? -DVec3(light.towards) : from - place;
    }
    // A vertex in the picture, and the vertex extruded from the light to infinity.
    ClipVertex near(std::uint32_t v) const { return transform.to_clip(mesh.position[v]); }
    ClipVertex far(std::uint32_t v) const {
        const DVec3 at = position(v), way = away(at);
        if (transform.perspective) return to_clip(transform, DVec4(way, 0));
        const double share = parallel() ? kFar / view.depth_scale : kFar;
        return to_clip(transform, DVec4(at + way * share, 1));
    }
    // > 0: the triangle's front faces the light.
    double facing(const std::array<std::uint32_t, 3>& v) const {
        const DVec3 a = position(v[0]), b = position(v[1]), c = position(v[2]);
        return -dot3(cross3(b - a, c - a), away(a));
    }
    void add_caps(const std::array<std::uint32_t, 3>& v, std::size_t triangle) const {
        const std::array<ClipVertex, 3> front = {near(v[0]), near(v[1]), near(v[2])};
        add_polygon(front, transform, 1, StencilSign::facing, static_cast<std::uint32_t>(triangle),
                    out);
        if (parallel() && transform.perspective) return; // all ends meet in one point
        const std::array<ClipVertex, 3> back = {far(v[0]), far(v[2]), far(v[1])};
        add_polygon(back, transform, 1, StencilSign::facing, raster::kNoPrimitive, out);
    }
    void add_side(const ShadowEdge& e) const {
        const std::array<ClipVertex, 4> side = {near(e.high), near(e.low), far(e.low), far(e.high)};
        // With parallel rays in perspective both far corners are the same.
        const std::size_t corners = parallel() && transform.perspective ? 3 : 4;
        add_polygon(std::span(side).first(corners), transform, static_cast<float>(e.net),
                    StencilSign::facing, raster::kNoPrimitive, out);
    }
    // A light inside a closed component meets its back faces first.
    bool stands_outside() const {
        if (parallel()) return true;
        DVec3 low(INFINITY), high(-INFINITY);
        for (const std::uint32_t v : mesh.index) {
            const DVec3 at = position(v);
            for (int c = 0; c < 3; ++c) {
                low[c] = std::min(low[c], at[c]);
                high[c] = std::max(high[c], at[c]);
            }
        }
        bool outside = false;
        for (int c = 0; c < 3; ++c)
            outside = outside || place[c] < low[c] || place[c] > high[c];
        return outside;
    }
    // Of one side alone, or of all faces.
    void build(raster::Facing sides) const {
        const double kept = sides == raster::Facing::back ? -1 : 1;
        edges.clear();
        for (std::size_t i = 0; i < mesh.triangles(); ++i) {
            if (casts[i] == 0) continue;
            std::array<std::uint32_t, 3> v = vertex_lighting_of(mesh, welded, i);
            const double front = facing(v);
            if (!has_edges(v) || front == 0) continue;
            if (sides != raster::Facing::any && front * kept < 0) continue;
            if (front < 0) std::swap(v[1], v[2]); // its back faces the light
            add_caps(v, i);
            add_edges(v, edges);
        }
        merge(edges);
        for (const ShadowEdge& e : edges)
            if (e.net != 0) add_side(e);
    }
};

struct PolygonVertex {
    DVec3 at{0};
    double height = 0;
};
struct Polygon {
    std::array<PolygonVertex, 8> vertex; // a triangle, clipped twice, has five
    std::size_t vertices = 0;
    void add(const PolygonVertex& c) {
        CHECK_LT(vertices, vertex.size());
        vertex[vertices++] = c;
    }
};
// Sutherland and Hodgman 1974. Clips away the part beyond the height `limit`; sign 1 keeps the part
// above it. Cuts each edge from its inside vertex to its outside one, so that neighbours agree.
void clip(Polygon& polygon, double sign, double limit) {
    Polygon out;
    for (std::size_t i = 0; i < polygon.vertices; ++i) {
        const PolygonVertex &a = polygon.vertex[i], &b = polygon.vertex[(i + 1) % polygon.vertices];
        const double da = sign * (a.height - limit), db = sign * (b.height - limit);
        if (da >= 0) out.add(a);
        if ((da >= 0) == (db >= 0)) continue;
        const PolygonVertex &in = da >= 0 ? a : b, &outside = da >= 0 ? b : a;
        const double d_in = da >= 0 ? da : db, d_out = da >= 0 ? db : da;
        out.add({in.at + (outside.at - in.at) * (d_in / (d_in - d_out)), limit});
    }
    polygon = out;
}

} // namespace

Welded weld(const geom::Mesh& mesh, std::span<const std::uint8_t> casts) {
    std::vector<std::uint32_t> order(mesh.position.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto place = [&](std::uint32_t v) {
        const Vec3& p = mesh.position[v];
        return std::tuple(p.x, p.y, p.z);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return place(a) != place(b) ? place(a) < place(b) : a < b;
    });
    Welded welded;
    welded.vertex.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && place(order[i]) == place(order[i - 1]);
        welded.vertex[order[i]] = same ? welded.vertex[order[i - 1]] : order[i];
    }
    std::vector<ShadowEdge> edges;
    for (std::size_t i = 0; i < mesh.triangles(); ++i) {
        const std::array<std::uint32_t, 3> v = vertex_lighting_of(mesh, welded, i);
        if (casts[i] != 0 && has_edges(v)) add_edges(v, edges);
    }
    merge(edges);
    welded.closed = std::all_of(edges.begin(), edges.end(),
                                [](const ShadowEdge& e) { return e.net == 0 && e.uses == 2; });
    return welded;
}

std::size_t ShadowPolygons::bytes() const {
    std::size_t bytes = triangles.size() * sizeof(raster::StencilTriangle);
    for (const std::vector<std::uint32_t>& tile : tiles)
        bytes += tile.size() * sizeof(std::uint32_t);
    return bytes;
}

void ShadowPolygons::clear() {
    triangles.clear();
    for (std::vector<std::uint32_t>& tile : tiles)
        tile.clear();
}

void ShadowPolygons::count(int tile, const raster::VisibilityTile& visible, float* counts) const {
    const raster::StencilPlanes planes{visible.area(), visible.pattern(), visible.depths(0).data(),
                                       visible.ids(0).data(), counts};
    for (const std::uint32_t i : tiles[static_cast<std::size_t>(tile)])
        add_to_stencil(planes, triangles[i], where);
}

void shadow_volumes(const ShadowCaster& t, const Welded& welded, std::vector<ShadowEdge>& edges,
                    ShadowPolygons& out) {
    out.clear();
    out.where = raster::StencilWhere::behind;
    const VolumeBuilder builder{t.mesh, t.casts,     welded, t.light,
                                t.view, t.transform, edges,  out.triangles};
    using raster::Facing;
    const bool outside = welded.closed && builder.stands_outside();
    builder.build(!outside ? Facing::any : t.inner == Facing::front ? Facing::back : Facing::front);
    out.of_body = outside ? 1 : 2;
    bin(t.grid, out);
}

void projected_shadows(const ShadowCaster& t, const ViewPlane& plane, ShadowPolygons& out) {
    out.clear();
    out.where = raster::StencilWhere::everywhere;
    out.of_body = 0;
    const bool parallel = t.light.kind == scene::LightKind::directional;
    const DVec3 from = parallel ? DVec3(t.light.towards) : place_of(t.light, t.view);
    // A parallel light has a direction but no position: `above` is its elevation, not a height.
    const double least = kNearPlane * radius_of(t.view), lowest = parallel ? kNearPlane : least;
    DVec3 normal = plane.normal;
    double offset = plane.offset;
    double above = dot3(normal, from) + (parallel ? 0 : offset);
    if (above < 0) { // the side of the light is up
        normal = -normal;
        offset = -offset;
        above = -above;
    }
    for (std::size_t i = 0; i < t.mesh.triangles() && above > lowest; ++i) {
        if (t.casts[i] == 0) continue;
        Polygon polygon;
        for (std::size_t k = 0; k < 3; ++k) {
            const DVec3 at = t.view.linear * DVec3(t.mesh.position[t.mesh.index[i * 3 + k]]) +
                             t.view.translation;
            polygon.add({at, dot3(normal, at) + offset});
        }
        clip(polygon, 1, least);
        // Points at the height of a light with a position cast their shadow infinitely far away.
        if (!parallel) clip(polygon, -1, above * (1 - 1 / kFar));
        std::array<ClipVertex, 8> projected{};
        std::size_t count = 0;
        for (const auto& [at, height] : std::span(polygon.vertex).first(polygon.vertices)) {
            const double w = parallel ? above : above - height;
            projected[count++] = to_clip(t.transform, DVec4((at * above - from * height) / w, 1));
        }
        if (count >= 3)
            add_polygon(std::span(projected).first(count), t.transform, 1, StencilSign::same,
                        raster::kNoPrimitive, out.triangles);
    }
    bin(t.grid, out);
}

} // namespace scanout::frame
