// Triangles in the lanes of a register: their vertices in canonical order, and what those carry.
// The same operations as shade/primitives.cpp, and so the same bits. Included once for every SIMD
// target.
#if defined(SCANOUT_SHADE_TRIANGLE_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_TRIANGLE_LANES_INL_H
#undef SCANOUT_SHADE_TRIANGLE_LANES_INL_H
#else
#define SCANOUT_SHADE_TRIANGLE_LANES_INL_H
#endif

#include "shade/lane_triangles.h"

#include "raster/triangle-inl.h"
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

HWY_INLINE MaskX8 narrow(const F64x8::DoubleMask& mask) {
    return to_f32(select(mask, F64x8(1.0), F64x8(0.0))) > F32x8(0.5F);
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
HWY_INLINE Windings windings_of(MaskX8 clockwise_in_order, const Turns& turns, MaskX8 mirrored) {
    const MaskX8 behind = differ(clockwise_in_order, mirrored);
    return {differ(behind, differ(turns.of[0], differ(turns.of[1], turns.of[2]))), behind};
}

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

SIMD_END

#endif
