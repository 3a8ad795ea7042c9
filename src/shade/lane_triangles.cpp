#include "shade/lane_triangles.h"

#include "shade/check_lanes.h"
#include "shade/gather.h"

#define SIMD_FILE "shade/lane_triangles.cpp"
#include "simd/for_each_target.h"

#include "shade/footprint-inl.h"
#include "shade/triangle_lanes-inl.h"

SIMD_BEGIN(scanout::shade)

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
        put_attributes(s, corner, turns, windings_of(clockwise, turns, mirrored), out, i);
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
