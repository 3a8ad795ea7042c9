#include "geom/section.h"

#include "base/chunks.h"
#include "base/memory.h"
#include "geom/join_table.h"
#include "geom/line_faces.h"
#include "geom/outlines.h"
#include "geom/plane_coordinates.h"
#include "math/bits.h"
#include "math/predicates.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace scanout::geom {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

struct HashOfPosition {
    std::size_t operator()(const Vec3& p) const {
        const auto bits = [](float x) {
            return std::uint64_t{std::bit_cast<std::uint32_t>(x + 0.0F)}; // no -0
        };
        return mix_bits(mix_bits(bits(p.x) << 32 | bits(p.y)) + bits(p.z));
    }
};

DVec3 unit(const DVec3& v) {
    return v / std::sqrt(dot3(v, v));
}

class Cutter {
public:
    Cutter(Jobs& jobs, const Mesh& mesh, const SectionPlane& plane)
        : jobs_(jobs), in_(mesh), plane_(plane), in_plane_(plane.normal),
          side_(mesh.position.size()), number_(mesh.position.size(), kNone), out_(result_.mesh) {
        for (int axis = 0; axis < 3; ++axis)
            if (plane.normal[(axis + 1) % 3] == 0 && plane.normal[(axis + 2) % 3] == 0)
                axis_ = axis;
        for_chunks(jobs, side_.size(), 1 << 14, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t v = begin; v < end; ++v)
                side_[v] = static_cast<std::int8_t>(
                    side_of_plane(plane.normal, plane.offset, DVec3(in_.position[v])));
        });
    }

    bool cuts() const {
        return std::any_of(side_.begin(), side_.end(), [](std::int8_t s) { return s > 0; });
    }

    Section run(std::int32_t cap_material) {
        out_.centre = in_.centre;
        out_.exponent = in_.exponent;
        out_.radius = in_.radius;
        out_.box_min = in_.box_min;
        out_.box_max = in_.box_max;
        keep_vertices();
        cut_triangles();
        cut_lines();
        cap(cap_material);
        if (!in_.clusters.empty()) out_.clusters = find_clusters(jobs_, out_, spatial_order());
        find_line_faces(out_);
        return std::move(result_);
    }

