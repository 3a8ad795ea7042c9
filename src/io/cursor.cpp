#include "io/cursor.h"

#include <algorithm>

namespace scanout::io {

bool Cursor::skip_rare_blank() {
    if (*at == '\\') return skip_continuation();
    if (!is_blank(*at)) return false;
    if (*at == '\0' && nul_line == 0) nul_line = line;
    ++at;
    return true;
}

bool Cursor::skip_continuation() {
    const char* p = at + 1;
    while (p != end && is_blank(*p))
        ++p; // blanks behind the backslash are forgiven
    if (p != end && *p != '\n' && *p != '\r') return false;
    at = p;
    next_line();
    return true;
}

std::string Cursor::rest() {
    std::string text;
    skip_blanks();
    for (;;) {
        const char* begin = at;
        while (!at_line_end())
            ++at;
        const auto length = static_cast<std::size_t>(at - begin);
        text.append(begin, std::min(length, kLongestName - text.size()));
        while (!text.empty() && is_blank(text.back()))
            text.pop_back();
        if (at == end || text.empty() || text.back() != '\\') return text;
        text.back() = ' ';
        next_line();
        skip_blanks();
    }
}

} // namespace scanout::io
