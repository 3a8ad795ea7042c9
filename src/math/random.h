// Random numbers that are the same on every machine: SplitMix64 (Steele, Lea and Flood 2014), which
// std's engines may be and its distributions are not.
#pragma once

#include <cstdint>

namespace scanout {

class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15U;
        z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31U);
    }
    // In [0, 1), of 53 bits.
    double unit() { return static_cast<double>(next() >> 11U) * 0x1p-53; }
    // In [0, count); off from even by less than count / 2^32.
    std::uint32_t below(std::uint32_t count) {
        return static_cast<std::uint32_t>(((next() >> 32U) * count) >> 32U);
    }

private:
    std::uint64_t state_;
};

} // namespace scanout
