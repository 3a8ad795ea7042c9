#include "io/file_name.h"

#include "io/text.h"

#include <cstdlib>
#include <memory>
#include <optional>

#include <utf8proc.h>

namespace scanout::io {
namespace {

// Composed and without case; nothing where `text` is no UTF-8.
std::optional<std::string> composed(std::string_view text) {
    constexpr auto kOptions =
        static_cast<utf8proc_option_t>(UTF8PROC_STABLE | UTF8PROC_COMPOSE | UTF8PROC_CASEFOLD);
    utf8proc_uint8_t* out = nullptr;
    const utf8proc_ssize_t length =
        ::utf8proc_map(reinterpret_cast<const utf8proc_uint8_t*>(text.data()),
                       static_cast<utf8proc_ssize_t>(text.size()), &out, kOptions);
    const std::unique_ptr<utf8proc_uint8_t, decltype(&std::free)> owner(out, &std::free);
    if (length < 0) return std::nullopt;
    return std::string(reinterpret_cast<const char*>(out), static_cast<std::size_t>(length));
}

std::string from_latin1(std::string_view text) {
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            out += c;
        } else {
            out += static_cast<char>(0xc0 | byte >> 6);
            out += static_cast<char>(0x80 | (byte & 0x3f));
        }
    }
    return out;
}

int hex_value(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::string_view without_comment(std::string_view name) {
    const std::size_t mark = name.find(" #");
    if (mark == std::string_view::npos) return name;
    name = name.substr(0, mark);
    while (!name.empty() && (name.back() == ' ' || name.back() == '\t'))
        name.remove_suffix(1);
    return name;
}

} // namespace

std::string percent_decoded(std::string_view name) {
    std::string out;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const int high = i + 2 < name.size() && name[i] == '%' ? hex_value(name[i + 1]) : -1;
        const int low = high >= 0 ? hex_value(name[i + 2]) : -1;
        if (low < 0) {
            out += name[i];
            continue;
        }
        out += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return out;
}

std::string folded(std::string_view name) {
    if (auto text = composed(name)) return *std::move(text);
    if (auto text = composed(from_latin1(name))) return *std::move(text);
    return lower_case(name);
}

std::vector<std::string> spellings(std::string_view name) {
    std::vector<std::string> names = {std::string(name)};
    const auto add = [&](std::string other) {
        for (const std::string& known : names)
            if (known == other) return;
        if (!other.empty()) names.push_back(std::move(other));
    };
    add(percent_decoded(name));
    add(std::string(without_comment(name)));
    add(percent_decoded(without_comment(name)));
    return names;
}

} // namespace scanout::io
