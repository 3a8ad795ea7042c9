#include "app/options/values.h"

#include "app/picture/nearest.h"
#include "frame/options.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace scanout::app {
namespace {

template <class Number>
std::optional<Number> whole_number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || text.empty()) return std::nullopt;
    return value;
}

struct NamedColour {
    std::string_view name;
    image::Rgba8 colour;
};
constexpr std::array kColours = {
    NamedColour{"black", {0, 0, 0, 255}},      NamedColour{"white", {255, 255, 255, 255}},
    NamedColour{"grey", {128, 128, 128, 255}}, NamedColour{"slate", {48, 51, 56, 255}},
    NamedColour{"red", {200, 40, 40, 255}},    NamedColour{"green", {40, 160, 60, 255}},
    NamedColour{"blue", {40, 80, 200, 255}},   NamedColour{"sky", {150, 190, 230, 255}},
    NamedColour{"transparent", {0, 0, 0, 0}},
};

std::optional<image::Rgba8> hexadecimal(std::string_view digits) {
    if (digits.size() != 3 && digits.size() != 6) return std::nullopt;
    std::uint32_t value = 0;
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value, 16);
    if (error != std::errc() || stop != end) return std::nullopt;
    const auto channel = [&](int place) {
        if (digits.size() == 3)
            return static_cast<std::uint8_t>(((value >> (4 * place)) & 15U) * 17U);
        return static_cast<std::uint8_t>((value >> (8 * place)) & 255U);
    };
    return image::Rgba8{channel(2), channel(1), channel(0), 255};
}

} // namespace

Result<std::int64_t> parse_integer(std::string_view text) {
    if (const auto value = whole_number<std::int64_t>(text)) return *value;
    return fail(Exit::usage, "wants a whole number, not '{}'", text);
}

Result<double> parse_real(std::string_view text) {
    const auto value = whole_number<double>(text);
    if (value && std::isfinite(*value)) return *value;
    if (value) return fail(Exit::usage, "wants a finite number, not '{}'", text);
    return fail(Exit::usage, "wants a number, not '{}'", text);
}

Result<double> parse_time(std::string_view text) {
    const bool ms = text.ends_with("ms"), s = !ms && text.ends_with("s");
    const auto value = whole_number<double>(text.substr(0, text.size() - (ms ? 2 : s ? 1 : 0)));
    if (!value || !std::isfinite(*value))
        return fail(Exit::usage, "wants a time such as 16ms or 0.5s, not '{}'", text);
    const double milliseconds = s ? *value * 1000 : *value;
    if (milliseconds <= 0 || milliseconds > kLongestTime)
        return fail(Exit::usage, "must be more than 0 and at most {} s, not {}",
                    kLongestTime / 1000, text);
    return milliseconds;
}

Result<std::vector<double>> parse_list(std::string_view text, std::size_t least, std::size_t most) {
    std::vector<double> values;
    std::size_t count = 1;
    for (std::string_view rest = text;; ++count) {
        const std::size_t comma = rest.find(',');
        const auto value = whole_number<double>(rest.substr(0, comma));
        if (value && !std::isfinite(*value))
            return fail(Exit::usage, "wants finite numbers with commas, not '{}'", text);
        if (value && values.size() < most) values.push_back(*value);
        if (comma == std::string_view::npos) break;
        rest.remove_prefix(comma + 1);
    }
    if (values.size() == count && count >= least) return values;
    if (least == most)
        return fail(Exit::usage, "wants {} numbers with commas, not '{}'", least, text);
    return fail(Exit::usage, "wants {} to {} numbers with commas, not '{}'", least, most, text);
}

Result<DVec3> parse_vector(std::string_view text) {
    TRY(const std::vector<double> values, parse_list(text, 3, 3));
    return DVec3(values[0], values[1], values[2]);
}

Result<Size> parse_size(std::string_view text) {
    const std::size_t cross = text.find('x');
    const auto width = whole_number<std::int64_t>(text.substr(0, cross));
    const auto height = cross == std::string_view::npos
                            ? std::nullopt
                            : whole_number<std::int64_t>(text.substr(cross + 1));
    if (!width || !height)
        return fail(Exit::usage, "wants a size such as 1920x1080, not '{}'", text);
    constexpr std::int64_t kMax = frame::kMaxSide;
    if (*width < 1 || *height < 1 || *width > kMax || *height > kMax)
        return fail(Exit::usage, "{}: each side must be 1 to {} pixels", text, kMax);
    if (*width * *height > kMaxPixels)
        return fail(Exit::usage, "{}: {} million pixels; at most {} million are drawn", text,
                    *width * *height / 1'000'000, kMaxPixels / 1'000'000);
    return Size{static_cast<int>(*width), static_cast<int>(*height)};
}

Result<image::Rgba8> parse_colour(std::string_view text) {
    if (text.starts_with('#'))
        if (const auto colour = hexadecimal(text.substr(1))) return *colour;
    std::vector<std::string_view> names;
    for (const NamedColour& named : kColours) {
        if (named.name == text) return named.colour;
        names.push_back(named.name);
    }
    return fail(Exit::usage, "wants #rrggbb or a name, not '{}'{}; the names are {}", text,
                did_you_mean(text, names), colour_names());
}

std::string_view colour_names() {
    static const std::string names = [] {
        std::string joined;
        for (const NamedColour& named : kColours)
            joined += (joined.empty() ? "" : " ") + std::string(named.name);
        return joined;
    }();
    return names;
}

} // namespace scanout::app
