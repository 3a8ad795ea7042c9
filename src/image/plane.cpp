#include "image/plane.h"

#include "base/check.h"

#include <algorithm>

namespace scanout::image {

// Sums differences from the middle value: for a constant plane they are 0, and only the gain acts.
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

static void convolve_rows(const Plane& plane, const Side& side, Plane& out) {
    CHECK(side.weight.size() % 2 == 1);
    const int radius = static_cast<int>(side.weight.size() / 2);
    out.resize(plane.width, plane.height);
    for (int y = 0; y < plane.height; ++y) {
        for (int x = 0; x < plane.width; ++x) {
            const double middle = plane.at(x, y);
            double sum = 0;
            if (x >= radius && x + radius < plane.width) {
                const double* from = &plane.at(x - radius, y);
                for (const double weight : side.weight)
                    sum += weight * (*from++ - middle);
            } else {
                int from = x - radius;
                for (const double weight : side.weight)
                    sum += weight * (plane.at(std::clamp(from++, 0, plane.width - 1), y) - middle);
            }
            out.at(x, y) = middle * side.gain + sum;
        }
    }
}

static void convolve_columns(const Plane& plane, const Side& side, Plane& out) {
    CHECK(side.weight.size() % 2 == 1);
    const int radius = static_cast<int>(side.weight.size() / 2);
    out.resize(plane.width, plane.height);
    for (int y = 0; y < plane.height; ++y) { // row by row: the cache sees whole lines
        for (int x = 0; x < plane.width; ++x)
            out.at(x, y) = 0;
        std::size_t i = 0;
        for (int dy = -radius; dy <= radius; ++dy) {
            const int from = std::clamp(y + dy, 0, plane.height - 1);
            const double weight = side.weight[i++];
            for (int x = 0; x < plane.width; ++x)
                out.at(x, y) += weight * (plane.at(x, from) - plane.at(x, y));
        }
        for (int x = 0; x < plane.width; ++x)
            out.at(x, y) = plane.at(x, y) * side.gain + out.at(x, y);
    }
}

Plane convolve(const Plane& plane, const Side& across, const Side& down) {
    Plane between, out;
    convolve_rows(plane, across, between);
    convolve_columns(between, down, out);
    return out;
}

void convolve(Plane& plane, const Side& across, const Side& down, Plane& between) {
    convolve_rows(plane, across, between);
    convolve_columns(between, down, plane);
}

} // namespace scanout::image
