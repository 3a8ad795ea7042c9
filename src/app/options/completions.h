// Completions of command lines for shells, of the table of options.
#pragma once

#include <string>

namespace scanout::app {

std::string bash_completions(); // to be sourced
std::string zsh_completions();  // a file _scanout of fpath
std::string fish_completions(); // a file scanout.fish

} // namespace scanout::app
