// One channel of numbers and its convolution, for filters and metrics. The edge repeats outwards,
// so that a picture gets no dark frame.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace scanout::image {

struct Plane {
    int width = 0, height = 0;
    std::vector<double> value; // rows from the top

    Plane() = default;
    Plane(int w, int h)
        : width(w), height(h), value(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    // Sets the size; the values are undefined, and memory is reused.
    void resize(int w, int h) {
        width = w;
        height = h;
        value.resize(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
    }
    double& at(int x, int y) { return value[offset(x, y)]; }
    const double& at(int x, int y) const { return value[offset(x, y)]; }

private:
    std::size_t offset(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    }
};

// Weights around a pixel; sides are odd. Applied unmirrored (correlation).
struct Kernel {
    int width = 1, height = 1;
    std::vector<double> weight{1.0}; // rows from the top
    // The factor of a constant plane. Given separately, since the sum of the weights is rounded:
    // low-passes have exactly 1 and keep a constant, high-passes have 0 and make it exactly 0.
    double gain = 1;
};

Plane convolve(const Plane& plane, const Kernel& kernel);
// The same for weights(x, y) = across[x] down[y], in two passes; each side has its gain.
struct Side {
    std::span<const double> weight;
    double gain = 1;
};
Plane convolve(const Plane& plane, const Side& across, const Side& down);
// In place; `between` is scratch for the first pass's result.
void convolve(Plane& plane, const Side& across, const Side& down, Plane& between);

} // namespace scanout::image
