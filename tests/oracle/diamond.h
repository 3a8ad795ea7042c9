// The oracle of lines: which diamonds |x| + |y| < 1/2 about the centres of pixels a segment goes
// through, in exact integers of 128 bits; and the diamond-exit rule itself (HARD-CASES R13, R14).
#pragma once

#include "oracle/coverage.h"

#include <array>
#include <cstdint>

namespace scanout::oracle {

struct FinePoint {
    Int128 x, y; // in kFine parts of 1/256 pixel
};
inline constexpr Int128 kFine = Int128{1} << 44;

inline FinePoint fine(const Corner& c) {
    return {c.x * kFine, c.y * kFine};
}

// Does the segment, ends included, meet the diamond about the pixel's centre? The diamond is open,
// or closed: with its border. |x| + |y| < 1/2 is a square in x + y and x - y. Exact within 16
// pixels.
inline bool meets_diamond(const FinePoint& a, const FinePoint& b, int pixel_x, int pixel_y,
                          bool closed) {
    const FinePoint centre = fine({pixel_x * 256 + 128, pixel_y * 256 + 128});
    const Int128 half = 128 * kFine;
    const auto sides = [&](const FinePoint& p) {
        const Int128 x = p.x - centre.x, y = p.y - centre.y;
        return std::array{half - x - y, half + x + y, half - x + y, half + x - y};
    };
    const auto from = sides(a), to = sides(b);
    struct Share { // of the way
        Int128 over = 0, under = 1;
        bool open = false;
    } first, last{1, 1};
    for (std::size_t i = 0; i < 4; ++i) { // from + share * (to - from) > 0
        const Int128 rise = to[i] - from[i];
        if (rise == 0) {
            if (from[i] < 0 || (from[i] == 0 && !closed)) return false;
            continue;
        }
        Share& bound = rise > 0 ? first : last;
        const Share zero =
            rise > 0 ? Share{-from[i], rise, !closed} : Share{from[i], -rise, !closed};
        const Int128 left = zero.over * bound.under, right = bound.over * zero.under;
        if (left == right)
            bound.open |= zero.open;
        else if ((left > right) == (rise > 0))
            bound = zero;
    }
    const Int128 low = first.over * last.under, high = last.over * first.under;
    return low < high || (low == high && !first.open && !last.open);
}

// The standard's rule: the line's pixels are those whose diamonds it leaves, after all of it has
// moved by an infinitely small step to the left and a still smaller one up.
inline bool exits_diamond(const Corner& from, const Corner& to, int pixel_x, int pixel_y) {
    const auto moved = [](const Corner& c) {
        const FinePoint at = fine(c);
        return FinePoint{at.x - (Int128{1} << 22), at.y - 1};
    };
    const FinePoint a = moved(from), b = moved(to);
    return meets_diamond(a, b, pixel_x, pixel_y, false) &&
           !meets_diamond(b, b, pixel_x, pixel_y, false);
}

} // namespace scanout::oracle
