#include "shade/primitive_lanes.h"

#define SIMD_FILE "shade/primitive_lanes.cpp"
#include "simd/for_each_target.h"

#include "shade/triangle_lanes-inl.h"

SIMD_BEGIN(scanout::shade)

// The edges opposite the vertices (raster::Edges) of a register of triangles.
struct EdgeLanes {
    std::int32_t a[3][kLanesX8], b[3][kLanesX8];
    std::int32_t low_c[3][kLanesX8]; // modulo 2^32
    double c[3][kLanesX8];
    std::int32_t least[3][kLanesX8];
    float inverse_w[3][kLanesX8];
    std::int32_t whole[kLanesX8];
};

HWY_INLINE void find_edges(const Vertices (&v)[3], F64x8 twice, EdgeLanes& out) {
    const I32x8 zero = 0, side = 1 << 20;
    const MaskX8 flipped = narrow(twice < F64x8(0.0));
    MaskX8 whole = narrow(abs(twice) < F64x8(0x1p30));
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        const Vertices &from = v[k == 2 ? 0 : k + 1], &to = v[k == 0 ? 2 : k - 1];
        const I32x8 up = from.y - to.y, right = to.x - from.x;
        const I32x8 a = select(flipped, zero - up, up), b = select(flipped, zero - right, right);
        store(a, out.a[k]);
        store(b, out.b[k]);
        store(zero - (a * from.x + b * from.y), out.low_c[k]);
        store(F64x8(0.0) - (to_f64(a) * to_f64(from.x) + to_f64(b) * to_f64(from.y)), out.c[k]);
        store(select(is_top_left(a, b), zero, I32x8(1)), out.least[k]);
        store(v[k].inverse_w, out.inverse_w[k]);
        whole = whole & (zero - side < a) & (a < side) & (zero - side < b) & (b < side);
    }
    store(select(whole, I32x8(1), zero), out.whole);
}

HWY_INLINE void put_vertices(const float (&from)[3][kRoom], int lane, float (&to)[3]) {
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        to[k] = from[k][lane];
}

HWY_INLINE void put_primitive(const TriangleSource& s, const EdgeLanes& e, const LaneTriangles& t,
                              int lane, Primitive& p) {
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        p.a[k] = p.whole_a[k] = e.a[k][lane];
        p.b[k] = p.whole_b[k] = e.b[k][lane];
        p.c[k] = e.c[k][lane];
        p.whole_c[k] = e.low_c[k][lane];
        p.least[k] = e.least[k][lane];
        p.inverse_w[k] = e.inverse_w[k][lane];
    }
    p.whole = e.whole[lane] != 0;
    const float side = t.side[lane];
    SIMD_UNROLL
    for (int c = 0; c < 3; ++c) {
        if (s.wants_facing()) p.facing[c] = t.facing[c][lane];
        if (s.wanted.normal) SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            p.normal[c][k] = t.normal[c][k][lane] * side;
        if (s.wanted.colour) put_vertices(t.colour[c], lane, p.colour[c]);
        if (s.wanted.position) put_vertices(t.position[c], lane, p.position[c]);
        if (s.wanted.uv && c < 2) put_vertices(t.uv[c], lane, p.uv[c]);
    }
}

void set_up_all(const TriangleSource& s, LaneTriangles& room, Primitive* first, int count) {
    const MaskX8 mirrored = F32x8(s.mirrored ? 1.0F : 0.0F) > F32x8(0.0F);
    for (int i = 0; i < count; i += kLanesX8) {
        const int live = count - i < kLanesX8 ? count - i : kLanesX8;
        for (int lane = 0; lane < live; ++lane)
            room.id[lane] = first[i + lane].id;
        const Corners corner = corners_of(s, room.id, live);
        Vertices v[3];
        load_vertices(s, corner, v);
        const Turns turns = put_in_order(v);
        const F64x8 twice = to_f64(v[1].x - v[0].x) * to_f64(v[2].y - v[0].y) -
                            to_f64(v[1].y - v[0].y) * to_f64(v[2].x - v[0].x);
        EdgeLanes edges;
        find_edges(v, twice, edges);
        put_attributes(s, corner, turns, windings_of(narrow(twice > F64x8(0.0)), turns, mirrored),
                       room, 0);
        if (s.wanted.uv) put(fetch<2>(s.uv, corner, turns), room.uv, 0);
        for (int lane = 0; lane < live; ++lane)
            put_primitive(s, edges, room, lane, first[i + lane]);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

SIMD_REGISTER(set_up_all);

void set_up_primitives(const TriangleSource& source, LaneTriangles& room, Primitive* first,
                       int count) {
    SIMD_CALL(set_up_all)(source, room, first, count);
}

} // namespace scanout::shade
#endif
