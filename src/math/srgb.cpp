#include "math/srgb.h"

#include "math/exp_log.h"

namespace scanout::detail {
namespace {

// The decoding formula; encoded is a code / 255.
constexpr double linear_light(double encoded) {
    if (encoded == 0) return 0;
    return encoded <= 0.04045 ? encoded / 12.92 : pow_positive((encoded + 0.055) / 1.055, 2.4);
}

constexpr float least_float_not_below(double x) {
    const auto nearest = static_cast<float>(x);
    if (nearest >= x) return nearest;
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) + 1);
}

constexpr SrgbTables make_tables() {
    SrgbTables tables = {};
    for (int code = 0; code < 256; ++code) {
        tables.linear[code] = static_cast<float>(code / 255.0);
        tables.decode[code] = static_cast<float>(linear_light(code / 255.0));
        tables.first_of_code[code] =
            code == 0 ? 0 : least_float_not_below(linear_light((code - 0.5) / 255.0));
    }
    constexpr std::uint32_t kWidth = std::uint32_t{1} << kSrgbBucketShift;
    std::uint32_t code = 0; // of the bucket's first float
    for (std::uint32_t bucket = 0; bucket < kSrgbBuckets; ++bucket) {
        const std::uint32_t first =
            std::bit_cast<std::uint32_t>(kSrgbLowest) + (bucket << kSrgbBucketShift);
        const auto next = [&] { // the place of the next code's first float
            return std::bit_cast<std::uint32_t>(tables.first_of_code[code + 1]) - first;
        };
        while (code < 255 && static_cast<std::int32_t>(next()) <= 0)
            ++code;
        const bool inside = code < 255 && next() < kWidth;
        tables.bucket[bucket] =
            static_cast<std::int32_t>(code * kWidth + (inside ? kWidth - next() : 0));
    }
    return tables;
}

} // namespace

constexpr SrgbTables kSrgb = make_tables();

} // namespace scanout::detail

namespace scanout {

double linear_light_of_srgb(double encoded) {
    return detail::linear_light(encoded);
}

} // namespace scanout
