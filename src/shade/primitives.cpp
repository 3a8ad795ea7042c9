#include "shade/primitives.h"

#include "base/check.h"
#include "raster/piece.h"
#include "shade/check_lanes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

namespace scanout::shade {
namespace {

using Corners = std::array<std::uint32_t, 3>; // vertices of the mesh

// The triangle's own normal, brought near length 1 so that a float holds it; only its direction
// matters.
void set_facing(Primitive& p, const geom::Mesh& mesh, const Corners& v, bool negate) {
    const DVec3 p0(mesh.position[v[0]]), p1(mesh.position[v[1]]), p2(mesh.position[v[2]]);
    DVec3 n = cross3(p1 - p0, p2 - p0);
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    if (largest > 0) n = n / (negate ? -largest : largest);
    for (int c = 0; c < 3; ++c)
        p.facing[c] = static_cast<float>(n[c]);
}

// In view space, in double, rounded once.
void set_positions(Primitive& p, const GatherInput& in, const Corners& v) {
    const double unit = to_floats(*in.view);
    for (std::size_t k = 0; k < 3; ++k) {
        const DVec3 at = in.view->linear * DVec3(in.mesh->position[v[k]]) + in.view->translation;
        for (int c = 0; c < 3; ++c)
            p.position[c][k] = static_cast<float>(at[c] * unit);
    }
}

void set_attributes(Primitive& p, const GatherInput& in, const Corners& v) {
    const geom::Mesh& mesh = *in.mesh;
    const Attributes wanted = in.frame->attributes;
    if (wanted.position) set_positions(p, in, v);
    for (std::size_t k = 0; k < 3; ++k) {
        for (int c = 0; c < 3; ++c) {
            if (wanted.normal) p.normal[c][k] = mesh.normal[v[k]][c];
            if (wanted.colour) p.colour[c][k] = mesh.colour[v[k]][c];
        }
        if (wanted.uv) {
            p.uv[0][k] = mesh.uv[v[k]].x;
            p.uv[1][k] = mesh.uv[v[k]].y;
        }
    }
}

// From the snapped edge functions. Returns whether the vertices wind clockwise in the order that
// now holds, seen in object space, which a mirrored view turns round.
bool set_exact(Primitive& p, Corners& v, const std::array<raster::ScreenVertex, 3>& corner,
               bool perspective) {
    const std::optional<raster::SetUp> t = raster::set_up(corner, p.id);
    CHECK(t); // what is visible has an area
    const raster::Edges edges = raster::edges_of(t->triangle);
    const Corners in_file_order = v;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t from = t->order.vertex[k];
        v[k] = in_file_order[from];
        p.inverse_w[k] = perspective ? static_cast<float>(corner[from].depth) : 1.0F;
        p.a[k] = static_cast<double>(edges.a[k]);
        p.b[k] = static_cast<double>(edges.b[k]);
        p.c[k] = static_cast<double>(edges.c[k]);
        p.least[k] = static_cast<double>(-edges.bias[k]);
    }
    return !t->triangle.flipped;
}

// By position, so that no bit depends on the order in which the file names them. Returns whether
// the order is odd.
bool sort_by_position(Corners& v, const geom::Mesh& mesh) {
    const auto before = [&](std::uint32_t i, std::uint32_t j) {
        const Vec3 &a = mesh.position[i], &b = mesh.position[j];
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    bool odd = false;
    for (const std::size_t i : {0, 1, 0}) {
        if (!before(v[i + 1], v[i])) continue;
        std::swap(v[i], v[i + 1]);
        odd = !odd;
    }
    return odd;
}

// Never outside the range of its ends.
float between(double from, double to, double share) {
    return static_cast<float>(
        std::clamp(from + share * (to - from), std::min(from, to), std::max(from, to)));
}

// Of vertex k, where the near plane cuts the edge between two vertices of the mesh.
void set_cut_attributes(Primitive& p, const GatherInput& in, std::size_t k, std::uint32_t from,
                        std::uint32_t to, double share) {
    const geom::Mesh& mesh = *in.mesh;
    const Attributes wanted = in.frame->attributes;
    const auto in_view = [&](std::uint32_t vertex) {
        return (in.view->linear * DVec3(mesh.position[vertex]) + in.view->translation) *
               to_floats(*in.view);
    };
    const DVec3 a = wanted.position ? in_view(from) : DVec3(0),
                b = wanted.position ? in_view(to) : DVec3(0);
    for (int c = 0; c < 3; ++c) {
        if (wanted.position) p.position[c][k] = between(a[c], b[c], share);
        if (wanted.normal)
            p.normal[c][k] = between(mesh.normal[from][c], mesh.normal[to][c], share);
        if (wanted.colour)
            p.colour[c][k] = between(mesh.colour[from][c], mesh.colour[to][c], share);
    }
    if (wanted.uv) {
        p.uv[0][k] = between(mesh.uv[from].x, mesh.uv[to].x, share);
        p.uv[1][k] = between(mesh.uv[from].y, mesh.uv[to].y, share);
    }
}

// From the very points that are drawn: where a vertex has snapped to, its attributes stand; those
// of a cut are the only ones that are computed.
void set_piece(Primitive& p, const Corners& corner, const GatherInput& in,
               const raster::Piece& piece) {
    const raster::PieceWeights weights = raster::weights_of(piece, in.transform->perspective);
    Corners v;
    for (std::size_t k = 0; k < 3; ++k) {
        v[k] = corner[piece.vertex[k].place.from];
        p.inverse_w[k] = 1;
        p.a[k] = weights.a[k];
        p.b[k] = weights.b[k];
        p.c[k] = weights.c[k];
        p.least[k] = 0;
    }
    set_attributes(p, in, v);
    for (std::size_t k = 0; k < 3; ++k) {
        const raster::EdgePlace& place = piece.vertex[k].place;
        if (place.cut())
            set_cut_attributes(p, in, k, corner[place.from], corner[place.to], place.share);
    }
    Corners sorted = corner;
    const bool odd = sort_by_position(sorted, *in.mesh);
    set_facing(p, *in.mesh, sorted, (piece.clockwise != odd) != in.mirrored);
}

} // namespace

Gatherer::Primitives::Primitives() : slot_(kSlots) {
    pool_.reserve(kRoom);
}

void Gatherer::Primitives::clear() {
    pool_.clear();
}

const Primitive& Gatherer::Primitives::get(const GatherInput& in, std::uint32_t triangle) {
    std::uint16_t& slot = slot_[triangle % kSlots];
    if (slot < pool_.size() && pool_[slot].id == triangle) return pool_[slot];
    CHECK(!full());
    slot = static_cast<std::uint16_t>(pool_.size());
    const std::uint32_t* index = in.mesh->index.data() + std::size_t{triangle} * 3;
    Corners v = {index[0], index[1], index[2]};
    const auto vertices = in.geometry->vertices();
    const std::array<raster::ScreenVertex, 3> corner = {vertices[v[0]], vertices[v[1]],
                                                        vertices[v[2]]};
    if (!(corner[0].on_screen() && corner[1].on_screen() && corner[2].on_screen())) {
        add_pieces(in, triangle, v);
        return pool_[slot];
    }
    Primitive& p = pool_.emplace_back();
    p.id = triangle;
    p.clipped = false;
    p.across = -1;
    const bool clockwise = set_exact(p, v, corner, in.transform->perspective);
    set_facing(p, *in.mesh, v, clockwise != in.mirrored);
    set_attributes(p, in, v);
    check_primitive(p, in.frame->attributes);
    return p;
}

void Gatherer::Primitives::add_pieces(const GatherInput& in, std::uint32_t triangle,
                                      const Corners& corner) {
    const raster::Pieces pieces = in.geometry->pieces(triangle);
    CHECK(pieces.count > 0); // what is visible has an area
    for (const raster::Piece& piece : pieces) {
        Primitive& p = pool_.emplace_back();
        p.id = triangle;
        p.clipped = true;
        p.across = -1;
        set_piece(p, corner, in, piece);
        check_primitive(p, in.frame->attributes);
    }
    if (pieces.count < 2) return;
    const auto& [one, two] = pieces.piece;
    (pool_.end() - 2)->across =
        one.clockwise != two.clockwise
            ? Primitive::kFolded
            : static_cast<std::int8_t>(raster::opposite_common_edge(pieces));
}

} // namespace scanout::shade
