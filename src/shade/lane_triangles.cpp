#include "shade/lane_triangles.h"

#include "shade/check_lanes.h"
#include "shade/gather.h"

#define SIMD_FILE "shade/lane_triangles.cpp"
#include "simd/for_each_target.h"

#include "raster/triangle-inl.h"
#include "shade/footprint-inl.h"
#include "simd/blocks-inl.h"

SIMD_BEGIN(scanout::shade)

using raster::HWY_NAMESPACE::exchange;
using raster::HWY_NAMESPACE::is_top_left;
using raster::HWY_NAMESPACE::vertices_at;

using MaskX8 = Mask<F32x8::Tag>;

using Blocks = WordBlocks<F32x8::Tag>;

// Vertex k of a register of triangles.
struct Vertices {
    I32x8 x, y; // 1/256 pixel
    F32x8 inverse_w;
};

// How the canonical order (raster/primitive.h) turns that of the file round: vertices 0 and 1, then
// 1 and 2, then 0 and 1 change places where these hold.
struct Turns {
    MaskX8 of[3];
};
template <class T>
HWY_INLINE void turn(const Turns& turns, T (&of_vertex)[3]) {
    exchange(turns.of[0], of_vertex[0], of_vertex[1]);
    exchange(turns.of[1], of_vertex[1], of_vertex[2]);
    exchange(turns.of[2], of_vertex[0], of_vertex[1]);
}
HWY_INLINE MaskX8 sort_two(Vertices& a, Vertices& b) {
    const MaskX8 later = (b.y < a.y) | ((b.y == a.y) & (b.x < a.x));
    exchange(later, a.x, b.x);
    exchange(later, a.y, b.y);
    exchange(later, a.inverse_w, b.inverse_w);
    return later;
}
HWY_INLINE Turns put_in_order(Vertices (&v)[3]) {
    Turns turns;
    turns.of[0] = sort_two(v[0], v[1]);
    turns.of[1] = sort_two(v[1], v[2]);
    turns.of[2] = sort_two(v[0], v[1]);
    return turns;
}

// Vertices in file order. Lanes from `count` on repeat the last one.
struct Corners {
    std::uint32_t of[3][kLanesX8];
};
HWY_INLINE Corners corners_of(const TriangleSource& source, const std::uint32_t* id, int count) {
    Corners corner;
    SIMD_UNROLL
    for (int lane = 0; lane < kLanesX8; ++lane) {
        const std::uint32_t triangle = id[lane < count ? lane : count - 1];
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            corner.of[k][lane] = source.index[std::size_t{triangle} * 3 + std::size_t(k)];
    }
    return corner;
}

HWY_INLINE void load_vertices(const TriangleSource& source, const Corners& corner,
                              Vertices (&v)[3]) {
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        const auto at = vertices_at<F32x8>(source.vertex, corner.of[k]);
        v[k] = {at.word(0), at.word(1),
                source.perspective ? to_f32(at.last_double()) : F32x8(1.0F)};
    }
}

// Whole numbers of lanes: of 32 bits, or doubles.
HWY_INLINE void convert(I32x8 from, I32x8& to) {
    to = from;
}
HWY_INLINE void convert(I32x8 from, F64x8& to) {
    to = to_f64(from);
}
HWY_INLINE F32x8 rounded(I32x8 a) {
    return to_f32(a);
}
HWY_INLINE F32x8 rounded(F64x8 a) {
    return to_f32(a);
}
HWY_INLINE MaskX8 narrow(MaskX8 mask) {
    return mask;
}
HWY_INLINE MaskX8 narrow(const F64x8::DoubleMask& mask) {
    return to_f32(select(mask, F64x8(1.0), F64x8(0.0))) > F32x8(0.5F);
}

// Where a register of lanes lies.
struct Places {
    I32x8 x, y;               // centres, 1/256 pixel
    I32x8 sample_x, sample_y; // from there
};

