// splitmix64 (Steele, Lea and Flood 2014): the same numbers on every machine, as the distributions
// of the standard library are not.
#pragma once

#include "math/vec.h"

#include <cstdint>

namespace scanout::test {

class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double in(double low, double high) { return low + (high - low) * unit(); }
    // low and high included
    int whole(int low, int high) {
        return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
    }
    DVec3 in_cube(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }

private:
    std::uint64_t state_;
};

} // namespace scanout::test
