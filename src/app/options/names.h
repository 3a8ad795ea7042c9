// How the words of a command line name options.
#pragma once

#include "app/options/options.h"

#include <string>
#include <string_view>

namespace scanout::app {

// The option of one of the commands that the whole word spells, `-o` or `--output`; null: none.
const Option* find_option(std::string_view word, unsigned commands);

// Is its value the next word, where none is glued on?
bool takes_next_word(const Option& option);

// "; did you mean '--samples'?", or where help is to be found.
std::string hint_for_option(std::string_view word, unsigned commands);

} // namespace scanout::app