// Areas opposite the vertices, where the lanes are shaded; exact, how they change in 1/256 pixel to
// the right and down, and the same areas, if they are wanted.
struct Areas {
    F32x8 rounded[3];
    F64x8 right[3], down[3], exact[3];
};

HWY_INLINE F64x8 wide(I32x8 a) {
    return to_f64(a);
}
HWY_INLINE F64x8 wide(F64x8 a) {
    return a;
}

// Moves the lanes where they are shaded. Returns which triangles wind clockwise on the screen, in
// this order of the vertices.
template <class N, class Scalar>
HWY_INLINE MaskX8 find_areas(const Vertices (&v)[3], bool wants_exact, Places& at, Areas& area) {
    const N zero = Scalar{0}, one = Scalar{1};
    const auto number = [](I32x8 whole) HWY_ATTR {
        N n;
        convert(whole, n);
        return n;
    };
    const N twice = number(v[1].x - v[0].x) * number(v[2].y - v[0].y) -
                    number(v[1].y - v[0].y) * number(v[2].x - v[0].x);
    const N sign = select(twice < zero, N(Scalar{-1}), one);
    N a[3], b[3], e[3];
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        const Vertices &from = v[k == 2 ? 0 : k + 1], &to = v[k == 0 ? 2 : k - 1];
        a[k] = sign * number(from.y - to.y);
        b[k] = sign * number(to.x - from.x);
        e[k] = a[k] * number(at.x - from.x) + b[k] * number(at.y - from.y);
    }
    if (any(!((at.sample_x | at.sample_y) == I32x8(0)))) { // not all cover the centre
        auto inside = zero == zero;
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            inside = inside & (e[k] >= select(is_top_left(a[k], b[k]), zero, one));
        const MaskX8 stays = narrow(inside);
        const I32x8 move_x = select(stays, 0, at.sample_x), move_y = select(stays, 0, at.sample_y);
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            e[k] = e[k] + (a[k] * number(move_x) + b[k] * number(move_y));
        at.x = at.x + move_x;
        at.y = at.y + move_y;
    }
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        area.rounded[k] = rounded(e[k]);
    if (wants_exact) SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        area.right[k] = wide(a[k]);
        area.down[k] = wide(b[k]);
        area.exact[k] = wide(e[k]);
    }
    return narrow(twice > zero);
}

// No side as long as 64 pixels: then areas within a pixel of the triangle are numbers of 31 bits.
HWY_INLINE bool are_small(const Vertices (&v)[3]) {
    const auto extent = [](I32x8 a, I32x8 b, I32x8 c) HWY_ATTR {
        return maximum(maximum(a, b), c) - minimum(minimum(a, b), c);
    };
    return all(maximum(extent(v[0].x, v[1].x, v[2].x), extent(v[0].y, v[1].y, v[2].y)) <
               I32x8(1 << 14));
}

// Attributes of kComponents floats a vertex, in canonical order: of[component][vertex].
template <int kComponents>
struct Attribute {
    F32x8 of[kComponents][3];
};
template <int kComponents>
HWY_INLINE void fetch_vertex(const float* from, const std::uint32_t (&index)[kLanesX8], int vertex,
                             Attribute<kComponents>& to) {
    const auto at = [&](int lane) HWY_ATTR {
        return reinterpret_cast<const std::int32_t*>(from) + std::size_t{index[lane]} * kComponents;
    };
    WordBlocks<F32x8::Tag> blocks;
    if constexpr (kComponents == 2)
        blocks = load_two<F32x8::Tag>(at);
    else
        blocks = load_three<F32x8::Tag>(at);
    SIMD_UNROLL
    for (int c = 0; c < kComponents; ++c)
        to.of[c][vertex] = from_bits(blocks.word(c == 2 ? 3 : c));
}
template <int kComponents>
HWY_INLINE Attribute<kComponents> fetch(const float* from, const Corners& corner,
                                        const Turns& turns) {
    Attribute<kComponents> fetched;
    fetch_vertex(from, corner.of[0], 0, fetched);
    fetch_vertex(from, corner.of[1], 1, fetched);
    fetch_vertex(from, corner.of[2], 2, fetched);
    SIMD_UNROLL
    for (int c = 0; c < kComponents; ++c)
        turn(turns, fetched.of[c]);
    return fetched;
}
template <int kComponents>
HWY_INLINE void put(const Attribute<kComponents>& attribute, float (&to)[kComponents][3][kRoom],
                    int lane) {
    SIMD_UNROLL
    for (int c = 0; c < kComponents; ++c)
        SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        store(attribute.of[c][k], to[c][k] + lane);
}

