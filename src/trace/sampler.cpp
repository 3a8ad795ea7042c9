#include "trace/sampler.h"

#include <array>

namespace scanout::trace {
namespace {

constexpr int kBits = 32;
using Directions = std::array<std::uint32_t, kBits>;

// Joe and Kuo 2008: degree, coefficients and first numbers of a dimension's polynomial.
constexpr Directions directions(int degree, std::uint32_t coefficients,
                                std::array<std::uint32_t, 3> first) {
    Directions v{};
    for (int i = 0; i < degree; ++i)
        v[static_cast<std::size_t>(i)] = first[static_cast<std::size_t>(i)] << (31 - i);
    for (int i = degree; i < kBits; ++i) {
        const std::uint32_t before = v[static_cast<std::size_t>(i - degree)];
        std::uint32_t next = before ^ (before >> degree);
        for (int k = 1; k < degree; ++k)
            if ((coefficients >> (degree - 1 - k) & 1) != 0)
                next ^= v[static_cast<std::size_t>(i - k)];
        v[static_cast<std::size_t>(i)] = next;
    }
    return v;
}

constexpr Directions van_der_corput() {
    Directions v{};
    for (int i = 0; i < kBits; ++i)
        v[static_cast<std::size_t>(i)] = 0x80000000U >> i;
    return v;
}

constexpr std::array<Directions, 4> kDirections = {
    van_der_corput(), directions(1, 0, {1}), directions(2, 1, {1, 3}), directions(3, 1, {1, 3, 1})};

std::uint32_t sobol(std::uint32_t index, const Directions& v) {
    std::uint32_t x = 0;
    for (std::size_t bit = 0; index != 0; ++bit, index >>= 1)
        if ((index & 1) != 0) x ^= v[bit];
    return x;
}

std::uint32_t reversed(std::uint32_t x) {
    x = (x & 0x55555555) << 1 | (x >> 1 & 0x55555555);
    x = (x & 0x33333333) << 2 | (x >> 2 & 0x33333333);
    x = (x & 0x0f0f0f0f) << 4 | (x >> 4 & 0x0f0f0f0f);
    return __builtin_bswap32(x);
}

// Each bit is turned over or not by a hash of those above it. Burley 2020.
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
    x = reversed(x);
    x += seed;
    x ^= x * 0x6c50b47cU;
    x ^= x * 0xb82f1e52U;
    x ^= x * 0xc7afe638U;
    x ^= x * 0x8d22f6e6U;
    return reversed(x);
}

std::uint32_t mixed(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352dU;
    x ^= x >> 15;
    x *= 0x846ca68bU;
    return x ^ (x >> 16);
}

} // namespace

DVec2 stratified(std::uint32_t index, int pair, std::uint32_t seed) {
    const std::uint32_t own = mixed(seed + 0x9e3779b9U * static_cast<std::uint32_t>(pair));
    // The same blocks of 2^m points, in another order.
    if (pair > 1) index = scrambled(index, own);
    const std::size_t first = pair == 0 ? 0 : 2;
    const auto coordinate = [&](std::size_t dimension) {
        const std::uint32_t hash = mixed(own + static_cast<std::uint32_t>(dimension) + 1);
        return scrambled(sobol(index, kDirections[dimension]), hash) * 0x1p-32;
    };
    return {coordinate(first), coordinate(first + 1)};
}

std::uint32_t seed_of_pixel(int x, int y) {
    return mixed(static_cast<std::uint32_t>(x) + mixed(static_cast<std::uint32_t>(y) + 1));
}

} // namespace scanout::trace
