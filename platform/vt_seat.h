// The seat without a seat server: one virtual terminal and the kernel's own protocol for switching
// it (VT_PROCESS), for a user who may open the devices.
#pragma once

#include "platform/console.h"
#include "platform/seat.h"

#include <memory>

namespace scanout::console {

// `console` is moved from on success. Fails (Exit::no_display) when its modes may not be changed.
// Blocks two real-time signals in the calling thread: call before any thread exists.
Result<std::unique_ptr<Seat>> open_vt_seat(Console& console);

} // namespace scanout::console
