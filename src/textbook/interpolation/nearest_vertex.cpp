// A pixel takes the value of the nearest of the three corners [Primer 2.3.3.1]: good enough where a
// triangle is a pixel wide.
#include "textbook/interpolation/interpolation.h"

#include <algorithm>

namespace scanout::textbook {

Interpolator interpolate_nearest_vertex(const Triangle& t) {
    return by_weights(t, [p = points_of(t)](int x, int y) {
        const auto square = [&](const DVec2& c) {
            return (c.x - x) * (c.x - x) + (c.y - y) * (c.y - y);
        };
        const std::array<double, 3> squares = {square(p[0]), square(p[1]), square(p[2])};
        Weights w{};
        w[static_cast<std::size_t>(std::min_element(squares.begin(), squares.end()) -
                                   squares.begin())] = 1;
        return w;
    });
}

} // namespace scanout::textbook
