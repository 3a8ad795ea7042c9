// How many texels a pixel covers: the level of detail of a texture, log2(max(|d/dx|, |d/dy|)) in
// texels (D3D 11.3 functional specification 7.18.11; Heckbert 1989; HARD-CASES R24). The
// derivatives of u and v are those of the triangle's plane at the sample. There are no quads of
// pixels, so neither a triangle's edge nor its size changes anything (HARD-CASES 38, 39). For
// mipmaps, which no stage has yet: only tests use it.
#if defined(SCANOUT_SHADE_FOOTPRINT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_FOOTPRINT_INL_H
#undef SCANOUT_SHADE_FOOTPRINT_INL_H
#else
#define SCANOUT_SHADE_FOOTPRINT_INL_H
#endif

#include "shade/stage.h"

#include "math/transcendental-inl.h"

SIMD_BEGIN(scanout::shade::texture)

// With D = sum(weight_i / w_i), which is linear on the screen, and N the same sum of u_i / w_i,
// u = N / D and du/dx = (dN/dx - u dD/dx) / D. In double: towards the horizon, and far from vertex
// 0, to which u is relative, the difference cancels by the ratio of distances.
class Footprint {
public:
    // width, height: texels a unit of u and of v, all scales included.
    Footprint(const Primitive& t, double width, double height) : t_(t) {
        for (int k = 0; k < 3; ++k) {
            u_[k] = (double{t.uv[0][k]} - double{t.uv[0][0]}) * width;
            v_[k] = (double{t.uv[1][k]} - double{t.uv[1][0]}) * height;
            const double a = t.a[k] * 256 * double{t.inverse_w[k]}; // a pixel is 256 units
            const double b = t.b[k] * 256 * double{t.inverse_w[k]};
            sum_x_ += a;
            sum_y_ += b;
            u_x_ += a * u_[k];
            u_y_ += b * u_[k];
            v_x_ += a * v_[k];
            v_y_ += b * v_[k];
        }
    }

    // 0: one texel a pixel. x, y: of the sample, 1/256 pixel. Within +-32, which is also the level
    // of footprints without end, or not a number (+), and of none (-).
    template <class D>
    HWY_INLINE Float<D> level(Int<D> x, Int<D> y) const {
        using F64s = Double<D>;
        const F64s px = to_f64(x), py = to_f64(y);
        const auto share = [&](int k) HWY_ATTR {
            const F64s weight = (F64s(t_.a[k]) * px + F64s(t_.b[k]) * py) + F64s(t_.c[k]);
            return maximum(weight, F64s(0.0)) * F64s(double{t_.inverse_w[k]}); // as interpolated
        };
        const F64s p0 = share(0), p1 = share(1), p2 = share(2);
        const F64s inverse = F64s(1.0) / ((p0 + p1) + p2);
        const F64s u = (p1 * F64s(u_[1]) + p2 * F64s(u_[2])) * inverse;
        const F64s v = (p1 * F64s(v_[1]) + p2 * F64s(v_[2])) * inverse;
        const auto length_squared = [&](double du, double dv, double sum) HWY_ATTR {
            const F64s along_u = (F64s(du) - u * F64s(sum)) * inverse;
            const F64s along_v = (F64s(dv) - v * F64s(sum)) * inverse;
            return minimum(along_u * along_u + along_v * along_v, F64s(0x1p64)); // NaN too
        };
        const F64s longest =
            maximum(maximum(length_squared(u_x_, v_x_, sum_x_), length_squared(u_y_, v_y_, sum_y_)),
                    F64s(0x1p-64));
        return Float<D>(0.5F) * log2(to_f32(longest));
    }

private:
    const Primitive& t_;
    double u_[3], v_[3]; // of the vertices, in texels, from vertex 0
    double sum_x_ = 0, sum_y_ = 0, u_x_ = 0, u_y_ = 0, v_x_ = 0, v_y_ = 0; // of D and N, a pixel
};

SIMD_END

#endif
