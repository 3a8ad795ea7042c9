#include "shade/setup/primitive_cache.h"

#include "base/check.h"
#include "math/rotation.h"
#include "raster/clipped/clipped_triangle.h"
#include "shade/check_lanes.h"
#include "shade/setup/interpolation_step.h"
#include "shade/setup/primitive_setup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace scanout::shade {
namespace {

using VertexIndices = std::array<std::uint32_t, 3>; // vertices of the mesh

// The triangle's own normal, brought near length 1 so that a float holds it; only its direction
// matters.
void set_facing(Primitive& p, const geom::Mesh& mesh, const VertexIndices& v, bool negate) {
    const DVec3 p0(mesh.position[v[0]]), p1(mesh.position[v[1]]), p2(mesh.position[v[2]]);
    DVec3 n = cross3(p1 - p0, p2 - p0);
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    if (largest > 0)
        n = n * (1 / (negate ? -largest : largest)); // at least 2^-298: floats' products
    for (int c = 0; c < 3; ++c)
        p.facing[c] = static_cast<float>(n[c]);
}

// The eye sees the side from which the vertices wind clockwise: in the order of the corners, and in
// the file's.
struct Behind {
    bool of_order, of_file;
};

// The attributes that a triangle's vertices have in this frame.
class Vertices {
public:
    // Sets the primitive's `facing`, if something of it is read.
    Vertices(Primitive& p, const GatherInput& in, const VertexIndices& vertex_index, Behind behind)
        : p_(p), in_(in), side_(in.frame->sides == Sides::face && behind.of_file ? -1.0F : 1.0F) {
        const Sides sides = in.frame->sides;
        if (sides == Sides::eye || in.frame->attributes.vertices || in.frame->attributes.facing)
            set_facing(p, *in.mesh, vertex_index,
                       behind.of_order != (sides == Sides::file && behind.of_file));
    }

    // All three at once.
    void set(const VertexIndices& v) {
        const geom::Mesh& mesh = *in_.mesh;
        const Attributes wanted = in_.frame->attributes;
        const bool own_normals = wanted.normal && !in_.frame->vertex_normals;
        const float side = side_;
        for (std::size_t k = 0; k < 3; ++k) {
            if (wanted.position || wanted.vertices) set_attribute(p_.position, k, position(v[k]));
            if (in_.frame->vertex_normals) set_attribute(p_.normal, k, normal(v[k]));
            if (own_normals) {
                const Vec3& n = mesh.normal[v[k]];
                p_.normal[0][k] = n.x * side;
                p_.normal[1][k] = n.y * side;
                p_.normal[2][k] = n.z * side;
            }
            if (wanted.colour) {
                const Vec3& colour = mesh.colour[v[k]];
                p_.colour[0][k] = colour.x;
                p_.colour[1][k] = colour.y;
                p_.colour[2][k] = colour.z;
            }
            if (wanted.uv) {
                p_.uv[0][k] = mesh.uv[v[k]].x;
                p_.uv[1][k] = mesh.uv[v[k]].y;
            }
        }
    }

    // A loop of its own: one question more made `set` twice as long for frames that do not ask.
    void set_places(const VertexIndices& v) {
        if (!in_.frame->attributes.object) return;
        for (std::size_t k = 0; k < 3; ++k)
            set_attribute(p_.object, k, DVec3(in_.mesh->position[v[k]]));
    }

    // Where the near plane cuts the edge between two vertices of the mesh.
    void set_cut(std::size_t k, std::uint32_t from, std::uint32_t to, double t) {
        const geom::Mesh& mesh = *in_.mesh;
        const Attributes wanted = in_.frame->attributes;
        const auto between_both = [&](float(&attribute)[3][3], const DVec3& a, const DVec3& b) {
            for (int c = 0; c < 3; ++c)
                attribute[c][k] = between(a[c], b[c], t);
        };
        if (wanted.position) between_both(p_.position, position(from), position(to));
        if (wanted.normal) between_both(p_.normal, normal(from), normal(to));
        if (wanted.colour)
            between_both(p_.colour, DVec3(mesh.colour[from]), DVec3(mesh.colour[to]));
        if (wanted.object)
            between_both(p_.object, DVec3(mesh.position[from]), DVec3(mesh.position[to]));
        if (!wanted.uv) return;
        p_.uv[0][k] = between(mesh.uv[from].x, mesh.uv[to].x, t);
        p_.uv[1][k] = between(mesh.uv[from].y, mesh.uv[to].y, t);
    }

