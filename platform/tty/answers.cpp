#include "platform/tty/answers.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace scanout::tty {
namespace {

constexpr int kQueryId = 31; // of the picture that kitty is asked about, and never shows

// The numbers of "4;16;8"; 0 where there is none.
std::vector<int> numbers_of(std::string_view text) {
    std::vector<int> numbers;
    while (!text.empty()) {
        int value = 0;
        const auto end = std::min(text.find_first_of(";:"), text.size());
        std::from_chars(text.data(), text.data() + end, value);
        numbers.push_back(value);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return numbers;
}

bool within(int pixels) {
    return pixels > 0 && pixels <= 1000;
}

Answer take_sequence(std::string_view text, Facts& facts) {
    const char last = text.back();
    text.remove_suffix(1);
    if (text.starts_with('?') && last == 'c') {
        const std::vector<int> attributes = numbers_of(text.substr(1));
        facts.answers = true;
        facts.sixel = std::find(attributes.begin(), attributes.end(), 4) != attributes.end();
        return Answer::attributes;
    }
    if (text.starts_with('?') && last == 'y' && text.ends_with('$')) { // DECRPM
        const std::vector<int> mode = numbers_of(text.substr(1, text.size() - 2));
        const bool known = mode.size() == 2 && (mode[1] == 1 || mode[1] == 2);
        if (known && mode[0] == 1016) facts.pixel_mouse = true;
        if (known && mode[0] == 2026) facts.synchronized = true;
        return Answer::fact;
    }
    if (text.starts_with("6;") && last == 't') {
        const std::vector<int> cell = numbers_of(text);
        if (cell.size() == 3 && within(cell[1]) && within(cell[2])) {
            facts.cell_height = cell[1];
            facts.cell_width = cell[2];
        }
        return Answer::fact;
    }
    if (text.starts_with("?1;") && last == 'S') { // XTSMGRAPHICS: colour registers
        const std::vector<int> graphics = numbers_of(text.substr(1));
        if (graphics.size() == 3 && graphics[1] == 0) facts.colour_registers = graphics[2];
        return Answer::fact;
    }
    return Answer::none;
}

Answer take_string(std::string_view text, Facts& facts) {
    if (text.starts_with("_G")) {
        const bool ok = text.ends_with(";OK");
        if (text.substr(0, text.find(';')) != fmt::format("_Gi={}", kQueryId))
            return ok ? Answer::picture : Answer::refusal;
        facts.kitty = facts.kitty || ok;
        return Answer::fact;
    }
    // DECRQSS: the colour that was set, if it is known as one of 24 bits.
    if (text.starts_with("P1$r")) {
        const std::vector<int> colours = numbers_of(text.substr(4));
        const auto at = std::find(colours.begin(), colours.end(), 48);
        if (colours.end() - at >= 5 && at[1] == 2) facts.true_colour = true;
    }
    return Answer::fact;
}

} // namespace

std::string through_tmux(std::string_view text) {
    std::string wrapped = "\x1bPtmux;";
    for (const char c : text)
        wrapped.append(c == '\x1b' ? 2 : 1, c);
    return wrapped + "\x1b\\";
}

std::string questions(bool tmux) {
    const std::string kitty = fmt::format("\x1b_Gi={},s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\", kQueryId);
    return (tmux ? through_tmux(kitty) : kitty) +
           "\x1b[16t"                             // a cell's pixels
           "\x1b[?1016$p\x1b[?2026$p"             // DECRQM
           "\x1b[48;2;1;2;3m\x1bP$qm\x1b\\\x1b[m" // DECRQSS of a colour
           "\x1b[?1;1;0S" +                       // XTSMGRAPHICS
           std::string(kAskAttributes);
}

std::string refusal_of(const Token& token) {
    std::string said = token.text.substr(std::min(token.text.find(';'), token.text.size() - 1) + 1);
    constexpr std::size_t kMost = 60;
    said.resize(std::min(said.size(), kMost));
    std::replace_if(
        said.begin(), said.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return said.empty() ? "an error" : said;
}

Answer take_answer(const Token& token, Facts& facts) {
    if (token.text.empty()) return Answer::none;
    if (token.kind == Token::Kind::sequence) return take_sequence(token.text, facts);
    return token.kind == Token::Kind::string ? take_string(token.text, facts) : Answer::none;
}

} // namespace scanout::tty
