// The midpoint line [Primer 4.1.3]: the sign of F(x, y) = A x + B y + C at the point half way
// between the two pixels that may come next chooses one. d0 = A + B/2, times two: all integers.
#include "textbook/line/line.h"

#include <cstdlib>
#include <utility>

namespace scanout::textbook {

void line_midpoint(Pixel a, Pixel b, const Plot& plot) {
    const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x); // then y counts the steps
    if (steep) {
        std::swap(a.x, a.y);
        std::swap(b.x, b.y);
    }
    if (a.x > b.x) std::swap(a, b);
    const int up = b.y < a.y ? -1 : 1;
    const int A = -std::abs(b.y - a.y), B = b.x - a.x; // of the line that rises
    int d = 2 * A + B;
    for (int x = a.x, y = a.y; x <= b.x; ++x) {
        steep ? plot(y, x, 1) : plot(x, y, 1);
        if (d < 0) {
            y += up;
            d += 2 * (A + B);
        } else {
            d += 2 * A;
        }
    }
}

} // namespace scanout::textbook