// Where vertices stand in the mesh.
using MeshPlaces = Attribute<3>;

HWY_INLINE void put_positions(const TriangleSource& s, const MeshPlaces& place, LaneTriangles& out,
                              int lane) {
    for (int k = 0; k < 3; ++k)
        for (int r = 0; r < 3; ++r) {
            const auto term = [&](int c) HWY_ATTR {
                return F64x8(s.linear[r][c]) * to_f64(place.of[c][k]);
            };
            const F64x8 turned = (term(0) + term(1)) + term(2);
            store(to_f32((turned + F64x8(s.translation[r])) * F64x8(s.scale)),
                  out.position[r][k] + lane);
        }
}

// The triangles' own normals, brought near length 1; `turned` ones the other way round.
HWY_INLINE void put_facing(const MeshPlaces& place, MaskX8 turned, LaneTriangles& out, int lane) {
    F64x8 one[3], two[3], n[3];
    SIMD_UNROLL
    for (int c = 0; c < 3; ++c) {
        const F64x8 from = to_f64(place.of[c][0]);
        one[c] = to_f64(place.of[c][1]) - from;
        two[c] = to_f64(place.of[c][2]) - from;
    }
    n[0] = one[1] * two[2] - one[2] * two[1];
    n[1] = one[2] * two[0] - one[0] * two[2];
    n[2] = one[0] * two[1] - one[1] * two[0];
    const F64x8 largest = maximum(maximum(abs(n[0]), abs(n[1])), abs(n[2]));
    const F64x8 sign = to_f64(select(turned, F32x8(-1.0F), F32x8(1.0F)));
    const F64x8 divisor = select(largest > F64x8(0.0), largest * sign, F64x8(1.0));
    SIMD_UNROLL
    for (int c = 0; c < 3; ++c)
        store(to_f32(n[c] / divisor), out.facing[c] + lane);
}

HWY_INLINE MaskX8 differ(MaskX8 a, MaskX8 b) {
    return (a & !b) | (b & !a);
}

// Which way round the vertices wind on the screen. Behind: as seen where the view is no mirror.
struct Windings {
    MaskX8 of_file, of_order;
};

// The side that normals are on, and `facing` (Vertices in shade/primitives.cpp).
HWY_INLINE void put_sides(const TriangleSource& s, const Windings& behind, const MeshPlaces& place,
                          LaneTriangles& out, int lane) {
    const MaskX8 none = F32x8(0.0F) > F32x8(0.0F);
    store(select(s.sides == Sides::face ? behind.of_file : none, F32x8(-1.0F), F32x8(1.0F)),
          out.side + lane);
    if (!s.wants_facing()) return;
    put_facing(place,
               s.sides == Sides::file ? differ(behind.of_order, behind.of_file) : behind.of_order,
               out, lane);
}

// What the vertices carry, besides u and v.
HWY_INLINE void put_attributes(const TriangleSource& s, const Corners& corner, const Turns& turns,
                               const Windings& behind, LaneTriangles& out, int lane) {
    MeshPlaces place;
    if (s.wanted.position || s.wants_facing()) place = fetch<3>(s.position, corner, turns);
    put_sides(s, behind, place, out, lane);
    if (s.wanted.normal) put(fetch<3>(s.normal, corner, turns), out.normal, lane);
    if (s.wanted.colour) put(fetch<3>(s.colour, corner, turns), out.colour, lane);
    if (s.wanted.position) put_positions(s, place, out, lane);
}

