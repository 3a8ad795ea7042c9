// What a quick measurement spends.
#pragma once

#include <cstdint>

namespace scanout::app {

inline constexpr double kQuickSeconds = 10;         // of measuring, after the reference
inline constexpr std::uint32_t kQuickSamples = 128; // of the reference, a pixel, at most

} // namespace scanout::app
