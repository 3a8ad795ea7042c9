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

} // namespace scanout::trace
