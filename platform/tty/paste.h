// Pasted text, which terminals mark as such (xterm's mode 2004): it is no keys.
#pragma once

#include "platform/tty/parser.h"

#include <chrono>

namespace scanout::tty {

class Paste {
public:
    using Time = std::chrono::steady_clock::time_point;

    // Is the token, which came at that time, of a paste? One whose end does not come is over when
    // nothing has come for a while, and at Ctrl-C, which is always heard: keys would be deaf for
    // ever.
    bool has(const Token& token, Time now) {
        constexpr std::chrono::seconds kSilence{1};
        const bool interrupts = token.kind == Token::Kind::keys && token.text == "\x03";
        if (interrupts || now - last_ > kSilence) going_ = false;
        last_ = now;
        const bool begins = is(token, "200~");
        if (begins || is(token, "201~")) {
            going_ = begins;
            return true;
        }
        return going_;
    }

private:
    static bool is(const Token& token, const char* text) {
        return token.kind == Token::Kind::sequence && token.text == text;
    }
    bool going_ = false;
    Time last_{};
};

} // namespace scanout::tty
