// Keys and mouse -> actions: how a held key repeats, and how the mouse drags.
#pragma once

#include "app/keys/key_map.h"
#include "app/view/actions.h"
#include "port/input.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace scanout::app {

// By the table of actions.
std::optional<ActionId> bound_to(const port::Event& event, bool flying = false);

// `list keys`: one line an action.
std::string keys_text();

inline constexpr int kRepeatDelaySteps = 36; // 600 ms
inline constexpr int kRepeatsPerSecond = 25;
inline constexpr int kFlySteps = 2;         // from one repeat of a key that flies to the next
inline constexpr int kMaxRepeatsAtOnce = 8; // after a stall

// Turns the machine's events into actions. Keeps the held state: a key, a button, modifiers.
class Binder {
public:
    Binder(int width, int height, bool moves_pointer, KeyMap keys = KeyMap::standard());

    const KeyMap& keys() const { return keys_; }
    void resize(int width, int height); // of the picture
    // The camera flies, or does not: some keys mean something else.
    void set_flying(bool flies) { flies_ = flies; }

    // Appends the actions of a batch of events, in order. Successive motions become one.
    void bind(std::span<const port::Event> events, std::int64_t step, std::vector<Action>& actions);

    // The next step of a held key that repeats; let_go() releases it if the batch does.
    std::optional<std::int64_t> next_repeat() const;
    void let_go(std::span<const port::Event> events);
    // The repeats that are due at `step`, at most one.
    std::optional<Action> repeat(std::int64_t step);

    // Call when the console is lost, and the release events with it: releases everything held.
    void release_all(std::vector<Action>& actions);

private:
    struct Held {
        ActionId id{};
        std::uint32_t keycode = 0;
        std::int64_t first_step = 0; // of the first repeat
        int count = 0;               // repeats made so far
    };
    void key(const port::Event& event, std::int64_t step, std::vector<Action>& actions);
    void button(const port::Event& event, std::vector<Action>& actions);
    void motion(const port::Event& event);
    void scroll(const port::Event& event, std::vector<Action>& actions);
    void flush_motion(std::vector<Action>& actions);

    int width_, height_;
    bool moves_pointer_, flies_ = false;
    KeyMap keys_;
    bool shift_ = false, control_ = false;
    std::optional<Held> held_;
    double x_, y_;                   // the pointer, pixels
    double drag_x_ = 0, drag_y_ = 0; // since the button went down, not held at the picture's edge
    bool moved_ = false;
    std::optional<port::Button> button_;
    ActionId drag_ = ActionId::drag_rotate;
    int scroll_rest_ = 0;
};

} // namespace scanout::app
