#include "raster/count/stencil_count.h"

#include "raster/coverage/coverage.h"

#include <algorithm>

#define SIMD_FILE "raster/count/stencil_count.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::raster)

template <bool kBehind>
SIMD_INLINE void add_rows(const StencilSetup& t, SampleOffset offset, const float* depth,
                          const std::uint32_t* id, float* count) {
    const F64x8 none = 0.0, weight = static_cast<double>(t.weight), one = 1.0;
    for (int y = t.y0; y < t.y1; ++y) {
        const double py = y * 256 + offset.y;
        for (int x = t.x0; x < t.x1; x += kLanesX8) {
            const F64x8 px = to_f64(shift_left<8>(iota<I32x8>(x)) + I32x8(offset.x));
            const auto edge = [&](int k) SIMD_LAMBDA {
                return F64x8(t.a[k]) * px + F64x8(t.b[k] * py + t.c[k]);
            };
            const F64x8 e0 = edge(0), e1 = edge(1), e2 = edge(2);
            const auto inside =
                (e0 >= F64x8(t.least[0])) & (e1 >= F64x8(t.least[1])) & (e2 >= F64x8(t.least[2]));
            const int at = (y - t.top) * kTileSize + (x - t.left);
            F32x8 counted = to_f32(select(inside, weight, none));
            if (kBehind) {
                const F64x8 here = (e0 * F64x8(t.depth_factor[0]) + e1 * F64x8(t.depth_factor[1])) +
                                   e2 * F64x8(t.depth_factor[2]);
                const F64x8 seen = to_f64(load<F32x8>(depth + at)) * F64x8(1 + kSameDepth);
                const F32x8 behind = to_f32(select(here <= seen, one, none));
                const auto own = load<I32x8>(id + at) == I32x8(t.id);
                counted = counted * select(own, F32x8(1.0F), behind);
            }
            store(load<F32x8>(count + at) + counted, count + at);
        }
    }
}

void add_covered(const StencilSetup& t, SampleOffset offset, const float* depth,
                 const std::uint32_t* id, float* count, bool behind) {
    if (behind)
        add_rows<true>(t, offset, depth, id, count);
    else
        add_rows<false>(t, offset, depth, id, count);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(add_covered);

void add_to_stencil(const StencilPlanes& tile, const StencilTriangle& counted, StencilWhere where) {
    const Triangle& t = counted.triangle;
    const image::Rect reach = pixel_bounds(t, tile.area.x1, tile.area.y1, extent_of(tile.pattern));
    const image::Rect& area = tile.area;
    StencilSetup s{};
    s.x0 = area.x0 + std::max(reach.x0 - area.x0, 0) / 8 * 8;
    s.y0 = std::max(reach.y0, area.y0);
    s.x1 = reach.x1;
    s.y1 = reach.y1;
    if (s.x0 >= s.x1 || s.y0 >= s.y1) return;
    s.left = area.x0;
    s.top = area.y0;
    s.weight = counted.weight;
    s.id = static_cast<std::int32_t>(t.id);
    const Edges edges = edges_of(t);
    for (std::size_t k = 0; k < 3; ++k) {
        s.a[k] = static_cast<double>(edges.a[k]);
        s.b[k] = static_cast<double>(edges.b[k]);
        s.c[k] = static_cast<double>(edges.c[k]);
        s.least[k] = static_cast<double>(-edges.bias[k]);
        s.depth_factor[k] = t.depth[k] / static_cast<double>(edges.area);
    }
    for (std::size_t i = 0; i < tile.pattern.size(); ++i) {
        const std::size_t plane = i * kTileSize * kTileSize;
        SIMD_CALL(add_covered, s, tile.pattern[i], tile.depth + plane, tile.id + plane,
                  tile.count + plane, where == StencilWhere::behind);
    }
}

float stencil_at(const StencilTriangle& counted, std::int32_t x, std::int32_t y, double depth,
                 std::uint32_t id, StencilWhere where) {
    const Triangle& t = counted.triangle;
    if (std::max({t.x[0], t.x[1], t.x[2]}) < x || std::min({t.x[0], t.x[1], t.x[2]}) > x ||
        t.y[0] > y || std::max(t.y[1], t.y[2]) < y)
        return 0;
    const Edges edges = edges_of(t);
    double here = 0;
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const std::int64_t e = edges.at(k, x, y);
        if (e + edges.bias[i] < 0) return 0;
        here += static_cast<double>(e) * (t.depth[i] / static_cast<double>(edges.area));
    }
    const bool counts =
        where == StencilWhere::everywhere || t.id == id || here <= depth * (1 + kSameDepth);
    return counts ? counted.weight : 0;
}

} // namespace scanout::raster
#endif
