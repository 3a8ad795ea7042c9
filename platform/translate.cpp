#include "platform/translate.h"

#include <algorithm>

#include <linux/input-event-codes.h>
#include <xkbcommon/xkbcommon-keysyms.h>

namespace scanout::console {

std::optional<port::Button> button_of(std::uint32_t evdev_code) {
    switch (evdev_code) {
    case BTN_LEFT:
        return port::Button::left;
    case BTN_MIDDLE:
        return port::Button::middle;
    case BTN_RIGHT:
        return port::Button::right;
    case BTN_SIDE:
        return port::Button::side;
    case BTN_EXTRA:
        return port::Button::extra;
    default:
        return std::nullopt;
    }
}

port::Event motion(double dx, double dy) {
    port::Event event;
    event.kind = port::EventKind::motion;
    event.x = dx;
    event.y = dy;
    return event;
}

port::Event motion_absolute(double x, double y) {
    port::Event event;
    event.kind = port::EventKind::motion_absolute;
    event.x = std::clamp(x, 0.0, 1.0);
    event.y = std::clamp(y, 0.0, 1.0);
    return event;
}

port::Event button(port::Button button, bool pressed) {
    port::Event event;
    event.kind = port::EventKind::button;
    event.button = button;
    event.pressed = pressed;
    return event;
}

std::optional<port::Event> Scroll::wheel(double v120) {
    if ((v120 > 0) != (rest_ > 0)) rest_ = 0;
    // A device that reports nonsense cannot overflow the conversion below.
    rest_ = std::clamp(rest_ + v120, -1e6, 1e6);
    const int whole = static_cast<int>(rest_);
    if (whole == 0) return std::nullopt;
    rest_ -= whole;
    port::Event event;
    event.kind = port::EventKind::scroll;
    event.scroll = whole;
    return event;
}

std::optional<int> console_switch(const port::Event& event) {
    if (event.kind != port::EventKind::key || !event.pressed) return std::nullopt;
    if (event.keysym >= XKB_KEY_XF86Switch_VT_1 && event.keysym <= XKB_KEY_XF86Switch_VT_12)
        return static_cast<int>(event.keysym - XKB_KEY_XF86Switch_VT_1) + 1;
    if (event.control && event.alt && event.base_keysym >= XKB_KEY_F1 &&
        event.base_keysym <= XKB_KEY_F12)
        return static_cast<int>(event.base_keysym - XKB_KEY_F1) + 1;
    return std::nullopt;
}

} // namespace scanout::console
