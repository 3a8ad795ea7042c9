// Where the samples of a pixel lie: Direct3D's standard patterns, on the 1/16 pixel grid, so that
// coverage at every sample stays exact in 16.8 fixed point.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace scanout::raster {

// Offset from the pixel's top left corner in 1/256 pixel, x right, y down.
struct SampleOffset {
    std::int32_t x, y;
    friend bool operator==(const SampleOffset&, const SampleOffset&) = default;
};

namespace detail {
constexpr SampleOffset sixteenths(int x, int y) {
    return {(x + 8) * 16, (y + 8) * 16};
}
inline constexpr std::array<SampleOffset, 1> kOne = {sixteenths(0, 0)};
inline constexpr std::array<SampleOffset, 2> kTwo = {sixteenths(4, 4), sixteenths(-4, -4)};
inline constexpr std::array<SampleOffset, 4> kFour = {sixteenths(-2, -6), sixteenths(6, -2),
                                                      sixteenths(-6, 2), sixteenths(2, 6)};
inline constexpr std::array<SampleOffset, 8> kEight = {
    sixteenths(1, -3), sixteenths(-1, 3),  sixteenths(5, 1), sixteenths(-3, -5),
    sixteenths(-5, 5), sixteenths(-7, -1), sixteenths(3, 7), sixteenths(7, -7)};
inline constexpr std::array<SampleOffset, 16> kSixteen = {
    sixteenths(1, 1),   sixteenths(-1, -3), sixteenths(-3, 2),  sixteenths(4, -1),
    sixteenths(-5, -2), sixteenths(2, 5),   sixteenths(5, 3),   sixteenths(3, -5),
    sixteenths(-2, 6),  sixteenths(0, -7),  sixteenths(-4, -6), sixteenths(-6, 4),
    sixteenths(-8, 0),  sixteenths(7, -4),  sixteenths(6, 7),   sixteenths(-7, -8)};
} // namespace detail

inline constexpr SampleOffset kPixelCentre = detail::kOne[0];

// The box around a pattern's samples, both ends included; by default that of a whole pixel.
struct SampleExtent {
    SampleOffset low{0, 0}, high{255, 255};
    friend bool operator==(const SampleExtent&, const SampleExtent&) = default;
};
constexpr SampleExtent extent_of(std::span<const SampleOffset> pattern) {
    SampleExtent extent{{255, 255}, {0, 0}};
    for (const SampleOffset& s : pattern) {
        extent.low = {std::min(extent.low.x, s.x), std::min(extent.low.y, s.y)};
        extent.high = {std::max(extent.high.x, s.x), std::max(extent.high.y, s.y)};
    }
    return extent;
}

// samples: 1, 2, 4, 8 or 16; anything else gives an empty span.
constexpr std::span<const SampleOffset> sample_pattern(int samples) {
    switch (samples) {
    case 1:
        return detail::kOne;
    case 2:
        return detail::kTwo;
    case 4:
        return detail::kFour;
    case 8:
        return detail::kEight;
    case 16:
        return detail::kSixteen;
    default:
        return {};
    }
}

namespace detail {
template <std::size_t kCount>
constexpr std::array<SampleOffset, kCount + 1>
and_centre(const std::array<SampleOffset, kCount>& pattern) {
    std::array<SampleOffset, kCount + 1> all{};
    std::copy(pattern.begin(), pattern.end(), all.begin());
    all.back() = kPixelCentre;
    return all;
}
inline constexpr auto kTwoAndCentre = and_centre(kTwo);
inline constexpr auto kFourAndCentre = and_centre(kFour);
inline constexpr auto kEightAndCentre = and_centre(kEight);
inline constexpr auto kSixteenAndCentre = and_centre(kSixteen);
} // namespace detail

// The same places, and the pixel's centre.
constexpr std::span<const SampleOffset> pattern_and_centre(int samples) {
    switch (samples) {
    case 2:
        return detail::kTwoAndCentre;
    case 4:
        return detail::kFourAndCentre;
    case 8:
        return detail::kEightAndCentre;
    case 16:
        return detail::kSixteenAndCentre;
    default:
        return sample_pattern(samples);
    }
}

} // namespace scanout::raster
