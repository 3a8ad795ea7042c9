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

// Of rungs: lower ones on the axis that may err less, which the order of an axis else rules out.
struct LadderException {
    std::string_view than;   // names, a space between them
    std::string_view reason; // in which scenes, and why
};

struct Technique {
    std::string_view axis, name;
    std::string_view blurb;  // one line
    std::string_view source; // its authors: papers, books, standards of docs/REFERENCES.md
    Kind kind = Kind::model;
    bool least = false;                // of models: does less than the others on its axis
    LadderException may_err_more = {}; // empty: errs no more than any rung below
};

} // namespace scanout
