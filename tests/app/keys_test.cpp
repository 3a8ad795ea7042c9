// Keys of a user's file and of presets.
#include "app/keys/keys_file.h"
#include "app/overlay/help_sheet.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <xkbcommon/xkbcommon-keysyms.h>

namespace scanout::app {
namespace {

using Id = ActionId;
using testing::HasSubstr;

port::Event pressed(std::string_view text) {
    const std::optional<Key> key = parse_key(text);
    EXPECT_TRUE(key) << text;
    port::Event event;
    event.kind = port::EventKind::key;
    event.keysym = event.base_keysym = key->keysym;
    event.shift = key->shift;
    event.control = key->control;
    event.pressed = true;
    return event;
}

std::string sheet_keys(const KeyMap& keys, std::string_view text) {
    for (const SheetSection& section : help_sheet({}, keys))
        for (const SheetRow& row : section.rows)
            if (row.text == text) return row.keys;
    return "";
}

TEST(KeysFile, GivesActionsOtherKeysAndTakesThemFromOthers) {
    KeyMap keys = KeyMap::standard();
    EXPECT_THAT(take_keys("# mine\n[keys]\n"
                          "rotate_left = \"A\"  # was: axes\n"
                          "screenshot = [ 'F12', \"Ctrl+P\" ]\n"
                          "quit = []\n",
                          "k.toml", keys),
                testing::IsEmpty());
    EXPECT_EQ(keys.find(pressed("A")), Id::rotate_left);
    EXPECT_EQ(keys.find(pressed("Left")), std::nullopt) << "its keys are those of the file";
    EXPECT_EQ(keys.find(pressed("Ctrl+P")), Id::screenshot);
    EXPECT_EQ(keys.find(pressed("S")), std::nullopt);
    EXPECT_EQ(keys.find(pressed("Q")), std::nullopt);
    EXPECT_EQ(keys.find(pressed("Right")), Id::rotate_right) << "all else stays";
}

TEST(KeysFile, TheHelpSheetNamesTheKeysInForce) {
    KeyMap keys = KeyMap::standard();
    EXPECT_EQ(sheet_keys(keys, "rotate"), "Arrows");
    EXPECT_EQ(sheet_keys(keys, "axes x y z:"), "A");
    take_keys("rotate_left = \"A\"\n", "k.toml", keys);
    EXPECT_EQ(sheet_keys(keys, "rotate"), "A Right Up Down");
    EXPECT_EQ(sheet_keys(keys, "axes x y z:"), "") << "no key is left for it";
}

TEST(KeysFile, ABadLineSaysWhereAndWhatAndItsDefaultStays) {
    for (const auto& [line, what] : std::vector<std::pair<std::string, std::string>>{
             {"rotate_lef = \"A\"", "there is no action 'rotate_lef'; did you mean 'rotate_left'?"},
             {"rotate_lef = \"A\"", "there are: rotate_left rotate_right"},
             {"drag_rotate = \"A\"", "there is no action 'drag_rotate'"},
             {"rotate_left = \"Wombat\"", "there is no key 'Wombat'"},
             {"rotate_left = A", "a key stands in quotes"},
             {"rotate_left = \"A", "a quote is not closed"},
             {"rotate_left = [\"A\"", "a list of keys ends with ]"},
             {"rotate_left = \"A\" \"B\"", "'\"B\"' is too much"},
             {"rotate_left", "an action and its keys are wanted"}}) {
        KeyMap keys = KeyMap::standard();
        const std::vector<std::string> faults = take_keys("undo = \"Z\"\n" + line, "k.toml", keys);
        ASSERT_EQ(faults.size(), 1U) << line;
        EXPECT_THAT(faults[0], HasSubstr("k.toml:2: "));
        EXPECT_THAT(faults[0], HasSubstr(what));
        EXPECT_EQ(keys.find(pressed("Left")), Id::rotate_left) << line;
        EXPECT_EQ(keys.find(pressed("Z")), Id::undo) << "the other lines count";
    }
}

TEST(KeysFile, ThatOfTheOptionCountsAfterThePresetAndMustBeThere) {
    const test::TemporaryFolder folder;
    Settings settings;
    settings.no_config = true;
    settings.nav = Nav::f3d;
    settings.keys = folder.write("keys.toml", "toggle_grid = \"X\"\nnonsense\n");
    const Result<UserKeys> keys = user_keys(settings);
    ASSERT_TRUE(keys);
    EXPECT_EQ(keys->map.find(pressed("X")), Id::toggle_grid);
    EXPECT_EQ(keys->map.find(pressed("Left")), Id::previous_file);
    ASSERT_EQ(keys->faults.size(), 1U);
    EXPECT_THAT(keys->faults[0], HasSubstr("keys.toml:2: "));
    settings.keys += ".not";
    EXPECT_FALSE(user_keys(settings));
}

TEST(Flying, HasKeysOfItsOwn) {
    const KeyMap keys = KeyMap::standard();
    EXPECT_EQ(keys.find(pressed("S")), Id::screenshot);
    EXPECT_EQ(keys.find(pressed("S"), true), Id::fly_back);
    EXPECT_EQ(keys.find(pressed("W")), Id::toggle_fly);
    EXPECT_EQ(keys.find(pressed("W"), true), Id::fly_forward);
    EXPECT_EQ(keys.find(pressed("Tab"), true), Id::toggle_fly);
    EXPECT_EQ(keys.find(pressed("Left"), true), Id::rotate_left);
}

TEST(Presets, HaveTheMouseAndTheKeysOfOtherViewers) {
    using port::Button;
    const auto drag = [](Nav nav, Button button, bool shift = false, bool control = false) {
        return KeyMap::of(nav).drag(button, shift, control);
    };
    EXPECT_EQ(drag(Nav::scanout, Button::left), Id::drag_rotate);
    EXPECT_EQ(drag(Nav::scanout, Button::left, true), Id::drag_move);
    EXPECT_EQ(drag(Nav::scanout, Button::left, true, true), Id::drag_move);
    EXPECT_EQ(drag(Nav::scanout, Button::left, false, true), Id::drag_roll);
    EXPECT_EQ(drag(Nav::scanout, Button::middle, false, true), Id::drag_move);
    EXPECT_EQ(drag(Nav::scanout, Button::side), std::nullopt);
    EXPECT_EQ(drag(Nav::blender, Button::middle), Id::drag_rotate);
    EXPECT_EQ(drag(Nav::blender, Button::middle, true), Id::drag_move);
    EXPECT_EQ(drag(Nav::blender, Button::middle, false, true), Id::drag_zoom);
    EXPECT_EQ(drag(Nav::blender, Button::left), std::nullopt);
    EXPECT_EQ(drag(Nav::f3d, Button::left), Id::drag_rotate);
    EXPECT_EQ(drag(Nav::f3d, Button::middle), Id::drag_move);
    EXPECT_EQ(drag(Nav::f3d, Button::right), Id::drag_zoom);
    EXPECT_EQ(KeyMap::of(Nav::blender).find(pressed("Home")), Id::fit);
    EXPECT_EQ(KeyMap::of(Nav::blender).find(pressed("KP4")), Id::rotate_left);
    EXPECT_EQ(KeyMap::of(Nav::f3d).find(pressed("Enter")), Id::reset);
    EXPECT_EQ(KeyMap::of(Nav::f3d).find(pressed("X")), Id::toggle_axes);
    EXPECT_EQ(sheet_keys(KeyMap::of(Nav::blender), "rotate"), "Left Right Up Down");
}

} // namespace
} // namespace scanout::app
