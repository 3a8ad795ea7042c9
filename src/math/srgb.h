// sRGB (IEC 1999): linear light <-> 8-bit codes. Decode is the correctly rounded value of the
// formula; encode is the nearest code, exactly (Microsoft 2015, 3.2.3.8, allows 0.6 code). Both are
// table look-ups, and the compiler computes the tables with our pow; srgb-inl.h has them in lanes.
#pragma once

#include <bit>
#include <cstdint>

namespace scanout {

namespace detail {

// Every float in [2^-13, 1) belongs to a bucket, by its exponent and upper 7 fraction bits: so
// narrow that at most one code begins inside it.
inline constexpr float kSrgbLowest = 0x1p-13F;        // still code 0
inline constexpr float kSrgbHighest = 0x1.fffffep-1F; // already code 255
inline constexpr int kSrgbBucketShift = 16;
inline constexpr int kSrgbBuckets = 13 * 128;

struct SrgbTables {
    float decode[256];
    float linear[256];        // code / 255: of data that is no colour
    float first_of_code[256]; // the least float that has the code
    // Of each bucket, as kernels gather it: plus a float's place in the bucket, it is the float's
    // code times 2^kSrgbBucketShift, and a fraction.
    std::int32_t bucket[kSrgbBuckets];
};
extern const SrgbTables kSrgb;

} // namespace detail

// Linear light in [0, 1]; 0 -> 0 and 255 -> 1 exactly.
inline float srgb_decode(std::uint8_t code) {
    return detail::kSrgb.decode[code];
}

// The same for a display value between the codes, in [0, 1]: the formula in double.
double linear_light_of_srgb(double encoded);

// Clamps to [0, 1]; NaN gives 0; monotone.
inline std::uint8_t srgb_encode(float linear) {
    using namespace detail;
    float x = linear > kSrgbLowest ? linear : kSrgbLowest; // NaN is not greater
    x = x < kSrgbHighest ? x : kSrgbHighest;
    const std::uint32_t offset =
        std::bit_cast<std::uint32_t>(x) - std::bit_cast<std::uint32_t>(kSrgbLowest);
    const std::uint32_t place = offset & ((1U << kSrgbBucketShift) - 1);
    const auto bucket = static_cast<std::uint32_t>(kSrgb.bucket[offset >> kSrgbBucketShift]);
    return static_cast<std::uint8_t>((bucket + place) >> kSrgbBucketShift);
}

} // namespace scanout
