#include "app/view/governor.h"
#include "support/random.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

const std::vector<double> kShares = {1, 9 / 16.0, 4 / 9.0, 1 / 4.0, 1 / 9.0, 1 / 16.0};
constexpr double kBudget = 16;

// A machine whose frames take fixed + full * share, somewhat disturbed.
struct Motion {
    explicit Motion(double budget_ms = kBudget) : governor(kShares, budget_ms) {}
    void frames(int count, double fixed, double full, double noise = 0) {
        for (int i = 0; i < count; ++i) {
            const int level = governor.level();
            last_ms = (fixed + full * kShares[static_cast<std::size_t>(level)]) *
                      (1 + noise * (2 * random.unit() - 1));
            over += last_ms > kBudget ? 1 : 0;
            governor.took(last_ms);
            changes += governor.level() != level ? 1 : 0;
        }
    }
    Governor governor;
    test::Random random{7};
    int changes = 0, over = 0;
    double last_ms = 0;
};

TEST(Governor, StaysAtTheBestWhereFramesFit) {
    Motion m;
    m.frames(10000, 1, 14, 0.05);
    EXPECT_EQ(m.changes, 0);
}

TEST(Governor, GoesDownToWhatFitsWithinFourFramesAndStays) {
    Motion m;
    m.frames(4, 0, 30);
    EXPECT_EQ(m.governor.level(), 2) << "30 ms times 4/9";
    m.frames(10000, 0, 30);
    EXPECT_EQ(m.changes, 1);
    EXPECT_EQ(m.over, 2);
}

TEST(Governor, ALateFrameNowAndThenChangesNothing) {
    Motion m;
    for (int i = 0; i < 100; ++i) {
        m.frames(20, 0, 14);
        m.frames(1, 0, 100);
    }
    EXPECT_EQ(m.changes, 0);
}

TEST(Governor, WithoutABudgetOrWithOneLevelItNeverMoves) {
    Motion none(0);
    none.frames(1000, 0, 500);
    EXPECT_EQ(none.changes, 0);
    Governor one({1}, kBudget);
    for (int i = 0; i < 100; ++i)
        one.took(500);
    EXPECT_EQ(one.level(), 0);
}

TEST(Governor, ComesBackToTheBestWhereTheLoadGoes) {
    for (const double fixed : {0.0, 4.0, 8.0}) {
        Motion m;
        m.frames(200, fixed, 60 - 2 * fixed);
        EXPECT_GT(m.governor.level(), 1) << fixed;
        EXPECT_LE(m.last_ms, kBudget);
        m.frames(60 * 10, fixed, 4);
        EXPECT_EQ(m.governor.level(), 0) << fixed << ": in ten seconds";
    }
}

// A time that no level changes, such as that of the geometry.
TEST(Governor, WhereLevelsDoNotHelpThePictureStaysAtItsBest) {
    Motion m;
    m.frames(1000, 40, 1);
    EXPECT_EQ(m.governor.level(), 0);
    EXPECT_LE(m.changes, 2) << "one try";
    m.governor.rest();
    m.frames(1000, 40, 1);
    EXPECT_LE(m.changes, 4);
}

// Frames of a busy machine take up to twice as long. Each level is over the budget.
TEST(Governor, DisturbancesDoNotHideWhatLevelsGain) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Motion m;
        m.random = test::Random(seed);
        m.frames(300, 60, 60, 0.33);
        EXPECT_GE(m.governor.level(), 4) << seed << ": 66.7 ms; the last level saves 3 more";
    }
}

// Worst loads: each level is just over the budget, and those below leave just enough room.
TEST(Governor, LevelsDoNotAlternate) {
    for (double full = 10; full < 400; full *= 1.03)
        for (const double fixed : {0.0, 3.0, 9.0, 14.0})
            for (const double noise : {0.0, 0.1, 0.25}) {
                Motion m;
                m.frames(60 * 60, fixed, full, noise);
                EXPECT_LE(m.changes, 20)
                    << "in a minute: " << fixed << " + " << full << ", " << noise;
                const int before = m.changes;
                m.frames(60 * 60, fixed, full, noise);
                EXPECT_LE(m.changes - before, 8) << "in the next";
            }
}

// The level above takes far more than the shares say, each time it is tried.
TEST(Governor, WhatDidNotHoldIsTriedEverMoreSeldom) {
    constexpr std::array kTimes = {30.0, 26.0, 20.0, 7.5, 4.0, 2.0};
    Governor governor(kShares, kBudget);
    std::array<int, 3> changes{};
    for (int minute = 0; minute < 3; ++minute)
        for (int frame = 0; frame < 60 * 60; ++frame) {
            const int level = governor.level();
            governor.took(kTimes[static_cast<std::size_t>(level)]);
            changes[static_cast<std::size_t>(minute)] += governor.level() != level ? 1 : 0;
        }
    EXPECT_LE(changes[0], 16);
    EXPECT_GE(changes[0], 5) << "it is tried";
    EXPECT_LE(changes[1], 4);
    EXPECT_LE(changes[2], 4);
}

TEST(Governor, MostFramesAreWithinTheBudgetWhereAnyLevelIs) {
    for (double full = 10; full < 200; full *= 1.1)
        for (const double fixed : {0.0, 5.0}) {
            if (fixed + full * kShares.back() > 0.9 * kBudget) continue; // none is
            Motion m;
            m.frames(60 * 30, fixed, full, 0.05);
            EXPECT_LE(m.over, 60 * 30 / 20) << fixed << " + " << full;
        }
}

TEST(Governor, TheNextMotionBeginsAtTheLastLevelThatHeld) {
    Motion m;
    m.frames(100, 0, 30);
    ASSERT_EQ(m.governor.level(), 2);
    m.governor.rest();
    EXPECT_EQ(m.governor.level(), 2);
    m.frames(100, 0, 30);
    EXPECT_EQ(m.over, 2) << "those of the first motion";
    EXPECT_EQ(m.changes, 1);
}

// It tried the level above, and the motion ended before that was known to hold.
TEST(Governor, AStepUpThatHasNotHeldIsTakenBackAtRest) {
    Motion m;
    m.frames(100, 0, 30);
    ASSERT_EQ(m.governor.level(), 2);
    while (m.governor.level() == 2)
        m.frames(1, 0, 10);
    ASSERT_EQ(m.governor.level(), 1);
    m.governor.rest();
    EXPECT_EQ(m.governor.level(), 2);
    while (m.governor.level() == 2)
        m.frames(1, 0, 10);
    m.frames(10, 0, 10);
    m.governor.rest();
    EXPECT_EQ(m.governor.level(), 1) << "it has held";
}

} // namespace
} // namespace scanout::app
