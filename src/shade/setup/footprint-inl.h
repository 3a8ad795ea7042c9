// The footprint of a pixel in a texture, in texels. The derivatives of u and v are computed from
// the triangle's plane at the sample, not from quads of pixels, so the triangle's edges and size
// change nothing (HARD-CASES 38, 39). They give the level of detail of a texture, log2(max(|d/dx|,
// |d/dy|)) in texels (Microsoft 2015, 7.18.11; Heckbert 1989; HARD-CASES R24).
#if defined(SCANOUT_SHADE_SETUP_FOOTPRINT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_SETUP_FOOTPRINT_INL_H
#undef SCANOUT_SHADE_SETUP_FOOTPRINT_INL_H
#else
#define SCANOUT_SHADE_SETUP_FOOTPRINT_INL_H
#endif

#include "shade/setup/shading_setup.h"

#include "math/transcendental-inl.h"

SIMD_BEGIN(scanout::shade::texture)

// Attributes of a triangle at a sample, and their change from it a pixel to the right and a pixel
// down.
template <int kCount, class D>
struct OnPlane {
    Float<D> value[kCount], right[kCount], down[kCount];
};

// Terms of a plane: 1 / w of the vertices; f of vertex 0, and the differences from it to the
// others; the change of N and D in 1/256 pixel.
template <int kCount, class Number>
struct PlaneTerms {
    Number inverse_w[3];
    Number f0[kCount], f[kCount][2];
    Number f_x[kCount], f_y[kCount], sum_x, sum_y;
};

// With D = sum(weight_i / w_i), which is linear on the screen, and N the same sum of f_i / w_i,
// f = N / D and df/dx = (dN/dx - f dD/dx) / D. In double: towards the horizon, and far from vertex
// 0, to which f is relative, the difference cancels by the ratio of distances. Number: a double,
// for one triangle; or lanes of doubles, for a triangle in each lane.
template <int kCount, class Number>
class PlaneOf {
public:
    SIMD_INLINE explicit PlaneOf(const PlaneTerms<kCount, Number>& terms) : of_(terms) {}
    // a, b: the change of the weights in 1/256 pixel to the right and down; 1 / w and f of the
    // vertices.
    SIMD_INLINE PlaneOf(const Number (&a)[3], const Number (&b)[3], const Number (&inverse_w)[3],
                        const Number (&f)[kCount][3]) {
        of_.sum_x = of_.sum_y = Number(0.0);
        SIMD_FOR (int n = 0; n < kCount; ++n) {
            of_.f0[n] = f[n][0];
            of_.f_x[n] = of_.f_y[n] = Number(0.0);
        }
        SIMD_FOR (int k = 0; k < 3; ++k) {
            of_.inverse_w[k] = inverse_w[k];
            const Number right = a[k] * inverse_w[k], down = b[k] * inverse_w[k];
            of_.sum_x = of_.sum_x + right;
            of_.sum_y = of_.sum_y + down;
            if (k == 0) continue; // f is relative to it
            SIMD_FOR (int n = 0; n < kCount; ++n) {
                of_.f[n][k - 1] = f[n][k] - f[n][0];
                of_.f_x[n] = of_.f_x[n] + right * of_.f[n][k - 1];
                of_.f_y[n] = of_.f_y[n] + down * of_.f[n][k - 1];
            }
        }
    }
    SIMD_INLINE const PlaneTerms<kCount, Number>& terms() const { return of_; }

    // weight: at the sample. Slopes are clamped to +-2^60, which also stands for infinity and NaN.
    template <class D>
    SIMD_INLINE OnPlane<kCount, D> at(const Double<D> (&weight)[3]) const {
        using F64s = Double<D>;
        const auto perspective_weight = [&](int k) SIMD_LAMBDA {
            return maximum(weight[k], F64s(0.0)) * F64s(of_.inverse_w[k]); // as interpolated
        };
        const F64s p0 = perspective_weight(0), p1 = perspective_weight(1),
                   p2 = perspective_weight(2);
        const F64s inverse = F64s(1.0) / ((p0 + p1) + p2), pixel = F64s(256.0) * inverse;
        const auto slope = [&](Number n_slope, F64s f, Number d_slope) SIMD_LAMBDA {
            const Float<D> rounded = to_f32((F64s(n_slope) - f * F64s(d_slope)) * pixel);
            return minimum(maximum(rounded, Float<D>(-0x1p60F)), Float<D>(0x1p60F));
        };
        OnPlane<kCount, D> found;
        SIMD_FOR (int n = 0; n < kCount; ++n) {
            const F64s f = (p1 * F64s(of_.f[n][0]) + p2 * F64s(of_.f[n][1])) * inverse;
            found.value[n] = to_f32(F64s(of_.f0[n]) + f);
            found.right[n] = slope(of_.f_x[n], f, of_.sum_x);
            found.down[n] = slope(of_.f_y[n], f, of_.sum_y);
        }
        return found;
    }

private:
    PlaneTerms<kCount, Number> of_;
};

