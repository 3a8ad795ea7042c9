#include "app/view/rung_stepper.h"

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

measure::KnownFrontier frontier(bool with_own) {
    measure::KnownFrontier f;
    f.date = "2026-11-29";
    f.points = {{{{"aa", "none"}}, 2, 2, 8},
                {{{"aa", "samples_2"}}, 4, 4, 4},
                {{{"aa", "samples_8"}}, 9, 9, 2},
                {{{"aa", "area"}}, 40, 40, 0.5}};
    if (with_own) f.points[2].rungs.clear();
    return f;
}

TEST(RungStepper, StepsWaitUntilThereIsAFrontier) {
    RungStepper rungs;
    EXPECT_FALSE(rungs.wants_frontier());
    EXPECT_EQ(rungs.point(), nullptr);
    EXPECT_TRUE(rungs.step(-1));
    EXPECT_TRUE(rungs.step(-1));
    EXPECT_TRUE(rungs.step(1));
    EXPECT_TRUE(rungs.wants_frontier());
    rungs.put(frontier(true), 1);
    EXPECT_FALSE(rungs.wants_frontier());
    EXPECT_EQ(rungs.at(), 1U) << "one quicker than what is asked for, whatever the budget";
    EXPECT_EQ(rungs.point()->rungs[0].technique, "samples_2");
}

TEST(RungStepper, BeginsWithinTheBudgetWhereWhatIsAskedForIsNotOnTheFrontier) {
    for (const auto& [budget, at] : {std::pair(16.0, 2U), {5.0, 1U}, {1.0, 0U}, {100.0, 3U}}) {
        RungStepper rungs;
        rungs.step(1);
        rungs.step(-1);
        rungs.put(frontier(false), budget);
        EXPECT_EQ(rungs.at(), at) << budget;
    }
}

TEST(RungStepper, StopsAtTheEndsAndSaysSo) {
    RungStepper rungs;
    rungs.step(-1);
    rungs.put(frontier(true), 16);
    EXPECT_TRUE(rungs.step(-1));
    EXPECT_EQ(rungs.at(), 0U);
    EXPECT_FALSE(rungs.step(-1));
    EXPECT_EQ(rungs.at(), 0U);
    for (int i = 0; i < 3; ++i)
        EXPECT_TRUE(rungs.step(1));
    EXPECT_FALSE(rungs.step(1));
    EXPECT_EQ(rungs.at(), 3U);
}

TEST(RungStepper, AnotherModelHasNoneAndWhatCannotBeHadIsForgotten) {
    RungStepper rungs;
    rungs.step(1);
    rungs.give_up();
    EXPECT_FALSE(rungs.wants_frontier());
    rungs.step(1);
    EXPECT_TRUE(rungs.wants_frontier()) << "asked for again";
    rungs.put(frontier(true), 16);
    EXPECT_EQ(rungs.at(), 3U) << "one step, not two";
    rungs.clear();
    EXPECT_EQ(rungs.point(), nullptr);
    EXPECT_FALSE(rungs.wants_frontier());
}

} // namespace
} // namespace scanout::app
