// Midpoint subdivision [Primer 1.4.5], Newman and Sproull 1979: a line is halved until what is
// left is in, out, or too short to matter; only sums and halves.
#include "textbook/clip/outcode.h"

#include <cmath>

namespace scanout::textbook {
namespace {

constexpr double kShort = 1.0 / 1024; // pixels

bool is_short(const DVec2& a, const DVec2& b) {
    const DVec2 d = b - a;
    return d.x > -kShort && d.x < kShort && d.y > -kShort && d.y < kShort;
}

// The point of the line nearest to `a` that is in the box.
std::optional<DVec2> first_in_box(const DVec2& a, const DVec2& b, const Box& box) {
    const unsigned code_a = outcode(a, box), code_b = outcode(b, box);
    if (code_a == 0) return a;
    if ((code_a & code_b) != 0) return std::nullopt;
    if (is_short(a, b)) return code_b == 0 ? std::optional(b) : std::nullopt;
    const DVec2 middle = (a + b) * 0.5;
    if (const auto near_half = first_in_box(a, middle, box)) return near_half;
    return first_in_box(middle, b, box);
}

} // namespace

// An end that is no number, or infinite, has no middle: nothing is halved for ever.
std::optional<Segment> clip_midpoint_subdivision(const Segment& line, const Box& box) {
    for (const DVec2& end : {line.first, line.second})
        if (!std::isfinite(end.x) || !std::isfinite(end.y)) return std::nullopt;
    const auto a = first_in_box(line.first, line.second, box),
               b = first_in_box(line.second, line.first, box);
    if (!a || !b) return std::nullopt;
    return Segment{*a, *b};
}

} // namespace scanout::textbook
