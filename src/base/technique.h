// The self-description of a technique: one file, one name, one of these (src/techniques.h).
#pragma once

#include <cstdint>
#include <string_view>

namespace scanout {

enum class Kind : std::uint8_t {
    rung,   // has an error against the reference; ordered on its axis, cheapest first
    effect, // its neutral element changes no bit
    model   // a choice; not ordered
};

struct Technique {
    std::string_view axis, name;
    std::string_view blurb;  // one line
    std::string_view source; // its authors: papers, books, standards of docs/REFERENCES.md
    Kind kind = Kind::model;
    bool least = false; // of models: does less than the others on its axis
};

} // namespace scanout
