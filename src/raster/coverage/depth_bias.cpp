#include "raster/coverage/depth_bias.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace scanout::raster {

double depth_step(float depth) {
    constexpr std::uint32_t kExponent = 0x7f800000, kMin = 0x00800000; // below: denormal
    const std::uint32_t exponent = std::bit_cast<std::uint32_t>(depth) & kExponent;
    return double{std::bit_cast<float>(std::max(exponent, kMin))} * 0x1p-23;
}

double depth_bias(const DepthBias& bias, float max_depth, double max_slope) {
    double moved = bias.constant * depth_step(max_depth);
    if (bias.slope_scale != 0) moved += bias.slope_scale * max_slope;
    if (bias.clamp > 0) return std::min(moved, bias.clamp);
    if (bias.clamp < 0) return std::max(moved, bias.clamp);
    return moved;
}

} // namespace scanout::raster
