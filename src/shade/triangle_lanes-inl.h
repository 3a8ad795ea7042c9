// Triangles in the lanes of a register: their vertices in canonical order, the edges between them,
// and what those carry.
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
SIMD_INLINE void turn(const Turns& turns, T (&of_vertex)[3]) {
    exchange(turns.of[0], of_vertex[0], of_vertex[1]);
    exchange(turns.of[1], of_vertex[1], of_vertex[2]);
    exchange(turns.of[2], of_vertex[0], of_vertex[1]);
}
SIMD_INLINE MaskX8 sort_two(Vertices& a, Vertices& b) {
    const MaskX8 later = (b.y < a.y) | ((b.y == a.y) & (b.x < a.x));
    exchange(later, a.x, b.x);
    exchange(later, a.y, b.y);
    exchange(later, a.inverse_w, b.inverse_w);
    return later;
}
SIMD_INLINE Turns put_in_order(Vertices (&v)[3]) {
    Turns turns;
    turns.of[0] = sort_two(v[0], v[1]);
    turns.of[1] = sort_two(v[1], v[2]);
    turns.of[2] = sort_two(v[0], v[1]);
    return turns;
}

// Triangles that the file has far from each other may stand side by side here.
SIMD_INLINE void prefetch_corners(const TriangleSource& source, const LaneTriangles& of, int begin,
                                  int end) {
    for (int i = begin; i < end; ++i)
        __builtin_prefetch(source.index + std::size_t{of.id[i]} * 3);
}
// Of a register of triangles, in the order of the file. In memory, whence they are read one by one.
SIMD_INLINE void put_corners(const TriangleSource& source, LaneTriangles& out, int at) {
    for (int lane = at; lane < at + kLanesX8; ++lane) {
        const std::uint32_t* index = source.index + std::size_t{out.id[lane]} * 3;
        for (int k = 0; k < 3; ++k)
            out.corner[k][lane] = index[k];
        if (!source.wants_position()) continue;
        for (int k = 0; k < 3; ++k) {
            __builtin_prefetch(source.position + std::size_t{index[k]} * 3);
            if (source.wanted.normal) __builtin_prefetch(source.normal + std::size_t{index[k]} * 3);
        }
    }
}
// Into the order that their vertices have been put in: cheaper than to turn all that they carry.
SIMD_INLINE void turn_corners(const Turns& turns, LaneTriangles& out, int at) {
    I32x8 corner[3] = {load<I32x8>(out.corner[0] + at), load<I32x8>(out.corner[1] + at),
                       load<I32x8>(out.corner[2] + at)};
    turn(turns, corner);
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        store(corner[k], out.corner[k] + at);
}

SIMD_INLINE void load_vertices(const TriangleSource& source, const LaneTriangles& of, int at,
                               Vertices (&v)[3]) {
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        const auto found = vertices_at<F32x8>(source.vertex, of.corner[k] + at);
        v[k] = {found.word(0), found.word(1),
                source.perspective ? to_f32(found.last_double()) : F32x8(1.0F)};
    }
}

SIMD_INLINE MaskX8 narrow(const F64x8::DoubleMask& mask) {
    return to_f32(select(mask, F64x8(1.0), F64x8(0.0))) > F32x8(0.5F);
}

// No side as long as 64 pixels: then areas within a pixel of the triangle are numbers of 31 bits.
SIMD_INLINE bool are_small(const Vertices (&v)[3]) {
    const auto extent = [](I32x8 a, I32x8 b, I32x8 c) SIMD_LAMBDA {
        return maximum(maximum(a, b), c) - minimum(minimum(a, b), c);
    };
    return all(maximum(extent(v[0].x, v[1].x, v[2].x), extent(v[0].y, v[1].y, v[2].y)) <
               I32x8(1 << 14));
}

