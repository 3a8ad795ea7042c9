#include "app/bindings.h"

#include "base/check.h"

#include <algorithm>
#include <cmath>

#include <xkbcommon/xkbcommon-keysyms.h>

namespace scanout::app {
namespace {

constexpr int kScrollUnitsPerNotch = 120;
constexpr int kZoomLevelsPerNotch = 8;

struct NamedKey {
    std::string_view name;
    std::uint32_t keysym;
};
constexpr std::array kNamedKeys = {
    NamedKey{"Left", XKB_KEY_Left},       NamedKey{"Right", XKB_KEY_Right},
    NamedKey{"Up", XKB_KEY_Up},           NamedKey{"Down", XKB_KEY_Down},
    NamedKey{"PageUp", XKB_KEY_Page_Up},  NamedKey{"PageDown", XKB_KEY_Page_Down},
    NamedKey{"Home", XKB_KEY_Home},       NamedKey{"Escape", XKB_KEY_Escape},
    NamedKey{"Space", XKB_KEY_space},     NamedKey{"F5", XKB_KEY_F5},
    NamedKey{"F12", XKB_KEY_F12},         NamedKey{"KP+", XKB_KEY_KP_Add},
    NamedKey{"KP-", XKB_KEY_KP_Subtract}, NamedKey{"KP1", XKB_KEY_KP_1},
    NamedKey{"KP3", XKB_KEY_KP_3},        NamedKey{"KP5", XKB_KEY_KP_5},
    NamedKey{"KP7", XKB_KEY_KP_7},        NamedKey{"KP9", XKB_KEY_KP_9},
};

struct Binding {
    Key key;
    ActionId action;
};

const std::vector<Binding>& bindings() {
    static const std::vector<Binding> all = [] {
        std::vector<Binding> made;
        for (const ActionRow& row : action_rows()) {
            std::string_view rest = row.keys;
            while (!rest.empty()) {
                const std::size_t end = std::min(rest.find(' '), rest.size());
                const std::optional<Key> key = parse_key(rest.substr(0, end));
                CHECK(key.has_value());
                made.push_back({*key, row.id});
                rest.remove_prefix(std::min(end + 1, rest.size()));
            }
        }
        return made;
    }();
    return all;
}

// Without NumLock, the keypad's digits are arrows and the like: the binding names the key by its
// place.
std::uint32_t without_num_lock(std::uint32_t keysym) {
    switch (keysym) {
    case XKB_KEY_KP_End:
        return XKB_KEY_KP_1;
    case XKB_KEY_KP_Page_Down:
        return XKB_KEY_KP_3;
    case XKB_KEY_KP_Begin:
        return XKB_KEY_KP_5;
    case XKB_KEY_KP_Home:
        return XKB_KEY_KP_7;
    case XKB_KEY_KP_Page_Up:
        return XKB_KEY_KP_9;
    default:
        return keysym;
    }
}

// The layout needed Shift to make this sign: the binding names the sign, not Shift.
bool is_shifted_sign(const port::Event& event) {
    const bool letter = (event.keysym >= XKB_KEY_a && event.keysym <= XKB_KEY_z) ||
                        (event.keysym >= XKB_KEY_A && event.keysym <= XKB_KEY_Z);
    return event.keysym != event.base_keysym && !letter;
}

} // namespace

std::optional<Key> parse_key(std::string_view text) {
    Key key;
    if (text.starts_with("Ctrl+")) {
        key.control = true;
        text.remove_prefix(5);
    }
    if (text.starts_with("Shift+")) {
        key.shift = true;
        text.remove_prefix(6);
    }
    for (const NamedKey& named : kNamedKeys)
        if (named.name == text) {
            key.keysym = named.keysym;
            return key;
        }
    // Printable ASCII: the keysym is the character's code.
    if (text.size() != 1 || text[0] <= ' ' || text[0] > '~') return std::nullopt;
    const char c = text[0];
    key.keysym = static_cast<std::uint32_t>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    return key;
}

std::optional<ActionId> bound_to(const port::Event& event) {
    if (event.alt) return std::nullopt;
    for (const Binding& binding : bindings()) {
        if (binding.key.control != event.control) continue;
        const bool sign = is_shifted_sign(event) && binding.key.keysym == event.keysym;
        const bool key = binding.key.keysym == without_num_lock(event.base_keysym) &&
                         binding.key.shift == event.shift;
        if (sign || key) return binding.action;
    }
    return std::nullopt;
}

std::string keys_text() {
    std::string text;
    for (const ActionRow& row : action_rows()) {
        const std::string_view keys = !row.keys.empty()    ? row.keys
                                      : !row.sheet.empty() ? row.sheet
                                                           : "(recordings)";
        text += fmt::format("{:<18} {:<18} {}\n", keys, row.name, row.help);
    }
    return text;
}

Binder::Binder(int width, int height, bool moves_pointer)
    : width_(width), height_(height), moves_pointer_(moves_pointer), x_(std::floor(width * 0.5)),
      y_(std::floor(height * 0.5)) {}

void Binder::bind(std::span<const port::Event> events, std::int64_t step,
                  std::vector<Action>& actions) {
    using port::EventKind;
    for (const port::Event& event : events) {
        if (event.kind != EventKind::motion && event.kind != EventKind::motion_absolute)
            flush_motion(actions);
        switch (event.kind) {
        case EventKind::key:
            key(event, step, actions);
            break;
        case EventKind::motion:
        case EventKind::motion_absolute:
            motion(event);
            break;
        case EventKind::button:
            button(event, actions);
            break;
        case EventKind::scroll:
            scroll(event, actions);
            break;
        case EventKind::quit:
            actions.push_back({ActionId::quit, {}, {}, false});
            break;
        case EventKind::suspend:
            actions.push_back({ActionId::suspend, {}, {}, false});
            break;
        }
    }
    flush_motion(actions);
}

void Binder::key(const port::Event& event, std::int64_t step, std::vector<Action>& actions) {
    if (event.base_keysym == XKB_KEY_Shift_L || event.base_keysym == XKB_KEY_Shift_R)
        shift_ = event.pressed;
    if (event.base_keysym == XKB_KEY_Control_L || event.base_keysym == XKB_KEY_Control_R)
        control_ = event.pressed;
    if (!event.pressed) {
        if (held_ && held_->keycode == event.keycode) held_.reset();
        return;
    }
    const std::optional<ActionId> action = bound_to(event);
    if (!action) return;
    actions.push_back({*action, {}, {}, false});
    held_.reset();
    if (event.repeats && row_of(*action).repeats)
        held_ = Held{*action, event.keycode, step + kRepeatDelaySteps, 0};
}

std::optional<std::int64_t> Binder::next_repeat() const {
    if (!held_) return std::nullopt;
    // 60 steps a second are not a multiple of 25: repeat k is due at the first step at or after k /
    // 25 s.
    constexpr int kStepsTimes = 60;
    return held_->first_step +
           (std::int64_t{held_->count} * kStepsTimes + kRepeatsPerSecond - 1) / kRepeatsPerSecond;
}

void Binder::let_go(std::span<const port::Event> events) {
    for (const port::Event& event : events)
        if (held_ && event.kind == port::EventKind::key && !event.pressed &&
            event.keycode == held_->keycode)
            held_.reset();
}

std::optional<Action> Binder::repeat(std::int64_t step) {
    if (!held_ || step < *next_repeat()) return std::nullopt;
    ++held_->count;
    return Action{held_->id, {}, {}, true};
}

void Binder::release_all(std::vector<Action>& actions) {
    held_.reset();
    shift_ = control_ = false;
    if (button_) actions.push_back({ActionId::drag_end, {}, {}, false});
    button_.reset();
}

void Binder::button(const port::Event& event, std::vector<Action>& actions) {
    if (!event.pressed) {
        if (button_ != event.button) return;
        button_.reset();
        actions.push_back({ActionId::drag_end, {}, {}, false});
        return;
    }
    const bool left = event.button == port::Button::left;
    if (button_ || (!left && event.button != port::Button::middle)) return;
    const bool shift = shift_ || event.shift, control = control_ || event.control;
    drag_ = !left || shift ? ActionId::drag_move
            : control      ? ActionId::drag_roll
                           : ActionId::drag_rotate;
    button_ = event.button;
    drag_x_ = drag_y_ = 0;
    actions.push_back({ActionId::drag_begin, {}, {}, false});
}

void Binder::motion(const port::Event& event) {
    const bool absolute = event.kind == port::EventKind::motion_absolute;
    const double dx = absolute ? event.x * width_ - x_ : event.x;
    const double dy = absolute ? event.y * height_ - y_ : event.y;
    if (!std::isfinite(dx) || !std::isfinite(dy)) return;
    constexpr double kMax = 1e6; // pixels: no hand drags further, and ints can hold it
    drag_x_ = std::clamp(drag_x_ + dx, -kMax, kMax);
    drag_y_ = std::clamp(drag_y_ + dy, -kMax, kMax);
    x_ = std::clamp(x_ + dx, 0.0, width_ - 1.0);
    y_ = std::clamp(y_ + dy, 0.0, height_ - 1.0);
    moved_ = true;
}

void Binder::flush_motion(std::vector<Action>& actions) {
    if (!moved_) return;
    moved_ = false;
    const auto whole = [](double v) { return static_cast<int>(std::floor(v + 0.5)); };
    if (button_) actions.push_back({drag_, {whole(drag_x_), whole(drag_y_)}, {}, false});
    if (moves_pointer_) actions.push_back({ActionId::pointer, {whole(x_), whole(y_)}, {}, false});
}

void Binder::scroll(const port::Event& event, std::vector<Action>& actions) {
    constexpr int kUnitsPerLevel = kScrollUnitsPerNotch / kZoomLevelsPerNotch;
    scroll_rest_ -= std::clamp(event.scroll, -100'000, 100'000); // away from the user: larger
    const int levels = scroll_rest_ / kUnitsPerLevel;
    scroll_rest_ -= levels * kUnitsPerLevel;
    if (levels != 0 && (shift_ || event.shift))
        actions.push_back({ActionId::slide_section, {levels}, {}, false});
    else if (levels != 0)
        actions.push_back(
            {ActionId::zoom_at, {levels, static_cast<int>(x_), static_cast<int>(y_)}, {}, false});
}

} // namespace scanout::app
