// Stratified points: Sobol's sequence in four dimensions, so that every 2^m points in a row are
// spread evenly over the pixel and over a light; further pairs of dimensions are the last two in
// another order. Scrambled by a seed, after Owen 1995, by the hash of Burley 2020.
#pragma once

#include "math/vec.h"

#include <cstdint>

namespace scanout::trace {

// Point `index` in [0, 1)^2 of the pair of dimensions `pair`: 0 for the place in the pixel, from 1
// on for lights.
DVec2 stratified(std::uint32_t index, int pair, std::uint32_t seed);

std::uint32_t seed_of_pixel(int x, int y);

} // namespace scanout::trace
