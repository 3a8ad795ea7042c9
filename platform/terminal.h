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

// The keys that `bytes`, read at once from a terminal, stand for: each a press and its release.
// Escape sequences are those of the Linux console and of xterm; unknown ones are dropped.
std::vector<port::Event> keys_of(std::string_view bytes);

// Reads our own terminal, one key at a time and without echo; the destructor restores it. Fails
// (Exit::no_display) when there is none or it belongs to another job.
Result<std::unique_ptr<ConsoleInput>> open_terminal();

} // namespace scanout::console
