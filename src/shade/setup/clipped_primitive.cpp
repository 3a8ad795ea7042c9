#include "shade/setup/clipped_primitive.h"

#include "math/rotation.h"
#include "shade/gather/gather_input.h"

#include <algorithm>
#include <array>
#include <cmath>
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

// Sides::eye, as triangle_setup-inl.h decides it.
double side_of_normals(const geom::Mesh& mesh, const VertexIndices& v, const float (&facing)[3]) {
    const DVec3 towards(facing[0], facing[1], facing[2]);
    const auto lean = [&](std::uint32_t vertex) {
        return dot3(DVec3(mesh.normal[vertex]), towards);
    };
    const auto [least, most] = std::minmax({lean(v[0]), lean(v[1]), lean(v[2])});
    return most + least < 0 ? -1 : 1;
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

// The attributes that a triangle's vertices have in this frame, and those of cuts between them.
class Attributed {
public:
    // behind: the eye sees the side from which the vertices wind clockwise, in the order of the
    // file. Sets the primitive's `back`, and `facing`, if something of it is read.
    Attributed(Primitive& p, const GatherInput& in, const Sorted& sorted, bool behind)
        : p_(p), in_(in), side_(in.frame->sides == Sides::face && behind ? -1.0 : 1.0) {
        const Sides sides = in.frame->sides;
        p.back = behind;
        if (sides == Sides::eye || in.frame->attributes.vertices || in.frame->attributes.facing)
            set_facing(p, *in.mesh, sorted.vertex,
                       (behind != sorted.odd) != (sides == Sides::file && behind));
        if (sides == Sides::eye) side_ = side_of_normals(*in.mesh, sorted.vertex, p.facing);
    }

    // Vertex k of the clipped triangle: at t between two vertices of the mesh, where it is a cut.
    void set(std::size_t k, std::uint32_t from, std::uint32_t to, bool cut, double t) {
        const geom::Mesh& mesh = *in_.mesh;
        const Attributes wanted = in_.frame->attributes;
        const auto set_one = [&](float(&attribute)[3][3], const DVec3& a, const DVec3& b) {
            for (int c = 0; c < 3; ++c)
                attribute[c][k] = cut ? between(a[c], b[c], t) : static_cast<float>(a[c]);
        };
        if (wanted.position) set_one(p_.position, position(from), position(to));
        if (wanted.normal) set_one(p_.normal, normal(from), normal(to));
        if (wanted.colour) set_one(p_.colour, DVec3(mesh.colour[from]), DVec3(mesh.colour[to]));
        if (wanted.object) set_one(p_.object, DVec3(mesh.position[from]), DVec3(mesh.position[to]));
        if (!wanted.uv) return;
        for (int c = 0; c < 2; ++c)
            p_.uv[c][k] = cut ? between(mesh.uv[from][c], mesh.uv[to][c], t) : mesh.uv[from][c];
        if (in_.frame->exact_uv) set_exact_uv(k, mesh.exact_uv[from], mesh.exact_uv[to], cut, t);
    }

    // What light at vertices or faces reads.
    void set_vertex(std::size_t k, std::uint32_t vertex) {
        set_attribute(p_.position, k, position(vertex));
        if (in_.frame->vertex_normals) set_attribute(p_.normal, k, normal(vertex));
    }

private:
    // What interpolation in double needs (interpolate/large_uv-inl.h).
    void set_exact_uv(std::size_t k, const DVec2& from, const DVec2& to, bool cut, double t) {
        p_.exact_inverse_w[k] = 1;
        for (int c = 0; c < 2; ++c) {
            const double f = cut ? from[c] + t * (to[c] - from[c]) : from[c];
            p_.exact_uv[c][k] = f;
            p_.large_uv |= std::abs(f) > double{geom::Mesh::kLargeUv};
        }
    }
    // In view space, times to_floats of the view.
    DVec3 position(std::uint32_t vertex) const {
        return (in_.view->linear * DVec3(in_.mesh->position[vertex]) + in_.view->translation) *
               in_.unit;
    }
    // On the side that the frame's `sides` choose; with vertex_normals unit and in view space.
    DVec3 normal(std::uint32_t vertex) const {
        const DVec3 own = DVec3(in_.mesh->normal[vertex]) * side_;
        return in_.frame->vertex_normals ? vertex_normal(*in_.frame, own) : own;
    }

    Primitive& p_;
    const GatherInput& in_;
    double side_;
};

} // namespace

DVec3 vertex_normal(const FrameState& frame, const DVec3& own) {
    const auto& m = frame.normal_matrix;
    DVec3 in_view;
    for (int r = 0; r < 3; ++r)
        in_view[r] = (m[r][0] * own.x + m[r][1] * own.y) + m[r][2] * own.z;
    return normalized(in_view);
}

float between(double from, double to, double t) {
    return static_cast<float>(
        std::clamp(from + t * (to - from), std::min(from, to), std::max(from, to)));
}

void set_up_clipped(const GatherInput& in, const raster::ClippedTriangle& clipped, Primitive& p) {
    const std::uint32_t* index = in.mesh->index.data() + std::size_t{p.id} * 3;
    const raster::ClippedWeights weights = raster::weights_of(clipped, in.transform->perspective);
    const Sorted sorted = sort_by_position({index[0], index[1], index[2]}, *in.mesh);
    Attributed attributes(p, in, sorted, clipped.clockwise != in.mirrored);
    p.fits_int32 = false;
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
        attributes.set(k, index[point.from], index[point.to], point.cut(), point.t);
    }
    if (!in.frame->attributes.vertices) return;
    for (std::size_t k = 0; k < 3; ++k)
        attributes.set_vertex(k, sorted.vertex[k]);
}

} // namespace scanout::shade
