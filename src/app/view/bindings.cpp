#include "app/view/bindings.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <xkbcommon/xkbcommon-keysyms.h>

namespace scanout::app {
namespace {

constexpr int kScrollUnitsPerNotch = 120;
constexpr int kZoomLevelsPerNotch = 8;

} // namespace

std::optional<ActionId> bound_to(const port::Event& event, bool flying) {
    static const KeyMap keys = KeyMap::standard();
    return keys.find(event, flying);
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

Binder::Binder(int width, int height, bool moves_pointer, KeyMap keys)
    : width_(width), height_(height), moves_pointer_(moves_pointer), keys_(std::move(keys)),
      x_(std::floor(width * 0.5)), y_(std::floor(height * 0.5)) {}

void Binder::resize(int width, int height) {
    x_ = std::floor(x_ * width / width_);
    y_ = std::floor(y_ * height / height_);
    width_ = width;
    height_ = height;
}

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
    const std::optional<ActionId> action = keys_.find(event, flies_);
    if (!action) return;
    actions.push_back({*action, {}, {}, false});
    held_.reset();
    if (event.repeats && row_of(*action).repeats)
        held_ = Held{*action, event.keycode,
                     step + (is_flying(*action) ? kFlySteps : kRepeatDelaySteps), 0};
}

std::optional<std::int64_t> Binder::next_repeat() const {
    if (!held_) return std::nullopt;
    // 60 steps a second are not a multiple of 25: repeat k is due at the first step at or after k /
    // 25 s.
    constexpr int kStepsTimes = 60;
    if (is_flying(held_->id)) return held_->first_step + std::int64_t{held_->count} * kFlySteps;
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
    const std::optional<ActionId> drag =
        keys_.drag(event.button, shift_ || event.shift, control_ || event.control);
    if (button_ || !drag) return;
    drag_ = *drag;
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
