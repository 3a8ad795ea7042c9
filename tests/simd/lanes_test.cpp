// Every operation on lanes gives what plain code gives for each lane, to the bit, on every target.
#include "simd/lane_operations.h"
#include "support/targets.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

// --- the operations on one lane

struct Whole { // wraps around
    std::int32_t v;
    std::uint32_t u() const { return static_cast<std::uint32_t>(v); }
};
Whole whole(std::uint32_t x) {
    return {static_cast<std::int32_t>(x)};
}
Whole operator+(Whole a, Whole b) {
    return whole(a.u() + b.u());
}
Whole operator-(Whole a, Whole b) {
    return whole(a.u() - b.u());
}
Whole operator*(Whole a, Whole b) {
    return whole(a.u() * b.u());
}
Whole operator&(Whole a, Whole b) {
    return whole(a.u() & b.u());
}
Whole operator|(Whole a, Whole b) {
    return whole(a.u() | b.u());
}
bool operator<(Whole a, Whole b) {
    return a.v < b.v;
}
bool operator>(Whole a, Whole b) {
    return a.v > b.v;
}
bool operator<=(Whole a, Whole b) {
    return a.v <= b.v;
}
bool operator>=(Whole a, Whole b) {
    return a.v >= b.v;
}
bool operator==(Whole a, Whole b) {
    return a.v == b.v;
}
template <int kCount>
Whole shift_left(Whole a) {
    return whole(a.u() << kCount);
}
template <int kCount>
Whole shift_right(Whole a) { // floor(a / 2^count)
    const auto wide = static_cast<double>(a.v);
    return {static_cast<std::int32_t>(std::floor(std::ldexp(wide, -kCount)))};
}

template <class T>
T select(bool mask, T yes, T no) {
    return mask ? yes : no;
}
template <class T>
T minimum(T a, T b) {
    return a < b ? a : b;
}
template <class T>
T maximum(T a, T b) {
    return a > b ? a : b;
}
float sqrt(float a) {
    return std::sqrt(a);
}
template <class T>
T abs(T a) {
    return std::fabs(a);
}
float to_f32(Whole a) {
    return static_cast<float>(a.v);
}
float to_f32(double a) {
    return static_cast<float>(a);
}
double to_f64(Whole a) {
    return a.v;
}
double to_f64(float a) {
    return a;
}
bool to_f64(bool mask) {
    return mask;
}
Whole to_i32(float a) {
    return {static_cast<std::int32_t>(a)};
}
Whole to_i32(double a) {
    return {static_cast<std::int32_t>(a)};
}
Whole bits_of(float a) {
    return {std::bit_cast<std::int32_t>(a)};
}
float from_bits(Whole a) {
    return std::bit_cast<float>(a.v);
}

Results plain(const Operands& in, int lanes) {
    Results out = {};
    out.lanes = lanes;
    for (int n = 0; n < lanes; ++n) {
        const float a = in.a[n], b = in.b[n], c = in.c[n];
        const Whole i = {in.i[n]}, j = {in.j[n]};
        const double p = in.p[n], q = in.q[n], r = in.r[n];
        int row = 0;
#define STORE_FLOAT(formula) out.f[row++][n] = formula;
        SCANOUT_FLOAT_OPERATIONS(STORE_FLOAT)
        row = 0;
#define STORE_INT(formula) out.i[row++][n] = (formula).v;
        SCANOUT_INT_OPERATIONS(STORE_INT)
        row = 0;
#define STORE_DOUBLE(formula) out.d[row++][n] = formula;
        SCANOUT_DOUBLE_OPERATIONS(STORE_DOUBLE)
        row = 0;
#define STORE_MASK(formula) out.bits[row++] |= (formula) ? 1U << n : 0U;
        SCANOUT_MASK_OPERATIONS(STORE_MASK)
    }
    for (int k = 0; k < kMaskOperations; ++k) {
        out.any[k] = out.bits[k] != 0;
        out.all[k] = out.bits[k] == (2U << (lanes - 1)) - 1;
    }
    return out;
}

#define NAME(formula) #formula,
constexpr const char* kFloatNames[] = {SCANOUT_FLOAT_OPERATIONS(NAME)};
constexpr const char* kIntNames[] = {SCANOUT_INT_OPERATIONS(NAME)};
constexpr const char* kDoubleNames[] = {SCANOUT_DOUBLE_OPERATIONS(NAME)};
constexpr const char* kMaskNames[] = {SCANOUT_MASK_OPERATIONS(NAME)};
#undef NAME

// --- operands

// splitmix64 (Steele, Lea and Flood 2014).
class Random {
public:
    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    template <class T, std::size_t kCount>
    T one_of(const T (&from)[kCount]) {
        return from[bits() % kCount];
    }

private:
    std::uint64_t state_ = 1;
};

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kOddFloats[] = {0.0F,      -0.0F,      1.0F,  -1.0F, kInf,   -kInf,     kNaN,
                                0x1p-149F, -0x1p-149F, 3e38F, 0.5F,  1e-40F, 0x1p-126F, 0x1p31F};
