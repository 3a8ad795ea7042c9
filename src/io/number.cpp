#include "io/number.h"

#include <algorithm>

namespace scanout::io {

bool is_underflow(std::string_view number) {
    // The decimal exponent of the first digit that is not 0, counted from the point, plus the
    // written exponent: out of range and negative means too small.
    const std::size_t e = std::min(number.find_first_of("eE"), number.size());
    const std::string_view mantissa = number.substr(0, e);
    const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
    const std::size_t digit = mantissa.find_first_not_of("0.");
    if (digit == std::string_view::npos) return true;
    const auto magnitude = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(digit);
    std::int64_t exponent = 0;
    if (e < number.size()) {
        const char* at = number.data() + e + 1;
        read_integer(at, number.data() + number.size(), exponent);
    }
    return magnitude + exponent < 0;
}

} // namespace scanout::io