// Twice the area of a register of triangles, counter-clockwise below 0 as y runs down.
struct Doubled {
    MaskX8 below_zero, above_zero, whole;
    I32x8 low; // its amount, modulo 2^32
};
SIMD_INLINE Doubled doubled(const Vertices (&v)[3], bool wants_exact, double* exact) {
    const I32x8 right_1 = v[1].x - v[0].x, down_1 = v[1].y - v[0].y, right_2 = v[2].x - v[0].x,
                down_2 = v[2].y - v[0].y, zero = 0;
    const I32x8 low = right_1 * down_2 - down_1 * right_2;
    if (are_small(v) & !wants_exact)
        return {(low < zero), (low > zero), zero == zero, maximum(low, zero - low)};
    const F64x8 twice = to_f64(right_1) * to_f64(down_2) - to_f64(down_1) * to_f64(right_2);
    const MaskX8 below_zero = narrow(twice < F64x8(0.0));
    store(abs(twice), exact);
    // Below 2^30 inside, and a pixel further by less than 2^30 more: sides of less than 2^20.
    MaskX8 whole = narrow(abs(twice) < F64x8(0x1p30));
    const I32x8 side = 1 << 20;
    const I32x8 steps[6] = {right_1, down_1, right_2, down_2, right_2 - right_1, down_2 - down_1};
    SIMD_UNROLL
    for (const I32x8& step : steps)
        whole = whole & (zero - side < step) & (step < side);
    return {below_zero, narrow(twice > F64x8(0.0)), whole, select(below_zero, zero - low, low)};
}

// The areas opposite the vertices.
SIMD_INLINE void put_areas(const Vertices (&v)[3], const Doubled& twice, LaneTriangles& out,
                           int lane) {
    const I32x8 zero = 0;
    store(v[0].x, out.x + lane);
    store(v[0].y, out.y + lane);
    store(twice.low, out.twice + lane);
    store(select(twice.whole, I32x8(1), zero), out.whole + lane);
    SIMD_UNROLL
    for (int k = 1; k < 3; ++k) { // the edge from vertex 2 to 0, or 0 to 1
        const Vertices &from = v[k == 1 ? 2 : 0], &to = v[k == 1 ? 0 : 1];
        const I32x8 up = from.y - to.y, right = to.x - from.x;
        store(select(twice.below_zero, zero - up, up), out.right[k - 1] + lane);
        store(select(twice.below_zero, zero - right, right), out.down[k - 1] + lane);
    }
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        store(v[k].inverse_w, out.inverse_w[k] + lane);
}

// Attributes of kComponents floats a vertex, in canonical order: of[component][vertex].
template <int kComponents>
struct Attribute {
    F32x8 of[kComponents][3];
};
template <int kComponents>
SIMD_INLINE void fetch_vertex(const float* from, const std::uint32_t* index, int vertex,
                              Attribute<kComponents>& to) {
    const auto at = [&](int lane) SIMD_LAMBDA {
        return reinterpret_cast<const std::int32_t*>(from) + std::size_t{index[lane]} * kComponents;
    };
    WordBlocks<F32x8::Tag> blocks;
    if constexpr (kComponents == 2)
        blocks = load_two<F32x8::Tag>(at);
    else
        blocks = load_three<F32x8::Tag>(at);
    SIMD_UNROLL
    for (int c = 0; c < kComponents; ++c)
        to.of[c][vertex] = from_bits(blocks.word(c == 2 ? kThird : c));
}
template <int kComponents>
SIMD_INLINE Attribute<kComponents> fetch(const float* from, const LaneTriangles& of, int at) {
    Attribute<kComponents> fetched;
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        fetch_vertex(from, of.corner[k] + at, k, fetched);
    return fetched;
}
template <int kComponents>
SIMD_INLINE void put(const Attribute<kComponents>& attribute, float (&to)[kComponents][3][kRoom],
                     int lane) {
    SIMD_UNROLL
    for (int c = 0; c < kComponents; ++c)
        SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        store(attribute.of[c][k], to[c][k] + lane);
}