constexpr std::int32_t kOddWholes[] = {0, 1, -1, INT32_MAX, INT32_MIN, 0x7f800000, 0x00400000, 255};
constexpr double kOddDoubles[] = {0.0,
                                  -0.0,
                                  1.0,
                                  -1.0,
                                  kInf,
                                  -kInf,
                                  kNaN,
                                  0x1p-149,
                                  0x1p-150,
                                  1e300,
                                  -1e300,
                                  0x1p-1074,
                                  0x1p128,
                                  -0x1p128,
                                  0x1.fffffefffffffp127,
                                  0x1.ffffffp127,
                                  0x1.fffffep127,
                                  0x1.0000010000001p0,
                                  0x1.000001p0};
constexpr double kLimits[] = {0,   -0.0, 0.99999, -0.99999, 2147483520.0, -2147483520.0,
                              1.5, -1.5, 0x1p-149};

// Any bits, special values, or plain numbers: by the round.
Operands random_operands(Random& random, int round) {
    Operands in = {};
    const auto plain_number = [&] { return std::ldexp(random.unit() - 0.5, 20); };
    for (int n = 0; n < kMaxLanes; ++n) {
        const auto real = [&](auto any, const auto& odd) {
            switch (round % 3) {
            case 0:
                return any;
            case 1:
                return random.one_of(odd);
            default:
                return static_cast<decltype(any)>(plain_number());
            }
        };
        const auto any_float = [&] {
            return std::bit_cast<float>(static_cast<std::uint32_t>(random.bits() >> 32));
        };
        in.a[n] = real(any_float(), kOddFloats);
        in.b[n] = random.bits() % 8 == 0 ? in.a[n] : real(any_float(), kOddFloats);
        in.p[n] = real(std::bit_cast<double>(random.bits()), kOddDoubles);
        in.q[n] =
            random.bits() % 8 == 0 ? in.p[n] : real(static_cast<double>(any_float()), kOddDoubles);
        const auto integer = [&] {
            return round % 3 == 1 ? random.one_of(kOddWholes)
                                  : static_cast<std::int32_t>(random.bits() >> 32);
        };
        in.i[n] = integer();
        in.j[n] = random.bits() % 8 == 0 ? in.i[n] : integer();
        const double limited =
            round % 3 == 1 ? random.one_of(kLimits) : (random.unit() * 2 - 1) * 2147483520.0;
        in.c[n] = static_cast<float>(limited);
        in.r[n] = limited == 2147483520.0 ? 2147483647.0 : limited;
    }
    return in;
}

// The same bits; any NaN equals any other.
template <class T>
bool same(T got, T want) {
    return std::memcmp(&got, &want, sizeof(T)) == 0 || (got != got && want != want);
}

template <class T, std::size_t kRows>
void expect_rows(const T (&got)[kRows][kMaxLanes], const T (&want)[kRows][kMaxLanes], int lanes,
                 const char* const (&names)[kRows]) {
    for (std::size_t k = 0; k < kRows; ++k)
        for (int n = 0; n < lanes; ++n)
            EXPECT_TRUE(same(got[k][n], want[k][n])) << names[k] << " in lane " << n << ": "
                                                     << got[k][n] << " instead of " << want[k][n];
}

class Lanes : public testing::TestWithParam<bool> {};

TEST_P(Lanes, GiveWhatPlainCodeGives) {
    on_every_target([&](const std::string&) {
        Random random;
        for (int round = 0; round < 3000 && !HasFailure(); ++round) {
            const Operands in = random_operands(random, round);
            Results got = {};
            run_operations(GetParam(), in, got);
            const Results want = plain(in, got.lanes);
            expect_rows(got.f, want.f, got.lanes, kFloatNames);
            expect_rows(got.i, want.i, got.lanes, kIntNames);
            expect_rows(got.d, want.d, got.lanes, kDoubleNames);
            for (int k = 0; k < kMaskOperations; ++k) {
                EXPECT_EQ(got.bits[k], want.bits[k]) << kMaskNames[k];
                EXPECT_EQ(got.any[k], want.any[k]) << "any " << kMaskNames[k];
                EXPECT_EQ(got.all[k], want.all[k]) << "all " << kMaskNames[k];
            }
        }
    });
}

