#include "app/view/script_player.h"

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

TEST(ScriptPlayer, GivesEachActionOnceItsStepHasCome) {
    ScriptPlayer player(*parse_script("scanout-actions 1\n2 rotate_left\nreset\n+3 quit\n", "s"));
    EXPECT_EQ(player.next_step(), 2);
    EXPECT_EQ(player.take_due(1), nullptr);
    EXPECT_EQ(player.take_due(4)->id, ActionId::rotate_left);
    EXPECT_EQ(player.take_due(4)->id, ActionId::reset);
    EXPECT_EQ(player.take_due(4), nullptr);
    EXPECT_EQ(player.next_step(), 5);
    EXPECT_EQ(player.take_due(5)->id, ActionId::quit);
    EXPECT_FALSE(player.next_step());
    EXPECT_EQ(player.take_due(1000), nullptr);
    EXPECT_TRUE(player.has_script());
}

TEST(ScriptPlayer, WithoutAScriptGivesNoAction) {
    ScriptPlayer player(std::nullopt);
    EXPECT_FALSE(player.has_script());
    EXPECT_FALSE(player.next_step());
    EXPECT_EQ(player.take_due(1000), nullptr);
}

} // namespace
} // namespace scanout::app
