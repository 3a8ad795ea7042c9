// Triangles to pixels, as the documents have them: a method each. A pixel is the point with whole
// coordinates (x, y); who has pixel centres at half-integers moves the corners by half a pixel.
#pragma once

#include "math/vec.h"
#include "textbook/methods.h"

#include <functional>

namespace scanout::textbook {

using Points = std::array<DVec2, 3>;                     // x right, y down
using Span = std::function<void(int y, int x0, int x1)>; // pixels x0 <= x < x1 of a line
using FillMethod = void (*)(const Points& p, const Span& span);

#define TEXTBOOK_DECLARE(name, blurb) void fill_##name(const Points& p, const Span& span);
TEXTBOOK_FILL(TEXTBOOK_DECLARE)
#undef TEXTBOOK_DECLARE
FillMethod fill_method(Fill fill);

// The runs of the pixels x0 <= x < x1 that are in: of(from, end) for each. Asks is_in(x) once a
// pixel, from left to right.
template <class IsIn, class Of>
void for_each_run(int x0, int x1, IsIn is_in, Of of) {
    int from = x0;
    for (int x = x0; x <= x1; ++x) {
        if (x < x1 && is_in(x)) continue;
        if (from < x) of(from, x);
        from = x + 1;
    }
}

// [Compendium 2.2] as it is written first: without the clamp of both ends of a line.
void fill_flat_halves_unclamped(const Points& p, const Span& span);

// Twice the area of a, b, c: above 0 where they run clockwise on the screen.
inline double twice_area(const DVec2& a, const DVec2& b, const DVec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// On the inner side of all three edges; of the points on an edge those of a top or left one.
bool covers(const Points& p, double x, double y);

} // namespace scanout::textbook
