// The seat through libseat: seatd, logind, or libseat's built-in server when we are root.
#pragma once

#include "platform/console.h"
#include "platform/seat.h"

#include <memory>
#include <optional>

namespace scanout::console {

// `console`: the VT that libseat will take, when we may open it; moved from on success. Fails
// (Exit::no_display) when no server gives us an active seat within two seconds.
Result<std::unique_ptr<Seat>> open_libseat(std::optional<Console>& console);

} // namespace scanout::console
