// What a terminal is asked at the start, and what it says: nothing is taken from its name.
#pragma once

#include "platform/tty/parser.h"

#include <string>

namespace scanout::tty {

struct Facts {
    bool answers = false;      // device attributes: so it answers the same again after a frame
    bool kitty = false;        // kitty's graphics protocol
    bool sixel = false;        // attribute 4 of the device attributes (DEC STD 070)
    bool pixel_mouse = false;  // mode 1016: the mouse's place in pixels
    bool synchronized = false; // mode 2026: a frame appears at once
    bool true_colour = false;  // 24-bit colours
    int cell_width = 0, cell_height = 0; // pixels; 0: not said
    int colour_registers = 0;            // of sixel; 0: not said
    std::string refusal{};               // of a picture by kitty's protocol; "": none
    friend bool operator==(const Facts&, const Facts&) = default;
};

// The end of the questions, and of each frame that nothing else answers: primary device attributes.
inline constexpr const char* kAskAttributes = "\x1b[c";

// All questions, the device attributes last: when they are answered, so is what can be.
// tmux: the question for kitty's graphics goes through it, to the terminal that shows it.
std::string questions(bool tmux);

enum class Answer : unsigned char {
    none,       // the token is no answer
    fact,       // taken into the facts
    attributes, // the device attributes, likewise
    picture,    // kitty has read a picture
    refusal     // kitty could not take one; Facts::refusal is left to whoever sent it
};
Answer take_answer(const Token& token, Facts& facts);
// What a refusal says: "ENOSPC:full", in characters that a message may have.
std::string refusal_of(const Token& token);

// `text` for the terminal behind tmux, where its option allow-passthrough is on.
std::string through_tmux(std::string_view text);

} // namespace scanout::tty
