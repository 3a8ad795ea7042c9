// Sutherland and Hodgman 1974 [Primer 1.4.5]: a polygon against each side of a convex window in
// turn.
#include "textbook/clip.h"

namespace scanout::textbook {
namespace {

// Places and depths are linear on the screen, values are not: value/w and 1/w are.
Corner mix(const Corner& a, const Corner& b, double t) {
    const auto linear = [t](double from, double to) { return from + (to - from) * t; };
    Corner out{
        linear(a.x, b.x), linear(a.y, b.y), linear(a.z, b.z), 1 / linear(1 / a.w, 1 / b.w), {}};
    for (std::size_t i = 0; i < kValues; ++i)
        out.values[i] = linear(a.values[i] / a.w, b.values[i] / b.w) * out.w;
    return out;
}

} // namespace

std::vector<Corner> clip_sutherland_hodgman(std::vector<Corner> polygon,
                                            const std::vector<DVec2>& window) {
    for (std::size_t side = 0; side < window.size(); ++side) {
        const DVec2 &from = window[side], &to = window[(side + 1) % window.size()];
        const auto distance = [&](const Corner& c) {
            return twice_area(from, to, DVec2(c.x, c.y));
        };
        std::vector<Corner> out;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            const double at_a = distance(a), at_b = distance(b);
            if (at_a >= 0) out.push_back(a);
            if ((at_a >= 0) != (at_b >= 0)) out.push_back(mix(a, b, at_a / (at_a - at_b)));
        }
        polygon = std::move(out);
    }
    return polygon;
}

} // namespace scanout::textbook
