// The filters of EXT_meshopt_compression, by the formulas of its text. The library's own use
// approximate square roots on some processors, and then the bits of a frame differ.
#include "io/gltf/meshopt.h"
#include "math/transcendental.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace scanout::io::gltf {
namespace {

template <class T>
T rounded(double x) {
    return static_cast<T>(x + (x >= 0 ? 0.5 : -0.5));
}

// Unit vectors folded onto an octahedron; the third component is the code of 1.
template <class T>
void unfold(std::uint8_t* element, double most) {
    T code[3];
    std::memcpy(code, element, sizeof code);
    const double one = code[2] == 0 ? 1 : double{static_cast<double>(code[2])};
    double x = static_cast<double>(code[0]) / one, y = static_cast<double>(code[1]) / one;
    const double z = 1 - std::abs(x) - std::abs(y), below = std::min(z, 0.0);
    x += x >= 0 ? below : -below;
    y += y >= 0 ? below : -below;
    const double scale = most / scanout::sqrt((x * x + y * y) + z * z);
    const auto coded = [&](double c) { return rounded<T>(std::clamp(c * scale, -most, most)); };
    code[0] = coded(x);
    code[1] = coded(y);
    code[2] = coded(z);
    std::memcpy(element, code, sizeof code);
}

// Quaternions without their greatest component, whose number stands in the last two bits.
void complete(std::uint8_t* element) {
    constexpr double kRange = 0.70710678118654752440;
    std::int16_t code[4];
    std::memcpy(code, element, sizeof code);
    const double one = code[3] | 3;
    double c[3], rest = 1;
    for (int i = 0; i < 3; ++i) {
        c[i] = code[i] / one * kRange;
        rest -= c[i] * c[i];
    }
    const int greatest = code[3] & 3;
    const auto coded = [](double x) {
        return rounded<std::int16_t>(std::clamp(x, -1.0, 1.0) * 32767);
    };
    for (int i = 0; i < 3; ++i)
        code[(greatest + i + 1) % 4] = coded(c[i]);
    code[greatest] = coded(scanout::sqrt(std::max(rest, 0.0)));
    std::memcpy(element, code, sizeof code);
}

// Floats of 24 bits of mantissa and 8 of exponent.
void expand(std::uint8_t* word) {
    std::int32_t code = 0;
    std::memcpy(&code, word, 4);
    const int exponent = std::clamp(code >> 24, -100, 100);
    const std::int32_t mantissa =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(code) << 8) >> 8;
    const auto power = std::bit_cast<float>(static_cast<std::uint32_t>(exponent + 127) << 23);
    const float value = static_cast<float>(mantissa) * power;
    std::memcpy(word, &value, 4);
}

} // namespace

void undo_meshopt_filter(const Meshopt& packed, Bytes& bytes) {
    const bool octahedral = packed.filter == "OCTAHEDRAL", small = packed.stride == 4;
    const bool quaternion = packed.filter == "QUATERNION", floats = packed.filter == "EXPONENTIAL";
    const std::size_t step = floats ? 4 : packed.stride;
    if (!octahedral && !quaternion && !floats) return;
    for (std::size_t at = 0; at + step <= bytes.size(); at += step) {
        std::uint8_t* const element = bytes.data() + at;
        if (octahedral && small) unfold<std::int8_t>(element, 127);
        if (octahedral && !small) unfold<std::int16_t>(element, 32767);
        if (quaternion) complete(element);
        if (floats) expand(element);
    }
}

} // namespace scanout::io::gltf
