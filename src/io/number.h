// Numbers in text formats: exactly what strtod gives in the C locale, by std::from_chars, which
// knows no locale. Two things it does otherwise are put right here: it refuses a leading '+', and
// it takes the words "nan" and "inf", which no mesh format has.
#pragma once

#include <charconv>
#include <cstdint>
#include <string_view>
#include <system_error>

namespace scanout::io {

enum class NumberFault { none, not_a_number, too_large };

// True when the number text [begin, end), which from_chars called out of range, is too small rather
// than too large: such a number reads as 0.
bool is_underflow(std::string_view number);

// Reads one number at `at` and moves `at` behind it; on a fault `at` stays. The caller judges the
// characters behind it ("1,5" reads as 1). A number longer than kLongestNumber characters is a
// fault: a file of digits alone must not be read as one number.
inline constexpr std::ptrdiff_t kLongestNumber = 1024;

inline NumberFault read_number(const char*& at, const char* end, double& value) {
    const char* first = at;
    if (end - first > kLongestNumber) end = first + kLongestNumber;
    if (first != end && *first == '+') ++first;
    // The first character decides: digit or point, after a '-' that no '+' precedes.
    const char* digit = first;
    if (digit != end && *digit == '-' && digit == at) ++digit;
    if (digit == end || !((*digit >= '0' && *digit <= '9') || *digit == '.'))
        return NumberFault::not_a_number;
    const auto [rest, error] = std::from_chars(first, end, value);
    if (error == std::errc::invalid_argument || rest - at >= kLongestNumber)
        return NumberFault::not_a_number;
    if (error == std::errc::result_out_of_range) {
        if (!is_underflow({digit, static_cast<std::size_t>(rest - digit)}))
            return NumberFault::too_large;
        value = *first == '-' ? -0.0 : 0.0;
    }
    at = rest;
    return NumberFault::none;
}

// Reads a whole number with an optional sign; false, and `at` stays, where there is none. Numbers
// beyond 10^18 saturate, so that they stay out of every range.
inline bool read_integer(const char*& at, const char* end, std::int64_t& value) {
    constexpr std::int64_t kSaturated = 1'000'000'000'000'000'000;
    const char* p = at;
    const bool negative = p != end && *p == '-';
    if (p != end && (*p == '-' || *p == '+')) ++p;
    const char* digits = p;
    std::int64_t n = 0;
    for (; p != end && *p >= '0' && *p <= '9'; ++p)
        n = n < kSaturated / 10 ? n * 10 + (*p - '0') : kSaturated;
    if (p == digits) return false;
    value = negative ? -n : n;
    at = p;
    return true;
}

} // namespace scanout::io
