// w_i = 1 / d_i, divided by their sum [Primer 2.3.3.2]. "Naive": on the edge between two corners of
// a pointed triangle the third one may be the nearest, and outweighs both.
#include "math/transcendental.h"
#include "textbook/interpolation/interpolation.h"

namespace scanout::textbook {

Interpolator interpolate_inverse_distance(const Triangle& t) {
    return by_weights(t, [p = points_of(t)](int x, int y) {
        Weights w{};
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double dx = p[i].x - x, dy = p[i].y - y;
            if (dx == 0 && dy == 0) { // at the corner itself
                w = {};
                w[i] = 1;
                return w;
            }
            sum += w[i] = 1 / scanout::sqrt(dx * dx + dy * dy);
        }
        return Weights{w[0] / sum, w[1] / sum, w[2] / sum};
    });
}

} // namespace scanout::textbook
