// y = k x + b [Primer 4.1.1]: one multiplication a pixel. As the document has it, from x0 to x1: a
// line that runs to the left draws nothing, a steep one has gaps, a vertical one has no k.
#include "textbook/line/line.h"

#include <cmath>

namespace scanout::textbook {

void line_kx_b(Pixel a, Pixel b, const Plot& plot) {
    const double x0 = a.x, y0 = a.y, x1 = b.x, y1 = b.y;
    const double k = (y1 - y0) / (x1 - x0), offset = (x1 * y0 - x0 * y1) / (x1 - x0);
    for (int x = a.x; x <= b.x; ++x) {
        const double y = k * x + offset;
        if (std::isfinite(y)) plot(x, static_cast<int>(std::floor(y + 0.5)), 1);
    }
}

} // namespace scanout::textbook