// How u and v change on the screen (footprint-inl.h).
HWY_INLINE void put_slopes(const Attribute<2>& uv, const Vertices (&v)[3], const Areas& area,
                           LaneTriangles& out, int lane) {
    F64x8 inverse_w[3], f[2][3];
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        inverse_w[k] = to_f64(v[k].inverse_w);
        f[0][k] = to_f64(uv.of[0][k]);
        f[1][k] = to_f64(uv.of[1][k]);
    }
    const texture::HWY_NAMESPACE::PlaneOf<2, F64x8> plane(area.right, area.down, inverse_w, f);
    const auto at = plane.at(area.exact);
    SIMD_UNROLL
    for (int c = 0; c < 2; ++c) {
        store(at.right[c], out.slope[c] + lane);
        store(at.down[c], out.slope[2 + c] + lane);
    }
}

void set_up_triangles(const TriangleSource& s, LaneTriangles& out, Block& b, int first, int count) {
    const MaskX8 mirrored = F32x8(s.mirrored ? 1.0F : 0.0F) > F32x8(0.0F);
    for (int i = first; i < first + count; i += kLanesX8) {
        const int live = first + count - i;
        const Corners corner = corners_of(s, out.id + i, live);
        Vertices v[3];
        load_vertices(s, corner, v);
        const Turns turns = put_in_order(v);
        Places at = {load<I32x8>(b.x + i), load<I32x8>(b.y + i), load<I32x8>(out.sample_x + i),
                     load<I32x8>(out.sample_y + i)};
        const bool sloped = s.wanted.uv && s.wanted.footprint;
        Areas area;
        const MaskX8 clockwise = are_small(v) ? find_areas<I32x8, std::int32_t>(v, sloped, at, area)
                                              : find_areas<F64x8, double>(v, sloped, at, area);
        const MaskX8 mine = iota<I32x8>(0) < I32x8(live);
        store(select(mine, at.x, load<I32x8>(b.x + i)), b.x + i);
        store(select(mine, at.y, load<I32x8>(b.y + i)), b.y + i);
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            store(area.rounded[k] * v[k].inverse_w, out.weight[k] + i);
        Windings behind;
        behind.of_order = differ(clockwise, mirrored);
        behind.of_file =
            differ(behind.of_order, differ(turns.of[0], differ(turns.of[1], turns.of[2])));
        put_attributes(s, corner, turns, behind, out, i);
        if (!s.wanted.uv) continue;
        const Attribute<2> uv = fetch<2>(s.uv, corner, turns);
        put(uv, out.uv, i);
        if (sloped) put_slopes(uv, v, area, out, i);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

SIMD_REGISTER(set_up_triangles);

TriangleSource triangle_source(const GatherInput& in) {
    const geom::Mesh& mesh = *in.mesh;
    const auto floats = [](const auto& attribute) {
        return reinterpret_cast<const float*>(attribute.data());
    };
    TriangleSource s{};
    s.index = mesh.index.data();
    s.vertex = in.geometry->vertices().data();
    s.position = floats(mesh.position);
    s.normal = floats(mesh.normal);
    s.uv = floats(mesh.uv);
    s.colour = floats(mesh.colour);
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c)
            s.linear[r][c] = in.view->linear[c][r];
        s.translation[r] = in.view->translation[r];
    }
    s.scale = in.unit;
    s.perspective = in.transform->perspective;
    s.mirrored = in.mirrored;
    s.sides = in.frame->sides;
    s.wanted = in.frame->attributes;
    return s;
}

void set_up_lanes(const TriangleSource& source, LaneTriangles& triangles, Block& block, int first,
                  int count) {
    SIMD_CALL(set_up_triangles)(source, triangles, block, first, count);
    check_triangles(triangles, source.wanted, first, count);
}

} // namespace scanout::shade
#endif
