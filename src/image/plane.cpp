#include "image/plane.h"

#include "base/check.h"

#include <algorithm>

namespace scanout::image {

// Sums run over differences from the middle: of a constant they are exactly 0, and gain is left.
Plane convolve(const Plane& plane, const Kernel& k) {
    CHECK(k.width % 2 == 1 && k.height % 2 == 1);
    Plane out(plane.width, plane.height);
    for (int y = 0; y < plane.height; ++y)
        for (int x = 0; x < plane.width; ++x) {
            const double middle = plane.at(x, y);
            double sum = 0;
            std::size_t i = 0;
            for (int dy = -(k.height / 2); dy <= k.height / 2; ++dy)
                for (int dx = -(k.width / 2); dx <= k.width / 2; ++dx)
                    sum += k.weight[i++] * (plane.at(std::clamp(x + dx, 0, plane.width - 1),
                                                     std::clamp(y + dy, 0, plane.height - 1)) -
                                            middle);
            out.at(x, y) = middle * k.gain + sum;
        }
    return out;
}

static Plane convolve_rows(const Plane& plane, const Side& side) {
    CHECK(side.weight.size() % 2 == 1);
    const int radius = static_cast<int>(side.weight.size() / 2);
    Plane out(plane.width, plane.height);
    std::vector<double> padded(static_cast<std::size_t>(plane.width) + side.weight.size() - 1);
    for (int y = 0; y < plane.height; ++y) {
        for (std::size_t i = 0; i < padded.size(); ++i)
            padded[i] = plane.at(std::clamp(static_cast<int>(i) - radius, 0, plane.width - 1), y);
        for (int x = 0; x < plane.width; ++x) {
            const double middle = plane.at(x, y);
            const double* from = padded.data() + x;
            double sum = 0;
            for (const double weight : side.weight)
                sum += weight * (*from++ - middle);
            out.at(x, y) = middle * side.gain + sum;
        }
    }
    return out;
}

static Plane convolve_columns(const Plane& plane, const Side& side) {
    CHECK(side.weight.size() % 2 == 1);
    const int radius = static_cast<int>(side.weight.size() / 2);
    Plane out(plane.width, plane.height);
    for (int y = 0; y < plane.height; ++y) {
        for (int x = 0; x < plane.width; ++x) // row by row: the cache sees whole lines
            out.at(x, y) = plane.at(x, y) * side.gain;
        std::size_t i = 0;
        std::vector<double> sum(static_cast<std::size_t>(plane.width), 0.0);
        for (int dy = -radius; dy <= radius; ++dy) {
            const int from = std::clamp(y + dy, 0, plane.height - 1);
            const double weight = side.weight[i++];
            for (int x = 0; x < plane.width; ++x)
                sum[static_cast<std::size_t>(x)] += weight * (plane.at(x, from) - plane.at(x, y));
        }
        for (int x = 0; x < plane.width; ++x)
            out.at(x, y) += sum[static_cast<std::size_t>(x)];
    }
    return out;
}

Plane convolve(const Plane& plane, const Side& across, const Side& down) {
    return convolve_columns(convolve_rows(plane, across), down);
}

} // namespace scanout::image
