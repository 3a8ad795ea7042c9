#include "platform/tty/parser.h"

#include <algorithm>

namespace scanout::tty {
namespace {

constexpr std::size_t kIncomplete = 0;
// No answer is longer: what is, is no answer.
constexpr std::size_t kMostBytes = 4096;

bool is_parameter(char c) {
    return c >= 0x20 && c <= 0x3f;
}

bool is_final(char c) {
    return c >= 0x40 && c <= 0x7e;
}

bool begins_string(char c) {
    return std::string_view("P]_^X").find(c) != std::string_view::npos;
}

// The length of ESC [ ..., or of ESC O ... for the keys of older terminals.
std::size_t length_of_sequence(std::string_view bytes) {
    std::size_t end = 2;
    if (bytes.substr(0, 3) == "\x1b[[") end = 3; // the Linux console's F1 to F5
    while (end < bytes.size() && is_parameter(bytes[end]))
        ++end;
    if (end == bytes.size()) return kIncomplete;
    return is_final(bytes[end]) ? end + 1 : end; // broken: up to what broke it
}

// Strings end by ESC \ or BEL.
std::size_t length_of_string(std::string_view bytes) {
    for (std::size_t i = 2; i < bytes.size(); ++i) {
        if (bytes[i] == '\a') return i + 1;
        if (bytes[i] == '\x1b' && i + 1 < bytes.size()) return bytes[i + 1] == '\\' ? i + 2 : i;
    }
    return kIncomplete;
}

// Of the token at the front, which is not empty.
std::size_t length_of(std::string_view bytes) {
    if (bytes[0] != '\x1b') return 1;
    if (bytes.size() == 1) return kIncomplete;
    if (bytes[1] == '\x1b') return 1;
    if (bytes[1] == '[' || bytes[1] == 'O') return length_of_sequence(bytes);
    return begins_string(bytes[1]) ? length_of_string(bytes) : 2;
}

Token token_of(std::string_view bytes) {
    if (bytes.size() > 2 && bytes[0] == '\x1b' && bytes[1] == '[' && bytes[2] != '[')
        return {Token::Kind::sequence, std::string(bytes.substr(2))};
    if (bytes.size() > 2 && bytes[0] == '\x1b' && begins_string(bytes[1])) {
        const std::size_t end = bytes.back() == '\a' ? 1 : 2;
        return {Token::Kind::string, std::string(bytes.substr(1, bytes.size() - 1 - end))};
    }
    return {Token::Kind::keys, std::string(bytes)};
}

} // namespace

bool Parser::feed(std::string_view bytes, std::vector<Token>& tokens) {
    const bool had_begun = !pending_.empty();
    const std::size_t before = tokens.size();
    pending_ += bytes;
    std::string_view rest = pending_;
    while (!rest.empty()) {
        const std::size_t length = length_of(rest);
        if (length == kIncomplete) break;
        tokens.push_back(token_of(rest.substr(0, length)));
        rest.remove_prefix(length);
    }
    pending_.erase(0, pending_.size() - rest.size());
    if (pending_.size() > kMostBytes) pending_.clear();
    return !pending_.empty() && (!had_begun || tokens.size() > before);
}

int Parser::patience_ms() const {
    // By ssh the bytes of an arrow may be 80 ms apart; an answer may come in two packets.
    constexpr int kKeyMs = 150, kAnswerMs = 1000;
    return pending_.empty() ? 0 : pending_.size() <= 2 ? kKeyMs : kAnswerMs;
}

void Parser::give_up(std::vector<Token>& tokens) {
    if (pending_.size() == 1 || pending_.size() == 2)
        tokens.push_back({Token::Kind::keys, pending_});
    pending_.clear();
}

} // namespace scanout::tty
