// Keys from the terminal, where no input device can be opened: bytes and escape sequences -> key
// events. There is no key release and no mouse; Ctrl-C and Ctrl-Z arrive as signals, so that they
// work whatever else fails.
#pragma once

#include "platform/console_input.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::console {

// The keys for `bytes`, which were read at once from a terminal: each is a press and its release.
// Understands the escape sequences of the Linux console and of xterm; drops unknown ones.
std::vector<port::Event> keys_of(std::string_view bytes);

// Reads our own terminal, one key at a time and without echo; the destructor restores it. Fails
// (Exit::no_display) when there is none or it belongs to another job.
Result<std::unique_ptr<ConsoleInput>> open_terminal();

} // namespace scanout::console
