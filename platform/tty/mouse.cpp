#include "platform/tty/mouse.h"

#include <algorithm>
#include <charconv>
#include <optional>

namespace scanout::tty {
namespace {

// The bits of a report's first number.
constexpr int kShift = 4, kAlt = 8, kControl = 16, kMotion = 32, kWheel = 64, kExtra = 128;
constexpr int kNotch = 120; // port::Event

struct Report {
    int code = 0;
    double x = 0, y = 0;
    bool pressed = false;
};

std::optional<Report> report_of(std::string_view text) {
    if (text.size() < 7 || text.front() != '<' || (text.back() != 'M' && text.back() != 'm'))
        return std::nullopt;
    int numbers[3] = {0, 0, 0};
    const char* at = text.data() + 1;
    const char* const end = text.data() + text.size() - 1;
    for (int& number : numbers) {
        const auto read = std::from_chars(at, end, number);
        if (read.ec != std::errc()) return std::nullopt;
        at = std::min(read.ptr + 1, end);
    }
    return Report{numbers[0], numbers[1] - 1.0, numbers[2] - 1.0, text.back() == 'M'};
}

std::optional<port::Button> button_of(int code) {
    if ((code & kExtra) != 0)
        return (code & 3) < 2
                   ? std::optional((code & 3) == 0 ? port::Button::side : port::Button::extra)
                   : std::nullopt;
    switch (code & 3) {
    case 0:
        return port::Button::left;
    case 1:
        return port::Button::middle;
    case 2:
        return port::Button::right;
    default:
        return std::nullopt;
    }
}

} // namespace

void add_mouse(std::string_view sequence, double width, double height, double centre,
               std::vector<port::Event>& events) {
    const std::optional<Report> report = report_of(sequence);
    if (!report) return;
    port::Event event;
    event.shift = (report->code & kShift) != 0;
    event.alt = (report->code & kAlt) != 0;
    event.control = (report->code & kControl) != 0;
    event.kind = port::EventKind::motion_absolute;
    event.x = std::clamp((report->x + centre) / width, 0.0, 1.0);
    event.y = std::clamp((report->y + centre) / height, 0.0, 1.0);
    events.push_back(event);
    if ((report->code & kMotion) != 0) return;
    if ((report->code & kWheel) != 0) {
        if ((report->code & 3) > 1) return; // to the sides
        event.kind = port::EventKind::scroll;
        event.scroll = (report->code & 1) != 0 ? kNotch : -kNotch;
        events.push_back(event);
        return;
    }
    const std::optional<port::Button> button = button_of(report->code);
    if (!button) return;
    event.kind = port::EventKind::button;
    event.button = *button;
    event.pressed = report->pressed;
    events.push_back(event);
}

} // namespace scanout::tty
