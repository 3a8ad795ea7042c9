// The table of options: one definition each (name, type, default, range, help) that feeds the
// command line, --help, `scanout list options`.
#pragma once

#include "app/options/settings.h"
#include "base/result.h"

#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace scanout::app {

enum class Group : std::uint8_t {
    output,
    picture,
    camera,
    model,
    display,
    times,
    comparison,
    examination,
    general
};

// Where an option's value goes, which is also its type.
using Switch = bool& (*)(Settings&);
using Integer = int& (*)(Settings&);
using BigInteger = std::int64_t& (*)(Settings&);
using Real = double& (*)(Settings&);
using Text = std::string& (*)(Settings&);
using Asked = std::string frame::FrameOptions::*;                  // a technique by name
using Choice = void (*)(Settings&, std::size_t index);             // index into `choices`
using Parsed = Result<void> (*)(Settings&, std::string_view text); // reads the text itself
using Slot = std::variant<Switch, Integer, BigInteger, Real, Text, Asked, Choice, Parsed>;

struct Option {
    std::string_view name;         // without dashes
    char letter = 0;               // 0: no short form
    std::string_view value;        // "WxH", "N"; empty for switches and for choices
    std::string_view choices;      // the words that are allowed, separated by spaces
    std::string_view default_text; // as on the command line; empty: none
    double min = 0, max = 0;       // of numbers, both included
    Group group = Group::general;
    unsigned commands = 0; // of Command
    Slot slot;
    std::string_view help;
    bool optional_value = false; // --name, or --name=VALUE
    bool repeats = false;        // each of several counts, not only the last
    bool in_order = false;       // and they are applied in the order of the command line
};

std::span<const Option> options();
inline bool belongs(const Option& option, Command command) {
    return (option.commands & static_cast<unsigned>(command)) != 0;
}
std::string value_text(const Option& option);

// Reads `text` into the settings. Errors are whole lines with the option's name, Exit::usage.
Result<void> apply(const Option& option, std::string_view text, Settings& settings);

} // namespace scanout::app