// Where vertices stand in the mesh.
using MeshPlaces = Attribute<3>;

SIMD_INLINE void put_positions(const TriangleSource& s, const MeshPlaces& place, LaneTriangles& out,
                               int lane) {
    for (int k = 0; k < 3; ++k)
        for (int r = 0; r < 3; ++r) {
            const auto term = [&](int c) SIMD_LAMBDA {
                return F64x8(s.linear[r][c]) * to_f64(place.of[c][k]);
            };
            const F64x8 turned = (term(0) + term(1)) + term(2);
            store(to_f32((turned + F64x8(s.translation[r])) * F64x8(s.scale)),
                  out.position[r][k] + lane);
        }
}

// The triangles' own normals, brought near length 1; `turned` ones the other way round.
SIMD_INLINE void put_facing(const MeshPlaces& place, MaskX8 turned, LaneTriangles& out, int lane) {
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

SIMD_INLINE MaskX8 differ(MaskX8 a, MaskX8 b) {
    return (a & !b) | (b & !a);
}

// Which way round the vertices wind on the screen. Behind: as seen where the view is no mirror.
struct Windings {
    MaskX8 of_file, of_order;
};
SIMD_INLINE Windings windings_of(MaskX8 clockwise_in_order, const Turns& turns, MaskX8 mirrored) {
    const MaskX8 behind = differ(clockwise_in_order, mirrored);
    return {differ(behind, differ(turns.of[0], differ(turns.of[1], turns.of[2]))), behind};
}

// The side that normals are on, and which way `facing` goes (Vertices in shade/primitives.cpp).
SIMD_INLINE void put_sides(const TriangleSource& s, const Windings& behind, LaneTriangles& out,
                           int lane) {
    const MaskX8 none = F32x8(0.0F) > F32x8(0.0F);
    store(select(s.sides == Sides::face ? behind.of_file : none, F32x8(-1.0F), F32x8(1.0F)),
          out.side + lane);
    if (!s.wants_facing()) return;
    const MaskX8 turned =
        s.sides == Sides::file ? differ(behind.of_order, behind.of_file) : behind.of_order;
    store(select(turned, I32x8(1), I32x8(0)), out.turned + lane);
}

// A register of triangles in `out`, from `at` on, whose ids are known: how they lie on the screen.
// Returns whether all are whole; exact_twice is set where not all are, or if it is wanted.
SIMD_INLINE bool set_up_register(const TriangleSource& s, bool wants_exact, LaneTriangles& out,
                                 int at) {
    Vertices v[3];
    load_vertices(s, out, at, v);
    const Turns turns = put_in_order(v);
    turn_corners(turns, out, at);
    const Doubled twice = doubled(v, wants_exact, out.exact_twice + at);
    put_areas(v, twice, out, at);
    const MaskX8 mirrored = F32x8(s.mirrored ? 1.0F : 0.0F) > F32x8(0.0F);
    put_sides(s, windings_of(twice.above_zero, turns, mirrored), out, at);
    return all(twice.whole);
}
// And then what their vertices carry: not at once with it, so that compilers leave the corners in
// memory, and so that no load waits for them.
SIMD_INLINE void put_attributes(const TriangleSource& s, LaneTriangles& out, int at) {
    if (s.wants_position()) {
        const MeshPlaces place = fetch<3>(s.position, out, at);
        if (s.wants_facing()) put_facing(place, load<I32x8>(out.turned + at) == I32x8(1), out, at);
        if (s.wanted.position) put_positions(s, place, out, at);
    }
    if (s.wanted.normal) put(fetch<3>(s.normal, out, at), out.normal, at);
    if (s.wanted.colour) put(fetch<3>(s.colour, out, at), out.colour, at);
    if (s.wanted.uv) put(fetch<2>(s.uv, out, at), out.uv, at);
}

SIMD_END

#endif
