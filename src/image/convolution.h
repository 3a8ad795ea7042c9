// Operations on a finished picture: convolutions, the filters of [Primer 6]. In linear light,
// weighted by alpha, the edge repeated.
#pragma once

#include "base/technique.h"
#include "image/image.h"
#include "image/plane.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace scanout::image {

struct Convolution {
    Technique card;
    // In place; the planes are scratch, as many as it needs.
    void (*run)(Image& picture, std::vector<Plane>& planes);
    int planes; // number of planes that it uses

    std::uint64_t bytes(int width, int height) const {
        return static_cast<std::uint64_t>(planes) * sizeof(double) *
               static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    }
};

// low_pass blurs by the binomial weights 1 4 6 4 1 / 16 on each axis; high_pass leaves the rest.
// Both add up to the plane; for a constant plane the first is that constant, the second 0, to the
// bit. In place; the other planes are scratch.
void low_pass(Plane& plane, Plane& between);
void high_pass(Plane& plane, Plane& low, Plane& between);

} // namespace scanout::image
