#include "app/view/bindings.h"

#include <map>

#include <gtest/gtest.h>
#include <xkbcommon/xkbcommon-keysyms.h>

namespace scanout::app {
namespace {

using Id = ActionId;

port::Event key_event(std::uint32_t keysym, bool shift = false, bool control = false,
                      std::uint32_t base = 0) {
    port::Event event;
    event.kind = port::EventKind::key;
    event.keysym = keysym;
    event.base_keysym = base != 0 ? base : keysym;
    event.keycode = event.base_keysym;
    event.pressed = true;
    event.shift = shift;
    event.control = control;
    event.repeats = true;
    return event;
}

port::Event mouse(port::EventKind kind, double x, double y) {
    port::Event event;
    event.kind = kind;
    event.x = x;
    event.y = y;
    return event;
}

port::Event button(port::Button which, bool pressed) {
    port::Event event;
    event.kind = port::EventKind::button;
    event.button = which;
    event.pressed = pressed;
    return event;
}

port::Event scroll(int units) {
    port::Event event;
    event.kind = port::EventKind::scroll;
    event.scroll = units;
    return event;
}

struct Hand {
    Binder binder{640, 480, true};
    std::vector<Action> feed(std::vector<port::Event> events, std::int64_t step = 0) {
        std::vector<Action> actions;
        binder.bind(events, step, actions);
        return actions;
    }
};

// The keys are a promise to who uses them: a change here is a change of the product.
TEST(Bindings, TheKeysAreThoseOfTheDesign) {
    const std::map<std::string, std::string> kDesign = {{"Left", "rotate_left"},
                                                        {"Right", "rotate_right"},
                                                        {"Up", "rotate_up"},
                                                        {"Down", "rotate_down"},
                                                        {"Shift+Left", "move_left"},
                                                        {"Shift+Right", "move_right"},
                                                        {"Shift+Up", "move_up"},
                                                        {"Shift+Down", "move_down"},
                                                        {"PageUp", "previous_file"},
                                                        {"PageDown", "next_file"},
                                                        {"+", "scale_up"},
                                                        {"-", "scale_down"},
                                                        {"[", "roll_left"},
                                                        {"]", "roll_right"},
                                                        {"Home", "reset"},
                                                        {"R", "reset"},
                                                        {"O", "toggle_drive"},
                                                        {"1", "view_front"},
                                                        {"3", "view_right"},
                                                        {"7", "view_top"},
                                                        {"9", "view_iso"},
                                                        {"Ctrl+1", "view_back"},
                                                        {"Ctrl+3", "view_left"},
                                                        {"Ctrl+7", "view_bottom"},
                                                        {"Ctrl+9", "view_iso_back"},
                                                        {"5", "toggle_projection"},
                                                        {"Y", "up_axis_next"},
                                                        {"C", "cull_next"},
                                                        {"M", "colour_next"},
                                                        {"J", "section_next"},
                                                        {"Shift+J", "section_flip"},
                                                        {"{", "section_down"},
                                                        {"}", "section_up"},
                                                        {"E", "edges_next"},
                                                        {"P", "toggle_points"},
                                                        {"N", "toggle_normals"},
                                                        {"B", "toggle_box"},
                                                        {"G", "toggle_grid"},
                                                        {"A", "toggle_axes"},
                                                        {"I", "toggle_info"},
                                                        {"X", "toggle_explain"},
                                                        {"V", "toggle_error_map"},
                                                        {"Shift+I", "toggle_warnings"},
                                                        {"F2", "shading_next"},
                                                        {"Shift+F2", "shading_previous"},
                                                        {"F3", "aa_next"},
                                                        {"F4", "texture_next"},
                                                        {"F6", "shadow_next"},
                                                        {"F7", "exposure_up"},
                                                        {"F8", "tone_next"},
                                                        {"F9", "background_next"},
                                                        {"F10", "ambient_occlusion_next"},
                                                        {"Ctrl+Up", "move_far"},
                                                        {"Z", "scale_axis_next"},
                                                        {"W", "toggle_fly"},
                                                        {"Tab", "toggle_fly"},
                                                        {",", "rung_down"},
                                                        {".", "rung_up"},
                                                        {"/", "toggle_split"},
                                                        {"<", "split_left"},
                                                        {">", "split_right"},
                                                        {"Space", "toggle_turntable"},
                                                        {"U", "undo"},
                                                        {"F5", "reload"},
                                                        {"S", "screenshot"},
                                                        {"F12", "screenshot"},
                                                        {"H", "toggle_help"},
                                                        {"?", "toggle_help"},
                                                        {"Escape", "close"},
                                                        {"Q", "quit"},
                                                        {"Ctrl+C", "quit"},
                                                        {"Ctrl+Z", "suspend"}};
    for (const auto& [text, name] : kDesign) {
        const std::optional<Key> key = parse_key(text);
        ASSERT_TRUE(key) << text;
        const auto action = bound_to(key_event(key->keysym, key->shift, key->control));
        ASSERT_TRUE(action) << text;
        EXPECT_EQ(row_of(*action).name, name) << text;
    }
}

TEST(Bindings, NoKeyIsBoundTwiceAndEveryKeyCanBeSpelt) {
    std::map<std::tuple<std::uint32_t, bool, bool, bool>, std::string_view> seen;
    for (const ActionRow& row : action_rows()) {
        std::string_view rest = row.keys;
        while (!rest.empty()) {
            const std::size_t end = std::min(rest.find(' '), rest.size());
            const std::optional<Key> key = parse_key(rest.substr(0, end));
            ASSERT_TRUE(key) << rest;
            EXPECT_TRUE(
                seen.emplace(std::tuple(key->keysym, key->shift, key->control, is_flying(row.id)),
                             row.name)
                    .second)
                << rest.substr(0, end) << " of " << row.name;
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    }
    EXPECT_GT(seen.size(), 40U);
}

TEST(Bindings, LayoutAndCapsLockDoNotMatter) {
    EXPECT_EQ(bound_to(key_event(XKB_KEY_plus, true, false, XKB_KEY_equal)), Id::scale_up)
        << "US: Shift and =";
    EXPECT_EQ(bound_to(key_event(XKB_KEY_plus)), Id::scale_up) << "German: a key of its own";
    EXPECT_EQ(bound_to(key_event(XKB_KEY_1, true, false, XKB_KEY_ampersand)), Id::view_front)
        << "French: Shift and &";
    EXPECT_EQ(bound_to(key_event(XKB_KEY_H, false, false, XKB_KEY_h)), Id::toggle_help)
        << "Caps Lock";
    EXPECT_EQ(bound_to(key_event(XKB_KEY_question, true, false, XKB_KEY_slash)), Id::toggle_help);
    EXPECT_EQ(bound_to(key_event(XKB_KEY_Left, true)), Id::move_left);
    EXPECT_EQ(bound_to(key_event(XKB_KEY_0)), std::nullopt);
    EXPECT_EQ(bound_to(key_event(XKB_KEY_c, false, true)), Id::quit);
    EXPECT_EQ(bound_to(key_event(XKB_KEY_c)), Id::cull_next);
}

TEST(Binder, AHeldKeyRepeatsAfterSixHundredMillisecondsTwentyFiveTimesASecond) {
    Hand hand;
    EXPECT_EQ(hand.feed({key_event(XKB_KEY_Left)}, 100).size(), 1U);
    std::vector<std::int64_t> steps;
    for (std::int64_t step = 101; step <= 100 + 36 + 120; ++step)
        while (const auto repeat = hand.binder.repeat(step)) {
            EXPECT_EQ(repeat->id, Id::rotate_left);
            EXPECT_TRUE(repeat->repeated);
            steps.push_back(step);
        }
    ASSERT_EQ(steps.size(), 51U); // 2 seconds, both ends included
    EXPECT_EQ(steps.front(), 136);
    EXPECT_EQ(steps[25], 196);
    EXPECT_EQ(steps[50], 256);
}

TEST(Binder, ARepeatEndsWithTheReleaseAndWithAnotherKey) {
    Hand hand;
    hand.feed({key_event(XKB_KEY_Left)});
    port::Event release = key_event(XKB_KEY_Left);
    release.pressed = false;
    hand.binder.let_go(std::vector{release});
    EXPECT_FALSE(hand.binder.next_repeat());
    hand.feed({key_event(XKB_KEY_Left)});
    hand.feed({key_event(XKB_KEY_h)});
    EXPECT_FALSE(hand.binder.next_repeat()) << "help does not repeat";
    hand.feed({key_event(XKB_KEY_Left)});
    std::vector<Action> actions;
    hand.binder.release_all(actions);
    EXPECT_FALSE(hand.binder.next_repeat());
}

TEST(Binder, MotionsThatFollowEachOtherBecomeOneAndDragsCountFromThePress) {
    Hand hand;
    const auto drag =
        hand.feed({button(port::Button::left, true), mouse(port::EventKind::motion, 3, 4),
                   mouse(port::EventKind::motion, 7, -14), button(port::Button::left, false)});
    ASSERT_EQ(drag.size(), 4U);
    EXPECT_EQ(drag[0].id, Id::drag_begin);
    EXPECT_EQ(drag[1], (Action{Id::drag_rotate, {10, -10, 0}, {}, false}));
    EXPECT_EQ(drag[2], (Action{Id::pointer, {330, 230, 0}, {}, false}));
    EXPECT_EQ(drag[3].id, Id::drag_end);
}

TEST(Binder, TheModifierChoosesTheDrag) {
    const auto drag_with = [](std::vector<port::Event> first, port::Button which) {
        Hand hand;
        first.push_back(button(which, true));
        first.push_back(mouse(port::EventKind::motion, 1, 1));
        return hand.feed(first)[1].id;
    };
    EXPECT_EQ(drag_with({}, port::Button::left), Id::drag_rotate);
    EXPECT_EQ(drag_with({}, port::Button::middle), Id::drag_move);
    EXPECT_EQ(drag_with({key_event(XKB_KEY_Shift_L)}, port::Button::left), Id::drag_move);
    EXPECT_EQ(drag_with({key_event(XKB_KEY_Control_R)}, port::Button::left), Id::drag_roll);
}

TEST(Binder, ThePointerStaysOnThePictureButADragGoesOn) {
    Hand hand;
    hand.feed({button(port::Button::left, true)});
    const auto far = hand.feed({mouse(port::EventKind::motion, 5000, -5000)});
    EXPECT_EQ(far[0].numbers, (std::array<int, 3>{5000, -5000, 0}));
    EXPECT_EQ(far[1].numbers, (std::array<int, 3>{639, 0, 0}));
}

TEST(Binder, AbsoluteDevicesPointWhereTheySay) {
    Hand hand;
    const auto actions = hand.feed({mouse(port::EventKind::motion_absolute, 0.25, 0.75)});
    ASSERT_EQ(actions.size(), 1U);
    EXPECT_EQ(actions[0].numbers, (std::array<int, 3>{160, 360, 0}));
}

TEST(Binder, ANotchIsEightLevelsAndFractionsAddUp) {
    Hand hand;
    EXPECT_EQ(hand.feed({scroll(-120)})[0].numbers, (std::array<int, 3>{8, 320, 240}));
    EXPECT_EQ(hand.feed({scroll(120)})[0].numbers[0], -8);
    int levels = 0;
    for (int i = 0; i < 120; ++i)
        for (const Action& action : hand.feed({scroll(-1)}))
            levels += action.numbers[0];
    EXPECT_EQ(levels, 8);
}

} // namespace
} // namespace scanout::app
