#include "shade/setup/primitive_setup.h"

#include "geom/mesh.h"

#define SIMD_FILE "shade/setup/primitive_setup.cpp"
#include "simd/for_each_target.h"

#include "shade/setup/triangle_setup-inl.h"

SIMD_BEGIN(scanout::shade)

constexpr double kLargeUv = geom::Mesh::kLargeUv;

SIMD_INLINE void copy_vertices(const float (&from)[3][kPaddedBlock], int lane, float (&to)[3]) {
    SIMD_FOR (int k = 0; k < 3; ++k)
        to[k] = from[k][lane];
}

// The edge functions: a x + b y + c.
SIMD_INLINE void set_edges(const ShadingSetup& t, int lane, Primitive& p) {
    const std::int32_t a[3] = {-(t.right[0][lane] + t.right[1][lane]), t.right[0][lane],
                               t.right[1][lane]};
    const std::int32_t b[3] = {-(t.down[0][lane] + t.down[1][lane]), t.down[0][lane],
                               t.down[1][lane]};
    SIMD_FOR (int k = 0; k < 3; ++k) {
        p.a[k] = p.a_int32[k] = a[k];
        p.b[k] = p.b_int32[k] = b[k];
        const std::int64_t at_vertex =
            std::int64_t{a[k]} * t.x[lane] + std::int64_t{b[k]} * t.y[lane];
        const std::int64_t there = k != 0 ? 0
                                   : t.fits_int32[lane] != 0
                                       ? t.twice_area[lane]
                                       : static_cast<std::int64_t>(t.exact_twice_area[lane]);
        const std::int64_t c = there - at_vertex;
        p.c[k] = static_cast<double>(c);
        p.c_int32[k] = static_cast<std::int32_t>(static_cast<std::uint32_t>(c));
        p.least[k] = a[k] > 0 || (a[k] == 0 && b[k] > 0) ? 0 : 1; // top and left edges
        p.inverse_w[k] = t.inverse_w[k][lane];
    }
    p.fits_int32 = t.fits_int32[lane] != 0;
}

// What interpolation in double needs (interpolate/large_uv-inl.h).
SIMD_INLINE void copy_exact_uv(const TriangleSource& s, const ShadingSetup& t, int lane,
                               Primitive& p) {
    SIMD_FOR (int k = 0; k < 3; ++k) {
        const std::uint32_t vertex = t.vertex_index[k][lane];
        p.exact_inverse_w[k] = s.perspective ? s.vertex[vertex].depth : 1.0;
        SIMD_FOR (int c = 0; c < 2; ++c) {
            const double f = s.exact_uv[vertex][c];
            p.exact_uv[c][k] = f;
            p.large_uv |= f > kLargeUv || f < -kLargeUv;
        }
    }
}

SIMD_INLINE void copy_primitive(const TriangleSource& s, const ShadingSetup& t, int lane,
                                Primitive& p) {
    set_edges(t, lane, p);
    if (s.wants_facing()) p.back = t.back[lane] != 0;
    SIMD_FOR (int c = 0; c < 3; ++c) {
        if (s.wants_facing()) p.facing[c] = t.facing[c][lane];
        if (s.wanted.normal) copy_vertices(t.normal[c], lane, p.normal[c]);
        if (s.wanted.colour) copy_vertices(t.colour[c], lane, p.colour[c]);
        if (s.wants_view_position()) copy_vertices(t.position[c], lane, p.position[c]);
        if (s.wanted.uv && c < 2) copy_vertices(t.uv[c], lane, p.uv[c]);
    }
    if (s.exact_uv != nullptr) copy_exact_uv(s, t, lane, p);
}

void set_up_all(const TriangleSource& s, ShadingSetup& scratch, Primitive* first, int count) {
    for (int i = 0; i < count; i += kLanesX8) {
        const int live = count - i < kLanesX8 ? count - i : kLanesX8;
        for (int lane = 0; lane < kLanesX8; ++lane)
            scratch.id[lane] = first[i + (lane < live ? lane : live - 1)].id;
        using D = F32x8::Tag;
        load_vertex_indices<D>(s, scratch, 0);
        set_up_register<D>(s, scratch, 0);
        set_up_attributes<D>(s, scratch, 0);
        for (int lane = 0; lane < live; ++lane)
            copy_primitive(s, scratch, lane, first[i + lane]);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

SIMD_REGISTER(set_up_all);

void set_up_primitives(const TriangleSource& source, ShadingSetup& scratch, Primitive* first,
                       int count) {
    SIMD_CALL(set_up_all, source, scratch, first, count);
}

} // namespace scanout::shade
#endif
