#include "geom/framing.h"

#include "base/chunks.h"
#include "math/transcendental.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace scanout::geom {

static constexpr double kMax = std::numeric_limits<double>::max();

bool is_finite(const DVec3& v) {
    return std::abs(v.x) <= kMax && std::abs(v.y) <= kMax && std::abs(v.z) <= kMax;
}

// 2^exponent for a normal result: exponent in [-1022, 1023].
static double power_of_two(int exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

// The e with 2^(e-1) <= x < 2^e, for finite x > 0, denormals included.
static int binary_exponent(double x) {
    int shift = 0;
    if (x < power_of_two(-1022)) {
        x *= power_of_two(60);
        shift = 60;
    }
    return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52) - 1022 - shift;
}

// In two steps, since 2^exponent alone may not be a double: exact unless the result is denormal.
static double scale_by_power(double x, int exponent) {
    const int half = exponent / 2;
    return x * power_of_two(half) * power_of_two(exponent - half);
}

static DVec3 scale_by_power(const DVec3& v, int exponent) {
    return {scale_by_power(v.x, exponent), scale_by_power(v.y, exponent),
            scale_by_power(v.z, exponent)};
}

// min + max is the same for a model and its exact translation, so it is preferred while it is
// finite.
static double middle(double min, double max) {
    const double sum = min + max;
    return std::abs(sum) <= kMax ? sum * 0.5 : min * 0.5 + max * 0.5;
}

DVec3 Framing::normalise(const DVec3& file_units) const {
    return scale_by_power(file_units - centre, -exponent);
}

namespace {

constexpr std::size_t kFramingChunk = 16384;

// Calls visit(position, result of the block) for the positions that count, block by block.
template <class T, class Visit>
std::vector<T> by_chunks(Jobs& jobs, const std::vector<DVec3>& positions,
                         const std::vector<std::uint8_t>& used, const T& empty, Visit&& visit) {
    const bool some =
        std::find_if(used.begin(), used.end(), [](std::uint8_t u) { return u != 0; }) != used.end();
    std::vector<T> results((positions.size() + kFramingChunk - 1) / kFramingChunk, empty);
    for_chunks(jobs, positions.size(), kFramingChunk, [&](std::size_t begin, std::size_t end, int) {
        T result = empty;
        for (std::size_t i = begin; i < end; ++i)
            if ((!some || used[i] != 0) && is_finite(positions[i])) visit(positions[i], result);
        results[begin / kFramingChunk] = result;
    });
    return results;
}

struct Extent {
    DVec3 lo{kMax}, hi{-kMax};
    void include(const DVec3& low, const DVec3& high) {
        lo = {std::min(lo.x, low.x), std::min(lo.y, low.y), std::min(lo.z, low.z)};
        hi = {std::max(hi.x, high.x), std::max(hi.y, high.y), std::max(hi.z, high.z)};
    }
};

Extent extent_of(Jobs& jobs, const std::vector<DVec3>& positions,
                 const std::vector<std::uint8_t>& used) {
    Extent all;
    for (const Extent& part : by_chunks(jobs, positions, used, Extent(),
                                        [](const DVec3&p, Extent&e) { e.include(p, p); }))
        all.include(part.lo, part.hi);
    return all;
}

} // namespace

Framing framing_of(Jobs& jobs, const std::vector<DVec3>& positions,
                   const std::vector<std::uint8_t>& used) {
    const auto [lo, hi] = extent_of(jobs, positions, used);
    Framing framing;
    if (lo.x > hi.x) return framing;
    framing.box_min = lo + 0.0; // + 0.0: a box that starts at -0 starts at 0
    framing.box_max = hi + 0.0;
    framing.centre = {middle(lo.x, hi.x), middle(lo.y, hi.y), middle(lo.z, hi.z)};
    framing.centre += 0.0;

    const DVec3 reach = glm::max(hi - framing.centre, framing.centre - lo);
    const double largest = std::max({reach.x, reach.y, reach.z});
    if (largest == 0) return framing;
    framing.exponent = binary_exponent(largest); // every normalised coordinate is now in [-1, 1]
    double squared = 0;
    for (const double part :
         by_chunks(jobs, positions, used, 0.0, [&framing](const DVec3&at, double&most) {
             const DVec3 p = framing.normalise(at);
             most = std::max(most, dot3(p, p));
         }))
        squared = std::max(squared, part);
    framing.radius = sqrt(squared); // in [0.5, sqrt 3)
    if (framing.radius > 1) {
        ++framing.exponent;
        framing.radius *= 0.5;
    }
    return framing;
}

} // namespace scanout::geom
