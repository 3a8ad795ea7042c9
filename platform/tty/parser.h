// Bytes from a terminal -> keys, control sequences and strings (ECMA-48 5.4, 5.6), wherever a read
// cuts through them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scanout::tty {

struct Token {
    enum class Kind : unsigned char {
        keys,     // bytes of one key, as console::keys_of() takes them
        sequence, // CSI: what stands behind ESC [, with the final letter
        string    // DCS, OSC, APC: its letter (P ] _ ^ X) and what stands before the end
    };
    Kind kind{};
    std::string text;
    friend bool operator==(const Token&, const Token&) = default;
};

class Parser {
public:
    // Appends what `bytes` complete. True: a token has begun, and its time with it.
    bool feed(std::string_view bytes, std::vector<Token>& tokens);

    // How long the rest of a token that has begun may take, ms; 0: none has begun. The Escape key
    // is the first byte of every sequence.
    int patience_ms() const;
    // It has taken longer: appends the key that it is after all, or drops it.
    void give_up(std::vector<Token>& tokens);

private:
    std::string pending_;
};

} // namespace scanout::tty