    // What light at vertices or faces reads.
    void set_vertex(std::size_t k, std::uint32_t vertex) {
        set_attribute(p_.position, k, position(vertex));
        if (in_.frame->vertex_normals) set_attribute(p_.normal, k, normal(vertex));
    }

private:
    static void set_attribute(float (&attribute)[3][3], std::size_t k, const DVec3& value) {
        for (int c = 0; c < 3; ++c)
            attribute[c][k] = static_cast<float>(value[c]);
    }
    // In view space, times to_floats of the view.
    DVec3 position(std::uint32_t vertex) const {
        return (in_.view->linear * DVec3(in_.mesh->position[vertex]) + in_.view->translation) *
               in_.unit;
    }
    // On the side that the frame's `sides` choose; with vertex_normals unit and in view space.
    DVec3 normal(std::uint32_t vertex) const {
        const DVec3 own = DVec3(in_.mesh->normal[vertex]) * double{side_};
        const FrameState& frame = *in_.frame;
        if (!frame.vertex_normals) return own;
        const DVec3 facing(p_.facing[0], p_.facing[1], p_.facing[2]);
        const DVec3 n = frame.sides == Sides::eye && dot3(own, facing) < 0 ? -own : own;
        const auto& m = frame.normal_matrix;
        DVec3 in_view;
        for (int r = 0; r < 3; ++r)
            in_view[r] = (m[r][0] * n.x + m[r][1] * n.y) + m[r][2] * n.z;
        return normalized(in_view);
    }

    Primitive& p_;
    const GatherInput& in_;
    float side_;
};

// How a triangle's vertices wind in canonical order, seen in object space, which a mirrored view
// turns round; and whether that order turns the file's round.
struct Winding {
    bool clockwise, reordered;
};

// From the snapped edge functions.
Winding set_exact(Primitive& p, VertexIndices& v, const std::array<raster::ScreenVertex, 3>& vertex,
                  bool perspective) {
    const std::optional<raster::SetUp> t = raster::set_up(vertex, p.id);
    CHECK(t); // what is visible has an area
    const raster::Edges edges = raster::edges_of(t->triangle);
    const VertexIndices in_file_order = v;
#pragma GCC unroll 3
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t from = t->order.vertex[k];
        v[k] = in_file_order[from];
        p.inverse_w[k] = perspective ? static_cast<float>(vertex[from].depth) : 1.0F;
        p.a[k] = static_cast<double>(edges.a[k]);
        p.b[k] = static_cast<double>(edges.b[k]);
        p.c[k] = static_cast<double>(edges.c[k]);
        p.least[k] = static_cast<double>(-edges.bias[k]);
        p.a_int32[k] = static_cast<std::int32_t>(edges.a[k]);
        p.b_int32[k] = static_cast<std::int32_t>(edges.b[k]);
        p.c_int32[k] = static_cast<std::int32_t>(static_cast<std::uint32_t>(edges.c[k]));
    }
    // Below 2^30 inside, and a pixel further by less than 2^30 more: sides of less than 2^20.
    constexpr std::int64_t kSide = std::int64_t{1} << 20;
    const auto is_short = [&](std::int64_t step) { return -kSide < step && step < kSide; };
    p.fits_int32 = edges.area < std::int64_t{1} << 30 &&
                   std::all_of(edges.a.begin(), edges.a.end(), is_short) &&
                   std::all_of(edges.b.begin(), edges.b.end(), is_short);
    return {!t->triangle.flipped, t->order.odd};
}