private:
    void copy_vertex(std::size_t v) {
        out_.position.push_back(in_.position[v]);
        out_.normal.push_back(in_.normal[v]);
        if (!in_.uv.empty()) out_.uv.push_back(in_.uv[v]);
        if (!in_.exact_uv.empty()) out_.exact_uv.push_back(in_.exact_uv[v]);
        if (!in_.colour.empty()) out_.colour.push_back(in_.colour[v]);
    }

    // Those that are not in front; they keep their order.
    void keep_vertices() {
        const auto kept = static_cast<std::size_t>(
            std::count_if(side_.begin(), side_.end(), [](std::int8_t s) { return s <= 0; }));
        out_.position.reserve(kept + kept / 16);
        out_.normal.reserve(kept + kept / 16);
        if (!in_.uv.empty()) out_.uv.reserve(kept + kept / 16);
        if (!in_.colour.empty()) out_.colour.reserve(kept + kept / 16);
        for (std::size_t v = 0; v < side_.size(); ++v) {
            if (side_[v] > 0) continue;
            number_[v] = static_cast<std::uint32_t>(out_.position.size());
            copy_vertex(v);
        }
    }

    double height(const Vec3& p) const { return dot3(plane_.normal, DVec3(p)) - plane_.offset; }

    // The vertex at which the edge between two vertices on different sides meets the plane. It
    // depends on their positions alone, not on their order: vertices that differ in normals and uv
    // are cut at one place.
    std::uint32_t cut_edge(std::uint32_t a, std::uint32_t b) {
        const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        const auto [found, is_new] =
            on_edge_.try_emplace(key, static_cast<std::uint32_t>(out_.position.size()));
        if (!is_new) return found->second;
        const auto before = [&](const Vec3& p, const Vec3& q) {
            return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
        };
        if (before(in_.position[b], in_.position[a])) std::swap(a, b);
        const double of_a = height(in_.position[a]), of_b = height(in_.position[b]);
        const double t = of_a == of_b ? 0.5 : std::clamp(of_a / (of_a - of_b), 0.0, 1.0);
        const auto mixed = [t](const auto& p, const auto& q) { return p + (q - p) * t; };
        Vec3 position(mixed(DVec3(in_.position[a]), DVec3(in_.position[b])));
        if (axis_ >= 0) position[axis_] = static_cast<float>(plane_.offset / plane_.normal[axis_]);
        out_.position.push_back(position + 0.0F);
        const DVec3 normal = mixed(DVec3(in_.normal[a]), DVec3(in_.normal[b]));
        out_.normal.push_back(dot3(normal, normal) > 0x1p-20 ? Vec3(unit(normal)) : in_.normal[a]);
        if (!in_.uv.empty()) {
            const DVec2 uv = mixed(in_.uv_of(a), in_.uv_of(b));
            out_.uv.emplace_back(uv);
            if (!in_.exact_uv.empty()) out_.exact_uv.push_back(uv);
        }
        if (!in_.colour.empty())
            out_.colour.emplace_back(mixed(DVec3(in_.colour[a]), DVec3(in_.colour[b])));
        return found->second;
    }

    // A point of the cut, by its place.
    std::uint32_t point_at(const Vec3& place) {
        const auto [found, is_new] =
            point_of_.try_emplace(place, static_cast<std::uint32_t>(places_.size()));
        if (is_new) places_.push_back(place);
        return found->second;
    }

    // An edge in the plane, of a triangle that is kept or not, as the triangle is wound. `made`: by
    // the cut, which made its other side, too.
    struct Edge {
        std::uint32_t low, high; // points
        bool turned, kept, made;
    };
    void add_edge(const Vec3& from, const Vec3& to, bool kept, bool made) {
        const std::uint32_t a = point_at(from), b = point_at(to);
        if (a != b) edges_.push_back({std::min(a, b), std::max(a, b), a > b, kept, made});
    }

    void add_triangle(std::size_t of, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        out_.index.insert(out_.index.end(), {a, b, c});
        out_.material.push_back(in_.material[of]);
        out_.face.push_back(in_.face[of]);
    }

    void cut_triangles() {
        const std::size_t triangles = in_.triangles();
        first_.reserve(triangles + 1);
        for (std::size_t t = 0; t < triangles; ++t) {
            first_.push_back(static_cast<std::uint32_t>(out_.triangles()));
            const std::uint32_t* const v = &in_.index[t * 3];
            const int front = (side_[v[0]] > 0) + (side_[v[1]] > 0) + (side_[v[2]] > 0);
            const int behind = (side_[v[0]] < 0) + (side_[v[1]] < 0) + (side_[v[2]] < 0);
            if (front > 0 && behind > 0) {
                cut(t, front);
                continue;
            }
            const bool kept = behind > 0 || (front == 0 && looks_to_front(v));
            if (kept)
                add_triangle(t, number_[v[0]], number_[v[1]], number_[v[2]]);
            else
                ++result_.removed;
            if (front + behind > 1) continue;
            for (int i = 0; i < 3; ++i)
                if (side_[v[i]] == 0 && side_[v[(i + 1) % 3]] == 0)
                    add_edge(in_.position[v[i]], in_.position[v[(i + 1) % 3]], kept, false);
        }
        first_.push_back(static_cast<std::uint32_t>(out_.triangles()));
    }

    // Of a triangle in the plane.
    bool looks_to_front(const std::uint32_t* v) const {
        return orient2d(in_plane_(DVec3(in_.position[v[0]])), in_plane_(DVec3(in_.position[v[1]])),
                        in_plane_(DVec3(in_.position[v[2]]))) > 0;
    }

    // The part behind the plane: a triangle, or a quadrilateral of two.
    void cut(std::size_t t, int front) {
        ++result_.cut;
        std::uint32_t v[3];
        std::copy_n(&in_.index[t * 3], 3, v);
        // The corner that is alone comes first: of two in front the one behind, of one the one in
        // front; where a corner lies on the plane, that one.
        const auto is_first = [&](std::uint32_t corner) {
            const int side = side_[corner];
            if (std::any_of(v, v + 3, [&](std::uint32_t c) { return side_[c] == 0; }))
                return side == 0;
            return front == 1 ? side > 0 : side < 0;
        };
        while (!is_first(v[0]))
            std::rotate(v, v + 1, v + 3);
        std::uint32_t from = 0, to = 0; // of the new edge
        if (side_[v[0]] == 0) {
            const std::uint32_t m = cut_edge(v[1], v[2]);
            const bool first = side_[v[1]] < 0;
            from = first ? m : number_[v[0]];
            to = first ? number_[v[0]] : m;
            if (first)
                add_triangle(t, number_[v[0]], number_[v[1]], m);
            else
                add_triangle(t, number_[v[0]], m, number_[v[2]]);
        } else {
            const std::uint32_t m = cut_edge(v[0], v[1]), n = cut_edge(v[2], v[0]);
            if (front == 2) {
                add_triangle(t, number_[v[0]], m, n);
                from = m;
                to = n;
            } else {
                add_triangle(t, m, number_[v[1]], number_[v[2]]);
                add_triangle(t, m, number_[v[2]], n);
                from = n;
                to = m;
            }
        }
        add_edge(out_.position[from], out_.position[to], true, true);
    }

    void cut_lines() {
        for (std::size_t i = 0; i < in_.lines(); ++i) {
            std::uint32_t a = in_.line_index[2 * i], b = in_.line_index[2 * i + 1];
            const int of_a = side_[a], of_b = side_[b];
            if ((of_a > 0 && of_b >= 0) || (of_b > 0 && of_a >= 0)) continue;
            const std::uint32_t m = of_a > 0 || of_b > 0 ? cut_edge(a, b) : kNone;
            out_.line_index.push_back(of_a > 0 ? m : number_[a]);
            out_.line_index.push_back(of_b > 0 ? m : number_[b]);
            out_.line_material.push_back(in_.line_material[i]);
        }
        for (std::size_t i = 0; i < in_.points(); ++i) {
            if (side_[in_.point_index[i]] > 0) continue;
            out_.point_index.push_back(number_[in_.point_index[i]]);
            out_.point_material.push_back(in_.point_material[i]);
        }
    }

    // The edges that bound the caps. Edges of the file that lie in the plane do where the surface
    // goes on in front of it: not where it is open there already.
    std::vector<OutlineEdge> bounds() {
        std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) {
            return a.low != b.low ? a.low < b.low : a.high < b.high;
        });
        std::vector<OutlineEdge> found;
        for (std::size_t i = 0, end = 0; i < edges_.size(); i = end) {
            int kept = 0, made = 0, all = 0;
            for (end = i; end < edges_.size() && edges_[end].low == edges_[i].low &&
                          edges_[end].high == edges_[i].high;
                 ++end) {
                const int way = edges_[end].turned ? -1 : 1;
                (edges_[end].made ? made : all) += way;
                if (edges_[end].kept && !edges_[end].made) kept += way;
            }
            const int net = made + (all == 0 ? kept : 0);
            // The cap runs against the faces that it bounds.
            if (net > 0) found.push_back({edges_[i].high, edges_[i].low});
            if (net < 0) found.push_back({edges_[i].low, edges_[i].high});
        }
        return found;
    }

    void cap(std::int32_t material) {
        const std::vector<OutlineEdge> edges = bounds();
        std::vector<DVec2> points;
        points.reserve(places_.size());
        for (const Vec3& place : places_)
            points.push_back(in_plane_(DVec3(place)));
        const Outlines outlines = find_outlines(points, edges);
        result_.edges = edges.size();
        result_.open_edges = outlines.open_edges;
        std::array<std::vector<std::uint32_t>, 2> vertex; // of points, at caps either way around
        std::uint32_t face =
            in_.face.empty() ? 0 : *std::max_element(in_.face.begin(), in_.face.end());
        for (const Polygon& polygon : outlines.polygons) {
            ++face;
            const bool turned = polygon.outline.turned;
            std::vector<std::uint32_t>& of = vertex[turned ? 1 : 0];
            of.resize(places_.size(), kNone);
            std::vector<std::uint32_t> triangles;
            triangulate(points, polygon, triangles);
            for (std::size_t i = 0; i < triangles.size(); i += 3) {
                if (turned) std::swap(triangles[i + 1], triangles[i + 2]);
                for (std::size_t k = i; k < i + 3; ++k)
                    out_.index.push_back(cap_vertex(triangles[k], turned, of));
                out_.material.push_back(material);
                out_.face.push_back(face);
                ++result_.caps;
            }
        }
    }

    std::uint32_t cap_vertex(std::uint32_t point, bool turned, std::vector<std::uint32_t>& of) {
        if (of[point] != kNone) return of[point];
        of[point] = static_cast<std::uint32_t>(out_.position.size());
        out_.position.push_back(places_[point]);
        out_.normal.emplace_back(unit(turned ? -plane_.normal : plane_.normal));
        if (!in_.uv.empty()) out_.uv.emplace_back(0);
        if (!in_.exact_uv.empty()) out_.exact_uv.emplace_back(0);
        if (!in_.colour.empty()) out_.colour.emplace_back(1);
        return of[point];
    }

    // That of the whole mesh; caps come last.
    std::vector<std::uint32_t> spatial_order() const {
        std::vector<std::uint32_t> order;
        if (in_.clusters.triangle.empty()) return order;
        order.reserve(out_.triangles());
        for (const std::uint32_t t : in_.clusters.triangle)
            for (std::uint32_t made = first_[t]; made < first_[t + 1]; ++made)
                order.push_back(made);
        for (std::size_t t = first_.back(); t < out_.triangles(); ++t)
            order.push_back(static_cast<std::uint32_t>(t));
        return order;
    }

    Jobs& jobs_;
    const Mesh& in_;
    SectionPlane plane_;
    PlaneCoordinates in_plane_;
    int axis_ = -1;                     // that the normal lies along; -1: none
    std::vector<std::int8_t> side_;     // of each vertex: 1 in front, 0 on the plane, -1 behind
    std::vector<std::uint32_t> number_; // of each in out_
    std::unordered_map<std::uint64_t, std::uint32_t> on_edge_;
    std::unordered_map<Vec3, std::uint32_t, HashOfPosition> point_of_;
    std::vector<Vec3> places_;         // of points of the cut
    std::vector<Edge> edges_;          // in the plane
    std::vector<std::uint32_t> first_; // of each triangle, the first in out_ that is made of it
    Section result_;
    Mesh& out_;
};

} // namespace

std::optional<Section> cut_by_plane(Jobs& jobs, const Mesh& mesh, const SectionPlane& plane,
                                    std::int32_t cap_material) {
    Cutter cutter(jobs, mesh, plane);
    if (!cutter.cuts()) return std::nullopt;
    return cutter.run(cap_material);
}

} // namespace scanout::geom
