// The functions of src/math/*-inl.h over arrays, on the target that is chosen.
#pragma once

#include <cstdint>
#include <vector>

namespace scanout::test {

using Floats = std::vector<float>;

Floats log2_lanes(const Floats& x);
Floats exp2_lanes(const Floats& x);
Floats pow_lanes(const Floats& x, const Floats& y);
Floats pow_of_share_lanes(const Floats& x, const Floats& y);
Floats atan2_lanes(const Floats& y, const Floats& x);
std::vector<std::int32_t> srgb_encode_lanes(const Floats& linear);
Floats srgb_decode_lanes(const std::vector<std::int32_t>& codes);

} // namespace scanout::test