TEST_P(Lanes, MoveToAndFromMemoryInOrder) {
    float numbers[3 * kMaxLanes];
    std::int32_t index[kMaxLanes];
    for (int n = 0; n < 3 * kMaxLanes; ++n)
        numbers[n] = static_cast<float>(n) + 0.5F;
    for (int n = 0; n < kMaxLanes; ++n)
        index[n] = n * 29 % (3 * kMaxLanes);
    on_every_target([&](const std::string&) {
        Results width = {};
        run_operations(GetParam(), Operands{}, width);
        MemoryResults got = {};
        run_memory(GetParam(), numbers, index, got);
        for (int n = 0; n < width.lanes; ++n) {
            const float* three = numbers + 3 * n;
            EXPECT_EQ(got.x[n], three[0]) << n;
            EXPECT_EQ(got.y[n], three[1]) << n;
            EXPECT_EQ(got.z[n], three[2]) << n;
            EXPECT_EQ(got.ix[n], std::bit_cast<std::int32_t>(three[0])) << n;
            EXPECT_EQ(got.iy[n], std::bit_cast<std::int32_t>(three[1])) << n;
            EXPECT_EQ(got.iz[n], std::bit_cast<std::int32_t>(three[2])) << n;
            for (int k = 0; k < 2; ++k)
                EXPECT_EQ(got.pair[k][n], std::bit_cast<std::int32_t>(numbers[2 * n + k])) << n;
            EXPECT_EQ(got.gathered[n], numbers[index[n]]) << n;
            EXPECT_EQ(got.gathered_bits[n], std::bit_cast<std::int32_t>(numbers[index[n]])) << n;
            EXPECT_EQ(got.counted[n], n - 3);
            EXPECT_EQ(got.copied[n], std::bit_cast<std::uint32_t>(numbers[n])) << n;
            if (GetParam()) continue;
            EXPECT_EQ(got.records[n].x, got.ix[n]) << n;
            EXPECT_EQ(got.records[n].y, -got.iy[n]) << n;
            EXPECT_EQ(got.records[n].z, double{got.z[n]}) << n;
        }
        int packed = 0;
        for (int n = 0; n < width.lanes; ++n) {
            if ((kPacked >> n & 1) == 0) continue;
            const std::uint32_t* three = got.packed + 3 * packed++;
            EXPECT_EQ(three[0], static_cast<std::uint32_t>(got.ix[n])) << n;
            EXPECT_EQ(three[1], static_cast<std::uint32_t>(got.iy[n])) << n;
            EXPECT_EQ(three[2], static_cast<std::uint32_t>(got.iz[n])) << n;
        }
        EXPECT_EQ(got.packed_count, packed);
        for (int n = 3 * width.lanes; n < 3 * kMaxLanes; ++n)
            EXPECT_EQ(got.packed[n], 0U);
        std::uint32_t alone = 0;
        for (int n = 0; n < width.lanes; ++n)
            if (got.x[n] < got.gathered[n]) {
                EXPECT_EQ(got.packed_alone[alone++], got.ix[n]) << n;
            }
        EXPECT_EQ(got.packed_alone_count, alone);
        EXPECT_GT(alone, 0U);
        for (int n = width.lanes; n < 2 * kMaxLanes; ++n)
            EXPECT_EQ(got.packed_alone[n], 0);
        EXPECT_EQ(got.records[width.lanes].x, 0);
        for (int n = width.lanes; n < kMaxLanes; ++n) { // nothing beyond the register is written
            EXPECT_EQ(got.x[n], 0.0F);
            EXPECT_EQ(got.counted[n], 0);
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Simd, Lanes, testing::Bool(),
                         [](const auto& test) { return test.param ? "AtMost8" : "Wide"; });

TEST(Targets, WidthsAreThoseOfTheRegistersAndAtMost8InTheNarrowTypes) {
    on_every_target([&](const std::string& name) {
        Results wide = {}, narrow = {};
        run_operations(false, Operands{}, wide);
        run_operations(true, Operands{}, narrow);
        const int expected = name == "avx3" ? 16 : name == "avx2" ? 8 : 4;
        EXPECT_EQ(wide.lanes, expected);
        EXPECT_EQ(narrow.lanes, std::min(expected, 8));
    });
}

TEST(Targets, OneIsChosenAndItIsTheBestThatTheCpuHas) {
    const auto all = simd::targets();
    ASSERT_FALSE(all.empty());
    bool seen = false;
    for (const simd::Target& target : all) {
        EXPECT_EQ(target.chosen, target.supported && !seen) << target.name;
        seen = seen || target.supported;
    }
    EXPECT_TRUE(seen);
}

TEST(Targets, WhatTheCpuLacksOrNobodyKnowsIsRefusedAndChangesNothing) {
    const std::string before = simd::chosen_target();
    EXPECT_FALSE(simd::choose_target("sse5"));
    EXPECT_FALSE(simd::choose_target(""));
    for (const simd::Target& target : simd::targets()) {
        if (target.supported) continue;
        EXPECT_FALSE(simd::choose_target(target.name)) << target.name;
    }
    EXPECT_EQ(simd::chosen_target(), before);
}

TEST(Targets, AChoiceHoldsUntilTheNext) {
    on_every_target([&](const std::string& name) { EXPECT_EQ(simd::chosen_target(), name); });
    EXPECT_EQ(simd::chosen_target(), supported_targets().front());
}

} // namespace
} // namespace scanout::test