// The plane of a primitive.
template <int kCount>
class PrimitivePlane {
public:
    // f: of the vertices.
    SIMD_INLINE PrimitivePlane(const Primitive& t, const float (&f)[kCount][3])
        : t_(t), plane_(plane_of(t, f)) {}

    // x, y: of the sample, 1/256 pixel.
    template <class D>
    SIMD_INLINE OnPlane<kCount, D> at(Int<D> x, Int<D> y) const {
        using F64s = Double<D>;
        const F64s px = to_f64(x), py = to_f64(y);
        F64s weight[3];
        SIMD_FOR (int k = 0; k < 3; ++k)
            weight[k] = (F64s(t_.a[k]) * px + F64s(t_.b[k]) * py) + F64s(t_.c[k]);
        return plane_.at(weight);
    }

private:
    static SIMD_INLINE PlaneOf<kCount, double> plane_of(const Primitive& t,
                                                        const float (&f)[kCount][3]) {
        double inverse_w[3], wide[kCount][3];
        for (int k = 0; k < 3; ++k) {
            inverse_w[k] = double{t.inverse_w[k]};
            for (int n = 0; n < kCount; ++n)
                wide[n][k] = double{f[n][k]};
        }
        return {t.a, t.b, inverse_w, wide};
    }

    const Primitive& t_;
    PlaneOf<kCount, double> plane_;
};

// The derivatives of u and v: a pixel to the right, and a pixel down.
template <class D>
struct UvSlopes {
    Float<D> u_x, v_x, u_y, v_y;
};

// For lanes with triangles of their own, whose set-up has computed the slopes.
SIMD_INLINE void copy_slopes(ShadingBlock& b, const Run& run) {
    const auto& slope = b.triangles->slope;
    for (int i = run.first; i < run.first + run.count; i += kLanesX8) {
        store(load<F32x8>(slope[0] + i), b.u_x + i);
        store(load<F32x8>(slope[1] + i), b.v_x + i);
        store(load<F32x8>(slope[2] + i), b.u_y + i);
        store(load<F32x8>(slope[3] + i), b.v_y + i);
    }
}

// Writes the slopes of every lane of a block; an interpolation stage calls it if the frame needs
// them.
SIMD_INLINE void write_slopes(ShadingBlock& b) {
    for (const Run* run = b.run; run != b.run + b.runs; ++run) {
        if (run->primitive == nullptr) {
            copy_slopes(b, *run);
            continue;
        }
        const PrimitivePlane<2> plane(*run->primitive, run->primitive->uv);
        for (int i = run->first; i < run->first + run->count; i += kLanesX8) {
            const auto at = plane.at(load<I32x8>(b.x + i), load<I32x8>(b.y + i));
            store(at.right[0], b.u_x + i);
            store(at.right[1], b.v_x + i);
            store(at.down[0], b.u_y + i);
            store(at.down[1], b.v_y + i);
        }
    }
}

// Level 0: one texel a pixel; slopes in texels. Clamped to +-32; +32 also stands for infinite and
// NaN footprints, -32 for none.
template <class D>
SIMD_INLINE Float<D> level_of_detail(const UvSlopes<D>& texels) {
    using F = Float<D>;
    const auto length_squared = [](F u, F v) SIMD_LAMBDA {
        return minimum(u * u + v * v, F(0x1p64F)); // NaN too
    };
    const F longest = maximum(
        maximum(length_squared(texels.u_x, texels.v_x), length_squared(texels.u_y, texels.v_y)),
        F(0x1p-64F));
    return F(0.5F) * log2(longest);
}

SIMD_END

#endif
