#include "textbook/interpolation/interpolation.h"

namespace scanout::textbook {

Values weighted(const Triangle& t, const Weights& weights) {
    Values out;
    for (std::size_t i = 0; i < kValues; ++i)
        out[i] = t.corner[0].values[i] * weights[0] + t.corner[1].values[i] * weights[1] +
                 t.corner[2].values[i] * weights[2];
    return out;
}

} // namespace scanout::textbook
