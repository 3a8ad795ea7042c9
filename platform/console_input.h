// An input of the console's session: it stops and starts with the seat.
#pragma once

#include "port/input.h"

#include <vector>

namespace scanout::console {

class ConsoleInput : public port::Input {
public:
    // The console goes away: devices are closed, and the releases of held keys and buttons are
    // appended, so that nothing stays pressed.
    virtual Result<void> pause(std::vector<port::Event>& events) = 0;
    virtual Result<void> resume() = 0;
};

} // namespace scanout::console
