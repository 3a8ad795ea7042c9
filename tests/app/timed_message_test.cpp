#include "app/view/timed_message.h"

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

TEST(TimedMessage, HidesAtItsStepAndNotBefore) {
    TimedMessage message;
    EXPECT_FALSE(message.next_step());
    message.show("wrote a.png", 30);
    EXPECT_EQ(message.next_step(), 30);
    message.advance_to(29);
    EXPECT_EQ(message.text(), "wrote a.png");
    message.advance_to(30);
    EXPECT_EQ(message.text(), "");
    EXPECT_FALSE(message.next_step()) << "the clock may stand still";
}

TEST(TimedMessage, ANewMessageHasItsOwnTime) {
    TimedMessage message;
    message.show("first", 30);
    message.show("second", 50);
    message.advance_to(40);
    EXPECT_EQ(message.text(), "second");
    message.hide();
    EXPECT_FALSE(message.next_step());
}

} // namespace
} // namespace scanout::app
