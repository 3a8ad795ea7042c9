#include "io/cursor.h"

#include <algorithm>
#include <cstring>

namespace scanout::io {

bool Cursor::skip_rare_blank() {
    if (*at == '\\') {
        const char* line_end = behind_continuation();
        if (line_end == nullptr) return false;
        at = line_end;
        next_line();
        return true;
    }
    if (!is_blank(*at)) return false;
    if (*at == '\0' && nul_line == 0) nul_line = line;
    ++at;
    return true;
}

const char* Cursor::behind_continuation() const {
    const char* p = at + 1;
    while (p != end && is_blank(*p))
        ++p;
    return p == end || *p == '\n' || *p == '\r' ? p : nullptr;
}

void Cursor::skip_nuls(std::size_t limit) {
    const char* stop = static_cast<std::size_t>(end - at) > limit ? at + limit : end;
    if (at != stop && *at == '\0' && nul_line == 0) nul_line = line;
    for (std::uint64_t eight = 0; stop - at >= 8; at += 8) {
        std::memcpy(&eight, at, 8);
        if (eight != 0) break;
    }
    while (at != stop && *at == '\0')
        ++at;
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
