// Input events of keyboard and mouse, as the machine reports them; app binds them to actions.
#pragma once

#include "base/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scanout::port {

enum class EventKind : std::uint8_t { key, motion, motion_absolute, button, scroll, quit, suspend };
enum class Button : std::uint8_t { left, middle, right, side, extra };

struct Event {
    EventKind kind{};
    std::int64_t time_ns = 0; // when it happened, CLOCK_MONOTONIC; 0: not known
    // key: the keysym (xkbcommon's number, layout and Shift applied), its unshifted keysym, the
    // evdev code, and the modifiers that were held.
    std::uint32_t keysym = 0, base_keysym = 0, keycode = 0;
    bool pressed = false, shift = false, control = false, alt = false;
    bool repeats = false; // key: the layout lets this key repeat (app makes the repeats itself)
    // motion: unaccelerated device units; motion_absolute: 0 to 1 of the screen.
    double x = 0, y = 0;
    Button button{};
    int scroll = 0; // 120 a wheel notch, positive towards the user (as libinput reports it)
};

class Input {
public:
    virtual ~Input() = default;
    virtual int event_fd() const = 0; // -1: none
    // Appends what happened since the last call.
    virtual Result<void> dispatch(std::vector<Event>& events) = 0;
    virtual std::string description() const = 0; // "libinput (udev), 2 devices"
};

} // namespace scanout::port
