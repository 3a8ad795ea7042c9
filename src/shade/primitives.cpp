#include "shade/primitives.h"

#include "base/check.h"
#include "math/rotation.h"
#include "raster/clip.h"
#include "shade/interpolation_step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace scanout::shade {
namespace {

using Corners = std::array<std::uint32_t, 3>; // vertices of the mesh, in canonical order

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

// Each vertex's own, unit and in view space, on the side that the frame's `sides` choose.
void set_corner_normals(Primitive& p, const GatherInput& in, const Corners& v, bool behind) {
    const auto& m = in.frame->normal_matrix;
    for (std::size_t k = 0; k < 3; ++k) {
        const DVec3 own(in.mesh->normal[v[k]]), facing(p.facing[0], p.facing[1], p.facing[2]);
        const Sides sides = in.frame->sides;
        const bool turn =
            sides == Sides::eye ? dot3(own, facing) < 0 : sides == Sides::face && behind;
        const DVec3 n = turn ? -own : own;
        DVec3 seen;
        for (int r = 0; r < 3; ++r)
            seen[r] = (m[r][0] * n.x + m[r][1] * n.y) + m[r][2] * n.z;
        seen = normalized(seen);
        for (int c = 0; c < 3; ++c)
            p.normal[c][k] = static_cast<float>(seen[c]);
    }
}

// The eye sees the side from which the vertices wind clockwise: in the order of `v`, and in the
// file's.
struct Behind {
    bool of_order, of_file;
};
void set_attributes(Primitive& p, const GatherInput& in, const Corners& v, Behind behind) {
    const geom::Mesh& mesh = *in.mesh;
    const FrameState& frame = *in.frame;
    const Attributes wanted = frame.attributes;
    // Mappings, and maps that lean the normal, ask where the face itself lies.
    const bool lies = wanted.object || (wanted.maps & (bit_of(kNormalMap) | bit_of(kBumpMap))) != 0;
    if (frame.sides == Sides::eye || wanted.corners || lies)
        set_facing(p, mesh, v, behind.of_order != (frame.sides == Sides::file && behind.of_file));
    if (wanted.position || wanted.corners) set_positions(p, in, v);
    const bool own_normals = wanted.normal && !frame.corner_normals;
    if (frame.corner_normals) set_corner_normals(p, in, v, behind.of_file);
    const float side = frame.sides == Sides::face && behind.of_file ? -1.0F : 1.0F;
    for (std::size_t k = 0; k < 3; ++k) {
        for (int c = 0; c < 3; ++c) {
            if (own_normals) p.normal[c][k] = mesh.normal[v[k]][c] * side;
            if (wanted.colour) p.colour[c][k] = mesh.colour[v[k]][c];
            if (wanted.object) p.object[c][k] = mesh.position[v[k]][c];
        }
        if (wanted.uv && !in.frame->mapped) {
            p.uv[0][k] = mesh.uv[v[k]].x;
            p.uv[1][k] = mesh.uv[v[k]].y;
        }
    }
}

// How a triangle's vertices wind in canonical order, seen in object space, which a mirrored view
// turns round; and whether that order turns the file's round.
struct Winding {
    bool clockwise, reordered;
};

// From the snapped edge functions.
Winding set_exact(Primitive& p, Corners& v, const std::array<raster::ScreenVertex, 3>& corner,
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
    return {!t->triangle.flipped, t->order.odd};
}

// From the whole triangle before the clip, so that no attribute is ever clipped.
Winding set_clipped(Primitive& p, Corners& v, const GatherInput& in) {
    const auto clip_vertex = [&](std::size_t k) {
        return in.transform->to_clip(in.mesh->position[v[k]]);
    };
    const raster::HomogeneousTriangle t =
        raster::homogeneous_triangle({clip_vertex(0), clip_vertex(1), clip_vertex(2)});
    const Corners in_file_order = v;
    for (std::size_t k = 0; k < 3; ++k) {
        v[k] = in_file_order[t.order.vertex[k]];
        p.inverse_w[k] = 1;
        p.a[k] = t.row[k].x / raster::kSubpixel;
        p.b[k] = t.row[k].y / raster::kSubpixel;
        p.c[k] = t.row[k].z;
        p.least[k] = 0;
    }
    return {t.clockwise, t.order.odd};
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
    Primitive& p = pool_.emplace_back();
    p.id = triangle;
    const geom::Mesh& mesh = *in.mesh;
    const std::uint32_t* index = mesh.index.data() + std::size_t{triangle} * 3;
    Corners v = {index[0], index[1], index[2]};
    const auto vertices = in.geometry->vertices();
    const std::array<raster::ScreenVertex, 3> corner = {vertices[v[0]], vertices[v[1]],
                                                        vertices[v[2]]};
    p.clipped = !(corner[0].on_screen() && corner[1].on_screen() && corner[2].on_screen());
    const Winding winds =
        p.clipped ? set_clipped(p, v, in) : set_exact(p, v, corner, in.transform->perspective);
    const bool behind = winds.clockwise != in.mirrored; // of the order that now holds
    set_attributes(p, in, v, {behind, behind != winds.reordered});
    p.step = in.frame->steps == nullptr ? std::int8_t{0} : step_for(p, *in.frame->steps);
    return p;
}

} // namespace scanout::shade
