#include "io/cursor.h"
#include "io/number.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::io {
namespace {

// The program starts in the C locale, so strtod is the oracle here.
double by_strtod(const std::string& text) {
    return std::strtod(text.c_str(), nullptr);
}

NumberFault read_word(const std::string& text, double& value) {
    Cursor cursor(text);
    const NumberFault fault = cursor.number(value);
    EXPECT_EQ(cursor.at, fault == NumberFault::none ? cursor.end : text.data()) << text;
    return fault;
}

struct Case {
    std::string text;
    NumberFault fault;
};

constexpr auto kOk = NumberFault::none;
constexpr auto kNot = NumberFault::not_a_number;
constexpr auto kLarge = NumberFault::too_large;

const Case kCases[] = {
    {"0", kOk},
    {"-0", kOk},
    {"+0", kOk},
    {"1", kOk},
    {"+1", kOk},
    {"-1", kOk},
    {".5", kOk},
    {"-.5", kOk},
    {"+.5", kOk},
    {"1.", kOk},
    {"-1.", kOk},
    {"00001.5000", kOk},
    {"1e3", kOk},
    {"1E3", kOk},
    {"1e+3", kOk},
    {"1e-3", kOk},
    {"1e03", kOk},
    {"1e-0003", kOk},
    {"2.e1", kOk},
    {"0.1", kOk},
    {"0.30000000000000004", kOk},
    {"3.14159265358979323846264338327950288419716939937510", kOk},
    {"9007199254740993", kOk}, // 2^53 + 1: a tie
    {"9007199254740992.9999999", kOk},
    {"1.7976931348623157e308", kOk}, // the largest double
    {"1.7976931348623158e308", kOk}, // rounds to it
    {"1.7976931348623159e308", kLarge},
    {"-1.8e308", kLarge},
    {"1e400", kLarge},
    {"-1e400", kLarge},
    {"1e99999999999999999999", kLarge},
    {"2.2250738585072014e-308", kOk}, // the smallest normal double
    {"2.2250738585072011e-308", kOk}, // the literal that once hung PHP and Java
    {"4.9406564584124654e-324", kOk}, // the smallest of all
    {"2.4703282292062328e-324", kOk}, // above half of it: rounds up
    {"2.4703282292062327e-324", kOk}, // below half of it: 0
    {"1e-320", kOk},
    {"1e-400", kOk},
    {"-1e-400", kOk},
    {"0.000001e-500", kOk},
    {"1e-99999999999999999999", kOk},
    {"0e400", kOk},
    {"6.02214076e23", kOk},
    {"123456789012345678901234567890", kOk},
    {"", kNot},
    {"+", kNot},
    {"-", kNot},
    {".", kNot},
    {"-.", kNot},
    {"e5", kNot},
    {".e5", kNot},
    {"+-1", kNot},
    {"-+1", kNot},
    {"++1", kNot},
    {"--1", kNot},
    {"1e", kNot},
    {"1e+", kNot},
    {"1,5", kNot},
    {"1.5.2", kNot},
    {"3.1+e2", kNot},
    {"1d5", kNot},
    {"0x1p3", kNot},
    {"0x10", kNot},
    {"nan", kNot},
    {"-nan", kNot},
    {"NaN", kNot},
    {"nan(12)", kNot},
    {"inf", kNot},
    {"+inf", kNot},
    {"-Infinity", kNot},
    {"1.#INF", kNot},
    {"1.#IND", kNot},
    {"1abc", kNot},
    {"abc", kNot},
    {"1_000", kNot},
};

// HARD-CASES 59
TEST(Number, EveryFormIsReadAsStrtodReadsItOrRefused) {
    for (const Case& c : kCases) {
        double value = 42;
        ASSERT_EQ(read_word(c.text, value), c.fault) << '"' << c.text << '"';
        if (c.fault == kOk)
            EXPECT_EQ(std::bit_cast<std::uint64_t>(value),
                      std::bit_cast<std::uint64_t>(by_strtod(c.text)))
                << c.text;
        else
            EXPECT_EQ(value, 42) << "a refused number must not be stored: " << c.text;
    }
}

RC_GTEST_PROP(Number, EveryFiniteDoubleComesBackBitForBit, ()) {
    const auto bits = *rc::gen::arbitrary<std::uint64_t>();
    const double number = std::bit_cast<double>(bits);
    RC_PRE(std::isfinite(number));
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.17g", number);
    double value = 0;
    RC_ASSERT(read_word(text.data(), value) == kOk);
    RC_ASSERT(std::bit_cast<std::uint64_t>(value) == bits);
}

RC_GTEST_PROP(Number, DecimalsOfAnyLengthAreReadAsStrtodReadsThem, ()) {
    const auto digits = *rc::gen::container<std::string>(rc::gen::inRange('0', ':'));
    const int exponent = *rc::gen::inRange(-340, 310);
    const std::string text = "0." + digits + "e" + std::to_string(exponent);
    double value = 0;
    const NumberFault fault = read_word(text, value);
    const double expected = by_strtod(text);
    RC_ASSERT(fault == (std::isinf(expected) ? kLarge : kOk));
    if (fault == kOk)
        RC_ASSERT(std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(expected));
}

TEST(Number, ATextOfDigitsWithoutEndIsNoNumber) {
    double value = 0;
    EXPECT_EQ(read_word(std::string(1000, '1').insert(1, "."), value), kOk);
    EXPECT_EQ(read_word(std::string(5000, '1').insert(1, "."), value), kNot);
}

TEST(Number, ManyZerosBeforeOrBehindThePointAreJudgedByTheirPlace) {
    double value = 0;
    EXPECT_EQ(read_word("0." + std::string(500, '0') + "1", value), kOk);
    EXPECT_EQ(value, 0);
    EXPECT_EQ(read_word("1" + std::string(500, '0'), value), kLarge);
    EXPECT_EQ(read_word("1" + std::string(500, '0') + "e-500", value), kOk);
    EXPECT_EQ(value, 1);
    EXPECT_EQ(read_word("-0." + std::string(500, '0') + "1e501", value), kOk);
    EXPECT_EQ(value, -1);
}

TEST(Integer, IsReadExactlyAndSaturatesFarOutside) {
    const auto read = [](std::string text) {
        const char* at = text.data();
        std::int64_t value = 0;
        EXPECT_TRUE(read_integer(at, text.data() + text.size(), value)) << text;
        return value;
    };
    EXPECT_EQ(read("0"), 0);
    EXPECT_EQ(read("-0"), 0);
    EXPECT_EQ(read("+17"), 17);
    EXPECT_EQ(read("007"), 7);
    EXPECT_EQ(read("2147483648"), 2147483648);
    EXPECT_EQ(read("-2147483649"), -2147483649);
    EXPECT_EQ(read("4294967297"), 4294967297);
    EXPECT_GT(read("9223372036854775808"), 1LL << 40);
    EXPECT_LT(read("-99999999999999999999999999"), -(1LL << 40));
    const std::string none = "-x";
    const char* at = none.data();
    std::int64_t value = 5;
    EXPECT_FALSE(read_integer(at, at + none.size(), value));
    EXPECT_EQ(value, 5);
    EXPECT_EQ(at, none.data());
}

} // namespace
} // namespace scanout::io
