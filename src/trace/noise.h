// How far a pixel of the reference is from the truth: estimated from the parts of its samples.
#pragma once

#include <array>
#include <cstddef>

namespace scanout::trace {

// Parts of a pixel's samples, in the order of the sequence: each is a stratified set by itself, and
// so are two, four, eight neighbours together, the better the more they are.
inline constexpr std::size_t kParts = 16;

// The standard error of the mean of all. residual: of each part, what its mean differs from that.
double standard_error(const std::array<double, kParts>& residual);

// What a pixel shows of how fast its samples converge: mean squares of what a part, and of what
// half of the samples, errs less the error of twice as many.
struct Scatter {
    double of_parts = 0, of_halves = 0;
};
Scatter scatter(const std::array<double, kParts>& residual);

// The square of the error of all samples, where the sums are those of many pixels. One pixel's own
// few differences hardly tell how fast it converges, and a guess must be on the safe side; those of
// a picture tell it well.
double square_of_error(const Scatter& sums);

} // namespace scanout::trace
