// The digital differential analyser [Compendium 2.1], cured: the longer axis grows by one, the
// other by the slope, which is then at most one.
#include "textbook/line/line.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace scanout::textbook {

void line_dda(Pixel a, Pixel b, const Plot& plot) {
    const int steps = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
    const double dx = steps > 0 ? static_cast<double>(b.x - a.x) / steps : 0,
                 dy = steps > 0 ? static_cast<double>(b.y - a.y) / steps : 0;
    double x = a.x, y = a.y;
    for (int i = 0; i <= steps; ++i) {
        plot(static_cast<int>(std::floor(x + 0.5)), static_cast<int>(std::floor(y + 0.5)), 1);
        x += dx;
        y += dy;
    }
}

} // namespace scanout::textbook
