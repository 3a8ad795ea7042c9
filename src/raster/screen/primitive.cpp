#include "raster/screen/primitive.h"

#include <algorithm>
#include <utility>

namespace scanout::raster {

std::int64_t signed_area(const std::array<std::int32_t, 3>& x,
                         const std::array<std::int32_t, 3>& y) {
    return std::int64_t{x[1] - x[0]} * (y[2] - y[0]) - std::int64_t{y[1] - y[0]} * (x[2] - x[0]);
}

CanonicalOrder canonical_order(const std::array<std::int32_t, 3>& x,
                               const std::array<std::int32_t, 3>& y) {
    CanonicalOrder order{{0, 1, 2}, false};
    const auto sort2 = [&](std::size_t i, std::size_t j) {
        std::uint8_t& a = order.vertex[i];
        std::uint8_t& b = order.vertex[j];
        if (std::pair(y[b], x[b]) < std::pair(y[a], x[a])) {
            std::swap(a, b);
            order.odd = !order.odd;
        }
    };
    sort2(0, 1);
    sort2(1, 2);
    sort2(0, 1);
    return order;
}

Edges edges_of(const Triangle& t) {
    Edges e{};
    const std::int64_t sign = t.flipped ? -1 : 1;
#pragma GCC unroll 3
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t from = (i + 1) % 3, to = (i + 2) % 3;
        e.a[i] = sign * (t.y[from] - t.y[to]);
        e.b[i] = sign * (t.x[to] - t.x[from]);
        e.c[i] = -(e.a[i] * t.x[from] + e.b[i] * t.y[from]);
        // y runs down: a left edge has its interior towards +x, a top edge towards +y.
        const bool top_left = e.a[i] > 0 || (e.a[i] == 0 && e.b[i] > 0);
        e.bias[i] = top_left ? 0 : -1;
    }
    e.area = sign * signed_area(t.x, t.y);
    return e;
}

namespace {

int floor_pixel(std::int32_t v) {
    return v >> kSubpixelBits;
}

image::Rect clamped(int x0, int y0, int x1, int y1, int width, int height) {
    return {std::max(x0, 0), std::max(y0, 0), std::min(x1, width), std::min(y1, height)};
}

} // namespace

std::optional<SetUp> set_up(const std::array<ScreenVertex, 3>& v, std::uint32_t id) {
    const std::array<std::int32_t, 3> x = {v[0].x, v[1].x, v[2].x}, y = {v[0].y, v[1].y, v[2].y};
    const std::int64_t area = signed_area(x, y);
    if (area == 0) return std::nullopt;
    const CanonicalOrder order = canonical_order(x, y);
    Triangle t{};
#pragma GCC unroll 3
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t from = order.vertex[i];
        t.x[i] = x[from];
        t.y[i] = y[from];
        t.depth[i] = v[from].depth;
    }
    t.id = id;
    t.flipped = (area < 0) != order.odd;
    return SetUp{t, order, area > 0};
}

// The first and the last pixel whose samples, between low and high, may lie in [min, max].
image::Rect pixel_bounds(const Triangle& t, int width, int height, const SampleExtent& extent) {
    const auto [min_x, max_x] = std::minmax({t.x[0], t.x[1], t.x[2]});
    const auto first = [](std::int32_t min, std::int32_t high) {
        return floor_pixel(min - high + kSubpixel - 1);
    };
    const auto last = [](std::int32_t max, std::int32_t low) { return floor_pixel(max - low); };
    return clamped(first(min_x, extent.high.x), first(t.y[0], extent.high.y),
                   last(max_x, extent.low.x) + 1, last(t.y[2], extent.low.y) + 1, width, height);
}

image::Rect pixel_bounds(const Segment& s, int width, int height) {
    const auto [min_x, max_x] = std::minmax(s.x[0], s.x[1]);
    const auto [min_y, max_y] = std::minmax(s.y[0], s.y[1]);
    const std::int32_t wider = (s.width - 1) * (kSubpixel / 2);
    const std::int32_t x = is_along_x(s) ? 0 : wider, y = is_along_x(s) ? wider : 0;
    return clamped(floor_pixel(min_x - x), floor_pixel(min_y - y), floor_pixel(max_x + x) + 1,
                   floor_pixel(max_y + y) + 1, width, height);
}

// A square of n pixels about the point, drawn by the triangle rules, covers the pixels whose
// centres c satisfy x - n/2 <= c < x + n/2 (HARD-CASES R16).
image::Rect pixel_bounds(const Point& p, int width, int height) {
    const std::int32_t before = (p.size - 1) * (kSubpixel / 2) + 1;
    const int x = floor_pixel(p.x - before), y = floor_pixel(p.y - before);
    return clamped(x, y, x + p.size, y + p.size, width, height);
}

} // namespace scanout::raster
