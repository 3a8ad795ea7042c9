// Vertices in lanes, canonical order and the top-left rule, for all kernels. Included once for
// every SIMD target.
#if defined(SCANOUT_RASTER_COVERAGE_TRIANGLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_COVERAGE_TRIANGLE_INL_H
#undef SCANOUT_RASTER_COVERAGE_TRIANGLE_INL_H
#else
#define SCANOUT_RASTER_COVERAGE_TRIANGLE_INL_H
#endif

#include "raster/screen/screen.h"

#include "simd/quads-inl.h"

SIMD_BEGIN(scanout::raster)

// x, y and, as the last double, depth of a vertex a lane: of index[0], index[step] and so on.
template <class T>
SIMD_INLINE Quads128<typename T::Tag> vertices_at(const ScreenVertex* vertices,
                                                  const std::uint32_t* index, int step = 1) {
    const auto* words = reinterpret_cast<const std::int32_t*>(vertices);
    static_assert(sizeof(ScreenVertex) == 4 * sizeof *words);
    return load_four<typename T::Tag>(
        [&](int lane) SIMD_LAMBDA { return words + std::size_t{index[lane * step]} * 4; });
}

// x, y and the last word of vertices, depth; sixteen lanes load two registers of eight vertices.
template <class D>
struct ScreenLanes {
    Int<D> x, y;
    Double<D> last;
};
template <class D>
SIMD_INLINE ScreenLanes<D> screen_lanes(const ScreenVertex* vertices, const std::uint32_t* index) {
    if constexpr (Int<D>::kLanes <= 8) {
        const auto v = vertices_at<Float<D>>(vertices, index);
        return {v.word(0), v.word(1), v.last_double()};
    } else {
        const auto low = screen_lanes<F32x8::Tag>(vertices, index);
        const auto high = screen_lanes<F32x8::Tag>(vertices, index + kLanesX8);
        const auto both = [](auto a, auto b) SIMD_LAMBDA {
            return Int<D>(hn::Combine(typename Int<D>::Tag(), b.raw, a.raw));
        };
        const auto depths = [](auto a, auto b) SIMD_LAMBDA { return Double<D>(a.raw, b.raw); };
        return {both(low.x, high.x), both(low.y, high.y), depths(low.last, high.last)};
    }
}

// Exchanges the two where the mask holds.
template <class M, class T>
SIMD_INLINE void exchange(const M& mask, T& one, T& other) {
    const T first = select(mask, other, one);
    other = select(mask, one, other);
    one = first;
}

// The canonical order (raster/screen/primitive.h). V: a vertex in lanes, with sort_two(V&, V&),
// which puts the one with the lower y, then the lower x, first.
template <class V>
SIMD_INLINE void sort_canonically(V (&v)[3]) {
    sort_two(v[0], v[1]);
    sort_two(v[1], v[2]);
    sort_two(v[0], v[1]);
}

// Is the edge a x + b y + c, positive inside, a top or a left one? y runs down: a left edge has its
// interior towards +x, a top edge towards +y.
template <class N>
SIMD_INLINE auto is_top_left(const N& a, const N& b) {
    const N zero = 0;
    return (a > zero) | ((a == zero) & (b > zero));
}

SIMD_END

#endif
