// Bresenham 1965 [Primer 4.1.4]: the error of both axes in one integer; every direction alike.
#include "textbook/line/line.h"

#include <cstdlib>

namespace scanout::textbook {

void line_bresenham(Pixel a, Pixel b, const Plot& plot) {
    const int dx = std::abs(b.x - a.x), dy = -std::abs(b.y - a.y);
    const int right = a.x < b.x ? 1 : -1, down = a.y < b.y ? 1 : -1;
    int error = dx + dy;
    for (;;) {
        plot(a.x, a.y, 1);
        if (a == b) return;
        const int twice = 2 * error;
        if (twice >= dy) {
            error += dy;
            a.x += right;
        }
        if (twice <= dx) {
            error += dx;
            a.y += down;
        }
    }
}

} // namespace scanout::textbook
