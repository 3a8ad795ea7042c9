// The bits of every function at fixed points: frames are hashed and kept, so a change here changes
// them all. The hashes hold for g++ and clang++, x86-64 and Arm, any optimisation. When one must
// change, say in the commit which frames change with it.
#include "math/bits.h"
#include "math/lane_functions.h"
#include "math/predicates.h"
#include "math/rotation.h"
#include "math/srgb.h"
#include "math/transcendental.h"
#include "oracle.h"
#include "support/targets.h"

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

// FNV-1a over 64-bit words, with a shift: without it, two flipped signs would cancel.
class Hash {
public:
    void add(std::uint64_t word) {
        value_ = (value_ ^ word) * 0x100000001b3;
        value_ ^= value_ >> 32;
    }
    void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
    void add(float x) { add(std::uint64_t{std::bit_cast<std::uint32_t>(x)}); }
    void add(const DMat3& m) {
        for (int i = 0; i < 9; ++i)
            add(m[i / 3][i % 3]);
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325;
};

constexpr int kPoints = 20000;
constexpr double kOdd[] = {0.0,   -0.0,      1.0,        -1.0, 0x1p-1074,
                           1e308, kInfinity, -kInfinity, kNaN, -kNaN};

std::uint64_t hash_of(double (*f)(double), int low, int high) {
    Hash hash;
    Points points(9);
    for (int i = 0; i < kPoints; ++i)
        hash.add(f(points.any_size(low, high)));
    for (const double x : kOdd)
        hash.add(f(x));
    return hash.value();
}

std::uint64_t hash_of(double (*f)(double, double), int low, int high) {
    Hash hash;
    Points points(10);
    for (int i = 0; i < kPoints; ++i) {
        const double a = points.any_size(low, high);
        const double b = points.any_size(low, high);
        hash.add(f(a, b));
        const double c = points.unit();
        const double d = points.uniform(-100, 100);
        hash.add(f(c, d));
    }
    for (const double a : kOdd)
        for (const double b : kOdd)
            hash.add(f(a, b));
    return hash.value();
}

TEST(SameBits, DoubleFunctionsKeepTheirBits) {
    EXPECT_EQ(hash_of(sin, -40, 30), 10845751030204263670U);
    EXPECT_EQ(hash_of(cos, -40, 30), 16718306690740282762U);
    EXPECT_EQ(hash_of(tan, -40, 30), 7237399684956009978U);
    EXPECT_EQ(hash_of(sin_degrees, -40, 80), 3801229403952167352U);
    EXPECT_EQ(hash_of(cos_degrees, -40, 80), 8597980341989409947U);
    EXPECT_EQ(hash_of(atan2, -40, 40), 15344237821203294796U);
    EXPECT_EQ(hash_of(acos, -40, 0), 7331309592766786538U);
    EXPECT_EQ(hash_of(exp2, -40, 11), 144377163861909347U);
    EXPECT_EQ(hash_of(log2, -1074, 1023), 6595806547835927273U);
    EXPECT_EQ(hash_of(pow, -10, 10), 16723698737453581524U);
    EXPECT_EQ(hash_of(cbrt, -1074, 1023), 1730081878788279740U);
    EXPECT_EQ(hash_of(sqrt, -1074, 1023), 7602846163222430080U);
    EXPECT_EQ(hash_of(radians, -1074, 1023), 7614183049274473611U);
    EXPECT_EQ(hash_of(degrees, -1074, 1023), 2749391078687647284U);
}

TEST(SameBits, FloatFunctionsKeepTheirBits) {
    Floats any, exponents, base, power;
    for (std::uint64_t bits = 0; bits <= 0xffffffff; bits += 65521) {
        const auto x = std::bit_cast<float>(static_cast<std::uint32_t>(bits));
        any.push_back(x);
        exponents.push_back(x);
        for (const float y : {0.0F, 0.7F, 30.0F, 9999.0F}) {
            base.push_back(x);
            power.push_back(y);
        }
    }
    for (int i = 0; i < kPoints; ++i) {
        const float x = static_cast<float>(i) * (1.0F / kPoints);
        exponents.push_back(x * 254.0F - 126.0F);
        base.push_back(x);
        power.push_back(50.0F);
    }
    const auto hash_of_all = [](const Floats& values) {
        Hash hash;
        for (const float x : values)
            hash.add(x);
        return hash.value();
    };
    on_every_target([&](const std::string&) {
        EXPECT_EQ(hash_of_all(log2_lanes(any)), 10561541903976621222U);
        EXPECT_EQ(hash_of_all(exp2_lanes(exponents)), 1651141550712791765U);
        EXPECT_EQ(hash_of_all(pow_lanes(base, power)), 17386739217366542578U);
    });
}

TEST(SameBits, SrgbRotationsAndPredicatesKeepTheirBits) {
    Hash srgb;
    for (int code = 0; code < 256; ++code)
        srgb.add(srgb_decode(static_cast<std::uint8_t>(code)));
    for (std::uint64_t bits = 0; bits <= 0xffffffff; bits += 10007)
        srgb.add(
            std::uint64_t{srgb_encode(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))});
    EXPECT_EQ(srgb.value(), 13759760303776510039U);

    Hash matrices;
    Hash signs;
    Points points(11);
    for (int i = 0; i < kPoints; ++i) {
        for (const auto rotation : {rotation_x, rotation_y, rotation_z})
            matrices.add(rotation(points.uniform(-400, 400)));
        DMat3 m(0);
        for (int j = 0; j < 9; ++j)
            m[j / 3][j % 3] = points.any_size(-5, 5);
        matrices.add(cofactor(m));
        matrices.add(determinant(m));
        const DVec3 n = normalized(m[0]);
        matrices.add(dot3(n, m[1]));
        // A coarse grid that doubles cannot hold: many triples are almost on a line.
        DVec2 corners[3];
        for (int j = 0; j < 6; ++j)
            corners[j / 2][j % 2] = static_cast<double>(points.bits() & 7) * 0.1;
        signs.add(static_cast<double>(orient2d(corners[0], corners[1], corners[2])));
    }
    EXPECT_EQ(matrices.value(), 14198279917926850802U);
    EXPECT_EQ(signs.value(), 293642792005872588U);
}

} // namespace
} // namespace scanout::test