// By position, so that no bit depends on the order in which the file names them.
struct Sorted {
    VertexIndices vertex;
    std::array<std::uint8_t, 3> place = {0, 1, 2}; // of the file's vertices
    bool odd = false;
};
Sorted sort_by_position(const VertexIndices& vertex_index, const geom::Mesh& mesh) {
    std::array<std::uint8_t, 3> order = {0, 1, 2};
    const auto before = [&](std::uint8_t i, std::uint8_t j) {
        const Vec3 &a = mesh.position[vertex_index[i]], &b = mesh.position[vertex_index[j]];
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    Sorted sorted;
    for (const std::size_t i : {0, 1, 0}) {
        if (!before(order[i + 1], order[i])) continue;
        std::swap(order[i], order[i + 1]);
        sorted.odd = !sorted.odd;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        sorted.vertex[k] = vertex_index[order[k]];
        sorted.place[order[k]] = static_cast<std::uint8_t>(k);
    }
    return sorted;
}

// From the very points that are drawn: where a vertex has snapped to, its attributes stand; those
// of a cut are the only ones that are computed.
void set_clipped(Primitive& p, const VertexIndices& vertex_index, const GatherInput& in,
                 const raster::ClippedTriangle& clipped) {
    const raster::ClippedWeights weights = raster::weights_of(clipped, in.transform->perspective);
    const Sorted sorted = sort_by_position(vertex_index, *in.mesh);
    const bool behind = clipped.clockwise != in.mirrored;
    Vertices vertices(p, in, sorted.vertex, {behind != sorted.odd, behind});
    VertexIndices from;
    for (std::size_t k = 0; k < 3; ++k)
        from[k] = vertex_index[clipped.vertex[k].edge_point.from];
    vertices.set(from);
    vertices.set_places(from);
    for (std::size_t k = 0; k < 3; ++k) {
        const raster::EdgePoint& point = clipped.vertex[k].edge_point;
        p.inverse_w[k] = 1;
        p.a[k] = weights.a[k];
        p.b[k] = weights.b[k];
        p.c[k] = weights.c[k];
        p.least[k] = 0;
        p.from[k] = sorted.place[point.from];
        p.to[k] = sorted.place[point.to];
        p.t[k] = point.cut() ? static_cast<float>(point.t) : 0.0F;
        if (point.cut()) vertices.set_cut(k, from[k], vertex_index[point.to], point.t);
    }
    if (!in.frame->attributes.vertices) return;
    for (std::size_t k = 0; k < 3; ++k)
        vertices.set_vertex(k, sorted.vertex[k]);
}

} // namespace

float between(double from, double to, double t) {
    return static_cast<float>(
        std::clamp(from + t * (to - from), std::min(from, to), std::max(from, to)));
}

PrimitiveCache::PrimitiveCache()
    : pool_(kMaxPrimitives), scratch_(std::make_unique<ShadingSetup>()), slot_(kSlots) {}

void PrimitiveCache::clear() {
    used_ = ready_ = 0;
}

const Primitive& PrimitiveCache::add_later(std::uint32_t triangle) {
    CHECK(!full());
    slot_[triangle % kSlots] = static_cast<std::uint16_t>(used_);
    return next(triangle, false);
}

void PrimitiveCache::set_up(const TriangleSource& source) {
    set_up_primitives(source, *scratch_, pool_.data() + ready_, static_cast<int>(used_ - ready_));
    for (; ready_ < used_; ++ready_)
        check_primitive(pool_[ready_], source.wanted);
}

Primitive& PrimitiveCache::next(std::uint32_t triangle, bool clipped) {
    Primitive& p = pool_[used_++];
    p.id = triangle;
    p.clipped = clipped;
    p.across = -1;
    p.step = 0;
    return p;
}

const Primitive& PrimitiveCache::add(const GatherInput& in, std::uint32_t triangle) {
    CHECK(!full());
    const std::size_t slot = used_;
    slot_[triangle % kSlots] = static_cast<std::uint16_t>(slot);
    const std::uint32_t* index = in.mesh->index.data() + std::size_t{triangle} * 3;
    VertexIndices v = {index[0], index[1], index[2]};
    const auto vertices = in.geometry->vertices();
    const std::array<raster::ScreenVertex, 3> vertex = {vertices[v[0]], vertices[v[1]],
                                                        vertices[v[2]]};
    if (!(vertex[0].on_screen() && vertex[1].on_screen() && vertex[2].on_screen())) {
        add_clipped(in, triangle, v);
        return pool_[slot];
    }
    Primitive& p = next(triangle, false);
    const Winding winds = set_exact(p, v, vertex, in.transform->perspective);
    const bool behind = winds.clockwise != in.mirrored; // of the order that now holds
    Vertices attributes(p, in, v, {behind, behind != winds.reordered});
    attributes.set(v);
    attributes.set_places(v);
    if (in.frame->steps != nullptr) p.step = step_for(p, *in.frame->steps);
    check_primitive(p, in.frame->attributes);
    return p;
}

void PrimitiveCache::add_clipped(const GatherInput& in, std::uint32_t triangle,
                                 const VertexIndices& vertex_index) {
    const raster::ClippedTriangles clipped = in.geometry->clipped_of(triangle);
    CHECK(clipped.count > 0); // what is visible has an area
    for (const raster::ClippedTriangle& one : clipped) {
        Primitive& p = next(triangle, true);
        p.fits_int32 = false;
        set_clipped(p, vertex_index, in, one);
        check_primitive(p, in.frame->attributes);
    }
    if (clipped.count < 2) return;
    const auto& [one, two] = clipped.triangle;
    pool_[used_ - 2].across = one.clockwise != two.clockwise
                                  ? Primitive::kFolded
                                  : static_cast<std::int8_t>(raster::opposite_common_edge(clipped));
}

} // namespace scanout::shade
