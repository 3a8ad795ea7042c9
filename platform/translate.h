// Translates device events to the viewer's events. Needs no device.
#pragma once

#include "port/input.h"

#include <cstdint>
#include <optional>

namespace scanout::console {

// BTN_LEFT and so on; nothing for other buttons.
std::optional<port::Button> button_of(std::uint32_t evdev_code);

port::Event motion(double dx, double dy);
port::Event motion_absolute(double x, double y); // clamped to 0 to 1
port::Event button(port::Button button, bool pressed);

// Scrolling in 120ths of a wheel notch. High-resolution wheels and touchpads report fractions,
// which add up until a whole 120th is reached; a change of direction starts anew.
class Scroll {
public:
    std::optional<port::Event> wheel(double v120);
    // Touchpads: in libinput's units, of which a wheel notch has 15.
    std::optional<port::Event> continuous(double units) { return wheel(units * 8); }

private:
    double rest_ = 0;
};

// Ctrl-Alt-F1 to F12 (as the layout names it, or by its keys): the number of the console, else
// nothing. Presses only.
std::optional<int> console_switch(const port::Event& event);

} // namespace scanout::console
