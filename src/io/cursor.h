// A place in a text file, read statement by statement without copying. It knows blanks, line ends
// (LF, CRLF, CR alone), continuation lines (a backslash before the line end) and line numbers, but
// not the meaning of statements. OBJ and MTL share it.
#pragma once

#include "io/number.h"

#include <cstddef>
#include <string>
#include <string_view>

namespace scanout::io {

struct Cursor {
    const char* at;
    const char* end;
    std::size_t line = 1;
    std::size_t nul_line = 0; // the first line with a NUL byte, 0: none. NUL reads as a blank

    explicit Cursor(std::string_view text) : at(text.data()), end(text.data() + text.size()) {}

    bool done() const { return at == end; }
    bool at_line_end() const { return at == end || *at == '\n' || *at == '\r'; }
    // A comment may follow a statement's last number.
    bool at_statement_end() const { return at_line_end() || *at == '#'; }

    static bool is_blank(char c) {
        return c == ' ' || c == '\t' || c == '\0' || c == '\v' || c == '\f';
    }

    // Moves to the next word of the statement, over continuation lines.
    void skip_blanks() {
        while (at != end) {
            if (*at == ' ' || *at == '\t') {
                ++at;
                continue;
            }
            const bool plain = static_cast<unsigned char>(*at) > ' ' && *at != '\\';
            if (plain || !skip_rare_blank()) return;
        }
    }

    // Goes behind the line end that the cursor stands at. CR LF is one line end.
    void next_line() {
        if (at == end) return;
        const bool cr = *at++ == '\r';
        if (cr && at != end && *at == '\n') ++at;
        ++line;
    }

    // Moves towards the line end, over at most `limit` bytes; true when it is reached. A backslash
    // at the end does not continue a comment: its last byte may be half of a GBK character.
    bool skip_to_line_end(std::size_t limit) {
        const char* stop = static_cast<std::size_t>(end - at) > limit ? at + limit : end;
        while (at != stop && *at != '\n' && *at != '\r')
            ++at;
        return at_line_end();
    }

    // Skips NUL bytes, at most `limit`: a download that was cut short may end in gigabytes of them.
    void skip_nuls(std::size_t limit);

    // A word ends at a blank, a line end or a backslash that continues the line.
    bool at_word_end() const {
        return at_line_end() || is_blank(*at) || (*at == '\\' && behind_continuation() != nullptr);
    }

    std::string_view word() {
        const char* begin = at;
        while (!at_word_end())
            ++at;
        return {begin, static_cast<std::size_t>(at - begin)};
    }

    // A number that ends where its word ends. On a fault the cursor and `value` stay.
    NumberFault number(double& value) {
        const char* begin = at;
        double read = 0;
        const NumberFault fault = read_number(at, end, read);
        if (fault != NumberFault::none) return fault;
        if (!at_word_end()) {
            at = begin;
            return NumberFault::not_a_number;
        }
        value = read;
        return NumberFault::none;
    }

    // Does the number here end at a comma followed by digits, as in a locale with decimal commas?
    bool number_before_comma() const {
        const char* p = at;
        double value = 0;
        return read_number(p, end, value) == NumberFault::none && end - p > 1 && *p == ',' &&
               p[1] >= '0' && p[1] <= '9';
    }

    // The rest of the statement, continuation lines joined, without blanks at its ends. Names
    // longer than kLongestName are cut.
    static constexpr std::size_t kLongestName = 65536;
    std::string rest();

private:
    bool skip_rare_blank();
    // The line end behind the backslash at the cursor, over blanks; null when none follows.
    const char* behind_continuation() const;
};

} // namespace scanout::io
