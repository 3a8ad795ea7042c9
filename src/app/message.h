// All lines that the program prints for its user go through here: file names and the contents of
// files must not control the user's terminal.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace scanout::app {

// `text` with each byte that is not part of a printable character as \xHH: control characters,
// marks that change the writing direction, and invalid UTF-8.
std::string escaped(std::string_view text);

// Without blanks, tabs and carriage returns at both ends.
std::string_view trimmed(std::string_view text);

// Writes the line, escaped, with one write(2): lines of several processes do not mix.
void say(std::string_view line, std::FILE* to = stderr);

// Writes over the terminal's last line on standard error, without ending it; an empty one clears
// it.
void say_over(std::string_view line);

} // namespace scanout::app
