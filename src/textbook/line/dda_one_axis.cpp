// The digital differential analyser along x alone [Compendium 2.1]: y grows by the slope at every
// column. Broken where abs(k) > 1: the next pixel lies more than one row away.
#include "textbook/line/line.h"

#include <cmath>
#include <utility>

namespace scanout::textbook {

void line_dda_one_axis(Pixel a, Pixel b, const Plot& plot) {
    if (a.x > b.x) std::swap(a, b);
    const double dy = static_cast<double>(b.y - a.y) / (b.x - a.x);
    double y = a.y;
    for (int x = a.x; x <= b.x; ++x) {
        plot(x, static_cast<int>(std::floor(y + 0.5)), 1);
        y += dy;
    }
}

} // namespace scanout::textbook
