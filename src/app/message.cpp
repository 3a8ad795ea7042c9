#include "app/message.h"

#include "app/overlay/text.h"

#include <fmt/format.h>

namespace scanout::app {
namespace {

bool printable(char32_t code) {
    const bool control = code < 0x20 || (code >= 0x7f && code < 0xa0);
    // Line ends, and the marks and isolates of writing direction (Unicode 2022, 23.2 and 9.1).
    const bool turns = code == 0x61c || code == 0x200e || code == 0x200f ||
                       (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
    return !control && !turns;
}

} // namespace

std::string escaped(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        std::string_view rest = text;
        const char32_t code = take_code(rest);
        const std::string_view bytes = text.substr(0, text.size() - rest.size());
        const bool broken = code == kBroken && bytes.size() == 1;
        if (printable(code) && !broken)
            out += bytes;
        else
            for (const char byte : bytes)
                out += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
        text = rest;
    }
    return out;
}

void say(std::string_view line, std::FILE* to) {
    std::fputs((escaped(line) + "\n").c_str(), to);
}

void say_over(std::string_view line) {
    constexpr const char* kClear = "\r\x1b[K"; // to the line's start, erase to its end (ECMA-48)
    std::fputs((kClear + escaped(line)).c_str(), stderr);
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r";
    const std::size_t start = text.find_first_not_of(kBlanks);
    if (start == std::string_view::npos) return {};
    return text.substr(start, text.find_last_not_of(kBlanks) - start + 1);
}

} // namespace scanout::app
