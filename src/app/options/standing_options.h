// Options that a user wants in every run: the file ~/.config/scanout/options, then the variable
// SCANOUT_OPTIONS. What the command line says goes before both, and the variable before the file.
#pragma once

#include "app/options/settings.h"
#include "base/result.h"

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::app {

struct StandingWord {
    std::string text;
    std::string source; // "PATH:LINE" or "SCANOUT_OPTIONS", for messages
};
using StandingPlace = std::vector<StandingWord>; // the file, or the variable

// From the weakest place to the strongest. Errors name what cannot be read, Exit::usage or
// Exit::unreadable; a file that is not there is none.
Result<std::vector<StandingPlace>> read_standing_options();

// $XDG_CONFIG_HOME/scanout/options, else ~/.config/scanout/options; empty: no home.
std::string standing_options_file();

std::string standing_keys_file(); // keys.toml beside it

// Words as a shell splits them: blanks part them, quotes of either kind hold blanks together.
// Nothing is expanded. Error: the second half of a line.
Result<std::vector<std::string>> split_words(std::string_view text);

// Applies the options that belong to the settings' command, unless the command line (`given`:
// names) or a stronger place gives them or what excludes them.
Result<void> apply_standing(std::span<const StandingPlace> places,
                            const std::set<std::string_view>& given, Settings& settings);

} // namespace scanout::app
