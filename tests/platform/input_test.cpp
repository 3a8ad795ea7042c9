// Devices and keys -> events.
#include "platform/keyboard.h"
#include "platform/libinput.h"
#include "platform/terminal.h"
#include "platform/translate.h"

#include <cstdlib>

#include <gtest/gtest.h>
#include <linux/input-event-codes.h>
#include <rapidcheck/gtest.h>
#include <signal.h>
#include <unistd.h>
#include <xkbcommon/xkbcommon-keysyms.h>

namespace scanout::console {
namespace {

Keyboard keyboard(const char* layout) {
    ::setenv("XKB_DEFAULT_LAYOUT", layout, 1);
    auto made = Keyboard::create();
    EXPECT_TRUE(made);
    return *std::move(made);
}

TEST(Keyboard, TellsTheKeysymOfTheLayoutAndTheUnshiftedOne) {
    Keyboard us = keyboard("us");
    const port::Event plain = us.key(KEY_1, true);
    EXPECT_EQ(plain.kind, port::EventKind::key);
    EXPECT_EQ(plain.keysym, std::uint32_t{XKB_KEY_1});
    EXPECT_EQ(plain.keycode, std::uint32_t{KEY_1});
    EXPECT_TRUE(plain.pressed);
    us.key(KEY_1, false);
    EXPECT_FALSE(us.key(KEY_LEFTSHIFT, true).shift) << "held until then: not yet";
    const port::Event shifted = us.key(KEY_1, true);
    EXPECT_EQ(shifted.keysym, std::uint32_t{XKB_KEY_exclam});
    EXPECT_EQ(shifted.base_keysym, std::uint32_t{XKB_KEY_1});
    EXPECT_TRUE(shifted.shift);
    EXPECT_FALSE(shifted.control);
    Keyboard german = keyboard("de");
    EXPECT_EQ(german.key(KEY_Y, true).keysym, std::uint32_t{XKB_KEY_z});
    EXPECT_EQ(german.layout(), "de");
}

TEST(Keyboard, ControlAndAltAreToldAsTheyAreHeldAndLetGo) {
    Keyboard us = keyboard("us");
    us.key(KEY_LEFTCTRL, true);
    us.key(KEY_LEFTALT, true);
    const port::Event both = us.key(KEY_C, true);
    EXPECT_TRUE(both.control);
    EXPECT_TRUE(both.alt);
    EXPECT_EQ(both.base_keysym, std::uint32_t{XKB_KEY_c});
    us.key(KEY_LEFTCTRL, false);
    EXPECT_FALSE(us.key(KEY_C, false).control);
    ASSERT_TRUE(us.reset());
    EXPECT_FALSE(us.key(KEY_C, true).alt) << "nothing is held after a reset";
}

TEST(Keyboard, LettersRepeatAndModifiersDoNot) {
    Keyboard us = keyboard("us");
    EXPECT_TRUE(us.key(KEY_A, true).repeats);
    EXPECT_TRUE(us.key(KEY_LEFT, true).repeats);
    EXPECT_FALSE(us.key(KEY_LEFTSHIFT, true).repeats);
}

TEST(Keyboard, ALayoutThatDoesNotExistBecomesUsAndSaysSo) {
    Keyboard fallback = keyboard("no-such-layout");
    EXPECT_EQ(fallback.key(KEY_Q, true).keysym, std::uint32_t{XKB_KEY_q});
    EXPECT_EQ(fallback.layout(), "us (XKB_DEFAULT_LAYOUT=no-such-layout cannot be used)");
}

TEST(Keyboard, EveryCodeADeviceCouldSendIsAnswered) {
    Keyboard us = keyboard("us");
    for (std::uint32_t code = 0; code < 0x300; ++code)
        for (const bool pressed : {true, false})
            EXPECT_EQ(us.key(code, pressed).keycode, code);
}

TEST(ConsoleSwitch, IsCtrlAltAndAFunctionKeyAndNothingElse) {
    Keyboard us = keyboard("us");
    EXPECT_EQ(console_switch(us.key(KEY_F3, true)), std::nullopt);
    us.key(KEY_F3, false);
    us.key(KEY_LEFTCTRL, true);
    EXPECT_EQ(console_switch(us.key(KEY_F3, true)), std::nullopt);
    us.key(KEY_F3, false);
    us.key(KEY_LEFTALT, true);
    EXPECT_EQ(console_switch(us.key(KEY_F3, true)), 3);
    EXPECT_EQ(console_switch(us.key(KEY_F3, false)), std::nullopt) << "presses only";
    EXPECT_EQ(console_switch(us.key(KEY_F12, true)), 12);
    EXPECT_EQ(console_switch(us.key(KEY_C, true)), std::nullopt);
    EXPECT_EQ(console_switch(motion(1, 2)), std::nullopt);
}

RC_GTEST_PROP(Scroll, loses_nothing_of_a_wheel_that_turns_one_way, ()) {
    Scroll scroll;
    double turned = 0;
    int told = 0;
    for (int i = *rc::gen::inRange(1, 200); i > 0; --i) {
        const double step = *rc::gen::inRange(1, 480) / 16.0;
        turned += step;
        if (const auto event = scroll.wheel(step)) {
            RC_ASSERT(event->kind == port::EventKind::scroll);
            told += event->scroll;
        }
    }
    RC_ASSERT(told == static_cast<int>(turned));
}

TEST(Scroll, ANotchIs120EitherWayAndATurnStartsAnew) {
    Scroll scroll;
    EXPECT_EQ(scroll.wheel(120)->scroll, 120);
    EXPECT_EQ(scroll.wheel(-120)->scroll, -120);
    EXPECT_EQ(scroll.wheel(-0.75), std::nullopt);
    EXPECT_EQ(scroll.wheel(0.5), std::nullopt);
    EXPECT_EQ(scroll.wheel(0.5)->scroll, 1);
    EXPECT_EQ(scroll.continuous(15)->scroll, 120) << "a notch is 15 of libinput's units";
    EXPECT_EQ(scroll.wheel(1e300)->scroll, 1000000) << "nonsense is cut, not overflowed";
}

TEST(Pointer, ButtonsAndPositionsAreTranslated) {
    EXPECT_EQ(button_of(BTN_LEFT), port::Button::left);
    EXPECT_EQ(button_of(BTN_MIDDLE), port::Button::middle);
    EXPECT_EQ(button_of(BTN_RIGHT), port::Button::right);
    EXPECT_EQ(button_of(BTN_TASK), std::nullopt);
    EXPECT_EQ(motion_absolute(1.5, -0.5).x, 1.0);
    EXPECT_EQ(motion_absolute(1.5, -0.5).y, 0.0);
    EXPECT_EQ(motion(-3, 7).x, -3.0);
}

TEST(DeviceFacts, ReadAsAList) {
    EXPECT_EQ(describe({.name = "QEMU Virtio Mouse",
                        .letters = false,
                        .motion = true,
                        .position = false,
                        .buttons = true,
                        .wheel = true,
                        .touch = false}),
              "QEMU Virtio Mouse (motion, buttons, wheel)");
    DeviceFacts power;
    power.name = "Power Button";
    EXPECT_EQ(describe(power), "Power Button (keys)");
}

// ---- Keys from the terminal

struct TypedKey {
    std::string bytes;
    std::uint32_t keysym;
    bool shift = false, control = false, alt = false;
};

TEST(TerminalKeys, BytesAndEscapeSequencesBecomeKeys) {
    const std::vector<TypedKey> keys{
        {"q", XKB_KEY_q},
        {"Q", XKB_KEY_Q, true},
        {"?", XKB_KEY_question},
        {"\x03", XKB_KEY_c, false, true},
        {"\x1b", XKB_KEY_Escape},
        {"\x1bx", XKB_KEY_x, false, false, true},
        {"\r", XKB_KEY_Return},
        {"\t", XKB_KEY_Tab},
        {"\x7f", XKB_KEY_BackSpace},
        {"\x1b[A", XKB_KEY_Up},
        {"\x1bOA", XKB_KEY_Up},
        {"\x1b[1;2D", XKB_KEY_Left, true},
        {"\x1b[1;5C", XKB_KEY_Right, false, true},
        {"\x1b[5~", XKB_KEY_Page_Up},
        {"\x1b[6;3~", XKB_KEY_Page_Down, false, false, true},
        {"\x1b[[A", XKB_KEY_F1},
        {"\x1bOP", XKB_KEY_F1},
        {"\x1b[15~", XKB_KEY_F5},
        {"\x1b[24~", XKB_KEY_F12},
    };
    std::string all;
    std::vector<port::Event> expected;
    for (const TypedKey& key : keys) {
        const auto events = keys_of(key.bytes);
        ASSERT_EQ(events.size(), 2U) << key.bytes.substr(1) << key.keysym;
        EXPECT_TRUE(events[0].pressed);
        EXPECT_FALSE(events[1].pressed);
        for (const port::Event& event : events) {
            EXPECT_EQ(event.keysym, key.keysym) << key.bytes.substr(1);
            EXPECT_EQ(event.shift, key.shift) << key.bytes.substr(1);
            EXPECT_EQ(event.control, key.control) << key.bytes.substr(1);
            EXPECT_EQ(event.alt, key.alt) << key.bytes.substr(1);
        }
        EXPECT_FALSE(events[0].repeats);
    }
    EXPECT_EQ(keys_of("Q")[0].base_keysym, std::uint32_t{XKB_KEY_q});
    EXPECT_EQ(keys_of("ab\x1b[A\x1b[Bc").size(), 10U) << "several at once";
    EXPECT_TRUE(keys_of("\x1b[99~").empty()) << "unknown sequences are dropped";
}

RC_GTEST_PROP(TerminalKeys, any_bytes_give_balanced_keys, (const std::string& bytes)) {
    const auto events = keys_of(bytes);
    RC_ASSERT(events.size() <= 2 * bytes.size());
    RC_ASSERT(events.size() % 2 == 0U);
    for (std::size_t i = 0; i < events.size(); ++i)
        RC_ASSERT(events[i].pressed == (i % 2 == 0));
}

} // namespace
} // namespace scanout::console
