#include "app/frontier/budget.h"
#include "app/frontier/key.h"
#include "app/options/options.h"
#include "scene/content.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

#include <gmock/gmock.h>

namespace scanout::app {
namespace {

using testing::HasSubstr;

class Budget : public ::testing::Test {
protected:
    Budget() : shot(test::textured_cube("cube", "auto")), facts(frame::facts(shot.scene)) {
        view = *scene::make_view(shot.scene.mesh, shot.model, shot.pose, shot.camera, {},
                                 shot.options.width, shot.options.height);
    }
    Result<Chosen> choose(const measure::Limits& limits) {
        traced = 0;
        const auto progress = [&](std::string_view doing, double) {
            traced += doing == "tracing" ? 1 : 0;
        };
        return choose_rungs({shot.scene,
                             facts,
                             view,
                             shot.options,
                             {"aa", "texture"},
                             jobs,
                             max_memory_mb,
                             progress,
                             {},
                             time_now},
                            limits, &cache);
    }
    std::string key() {
        return frontier_key(scene::content_hash(shot.scene), view, shot.options, {"aa", "texture"},
                            jobs.threads());
    }
    test::Shot shot;
    frame::SceneFacts facts;
    scene::View view;
    Jobs jobs{2};
    test::TemporaryFolder folder;
    FrontierCache cache{folder.file("cache")};
    int traced = 0; // calls
    int max_memory_mb = 0;
    // A machine on which all times stay what they were.
    std::function<double(const frame::FramePlan&)> time_now = [this](const frame::FramePlan& plan) {
        const measure::KnownFrontier known = *cache.find(key());
        for (const measure::KnownPoint& p : known.points)
            if (frame::draws_alike(*frame::plan(measure::with(shot.options, p.rungs), facts, view),
                                   plan))
                return p.cpu_ms * slower;
        return 0.0;
    };
    double slower = 1;
};

TEST_F(Budget, IsMeasuredOnceAndThenRemembered) {
    const auto first = choose({1000, {}});
    ASSERT_TRUE(first) << first.error().what;
    EXPECT_FALSE(first->cached);
    EXPECT_GT(traced, 0);
    EXPECT_TRUE(first->choice.met());
    EXPECT_TRUE(first->notes.empty());
    const auto second = choose({1000, {}});
    ASSERT_TRUE(second);
    EXPECT_TRUE(second->cached);
    EXPECT_EQ(traced, 0);
    EXPECT_EQ(second->point, first->point);
    EXPECT_EQ(to_text(*second), to_text(*first) + ", cached");
    EXPECT_THAT(to_text(*second), HasSubstr("chosen for 1000 ms: "));
    // Another limit asks the same measurement.
    const auto third = choose({{}, first->point.error});
    EXPECT_TRUE(third->cached);
    EXPECT_EQ(third->point, first->point);
}

TEST_F(Budget, IsMeasuredAnewWhereTimesHaveChanged) {
    ASSERT_TRUE(choose({1000, {}}));
    for (const double holds : {1.0, kTimeHolds * 0.999, 1.001 / kTimeHolds}) {
        slower = holds;
        EXPECT_TRUE(choose({1000, {}})->cached) << holds;
    }
    for (const double differs : {kTimeHolds * 1.001, 0.999 / kTimeHolds, 0.0, 1e9}) {
        slower = differs;
        EXPECT_FALSE(choose({1000, {}})->cached) << differs;
        EXPECT_GT(traced, 0);
    }
}

// One moment may be slow.
TEST_F(Budget, IsTriedThreeTimes) {
    ASSERT_TRUE(choose({1000, {}}));
    const auto steady = time_now;
    int tries = 0;
    time_now = [&](const frame::FramePlan& plan) { return steady(plan) * (++tries < 3 ? 9 : 1); };
    EXPECT_TRUE(choose({1000, {}})->cached);
    EXPECT_EQ(tries, 3);
    tries = -1;
    EXPECT_FALSE(choose({1000, {}})->cached);
}

// The clock of this machine: what was measured holds at once, if not each time.
TEST_F(Budget, TimesOfThisMachineHold) {
    time_now = nullptr;
    bool cached = false;
    for (int i = 0; i < 10 && !cached; ++i)
        cached = choose({1000, {}})->cached;
    EXPECT_TRUE(cached);
}

TEST_F(Budget, IsRefusedWhereTheReferenceTakesMoreThanMaxMemory) {
    shot.options.width = shot.options.height = 400;
    max_memory_mb = 1;
    const auto chosen = choose({1000, {}});
    ASSERT_FALSE(chosen);
    EXPECT_THAT(chosen.error().what, HasSubstr("--max-memory is 1"));
    EXPECT_EQ(traced, 0);
}

TEST_F(Budget, ADamagedFileIsMeasuredAnew) {
    folder.write("cache", "x"); // no folder can be made there
    const auto chosen = choose({1000, {}});
    ASSERT_TRUE(chosen) << "a cache that cannot be written is no failure";
    EXPECT_THAT(chosen->notes, testing::ElementsAre(HasSubstr(folder.file("cache"))));
    std::filesystem::remove(folder.file("cache"));
    ASSERT_TRUE(choose({1000, {}}));
    std::ofstream(cache.file_of(key())) << "scanout-frontier 2\ngarbage";
    const auto again = choose({1000, {}});
    ASSERT_TRUE(again);
    EXPECT_FALSE(again->cached);
    EXPECT_TRUE(again->notes.empty());
    EXPECT_TRUE(choose({1000, {}})->cached);
}

TEST_F(Budget, SaysWhatThereIsWhereNothingMeetsIt) {
    const auto fast = choose({1e-6, {}});
    ASSERT_TRUE(fast);
    EXPECT_FALSE(fast->choice.met());
    EXPECT_THAT(fast->instead, testing::StartsWith("--budget "));
    EXPECT_THAT(fast->instead, HasSubstr("the fastest take "));
    EXPECT_THAT(fast->instead, HasSubstr(fast->point.options()));
    const auto fine = choose({{}, 0.0});
    EXPECT_THAT(fine->instead, testing::StartsWith("--max-error 0: "));
    EXPECT_THAT(fine->instead, HasSubstr("the most accurate err "));
    const measure::KnownFrontier known = *cache.find(key());
    ASSERT_GE(known.points.size(), 2U);
    const auto both = choose(
        {(known.points[0].wall_ms + known.points[1].wall_ms) / 2, known.points.back().error});
    EXPECT_FALSE(both->choice.met());
    EXPECT_THAT(both->instead, HasSubstr(", more than --budget "));
}

// What was left out for want of time may be what is asked for now.
TEST_F(Budget, WhatWasMeasuredInPartIsNoProofThatThereIsNothing) {
    ASSERT_TRUE(cache.keep(key(), {"2026-11-29", {{{}, 1, 1, 50}}, false}));
    EXPECT_TRUE(choose({1000, {}})->cached);
    const auto fine = choose({{}, 40.0});
    EXPECT_FALSE(fine->cached);
    EXPECT_TRUE(fine->choice.met());
    EXPECT_THAT(to_text(*choose({{}, 0.0})), testing::StartsWith("nearest to 0 codes RMSE: "));
}

double number_behind(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    EXPECT_NE(at, std::string::npos) << words << ": " << text;
    return at == std::string::npos ? 0 : std::stod(text.substr(at + words.size()));
}

// Asking for as much as the message says meets it, whatever it rounds.
TEST_F(Budget, AdviceHoldsWhereItIsFollowed) {
    for (const double odd : {0.001, 0.0949, 0.9948, 3.141, 9.996, 12.34, 1234.56}) {
        ASSERT_TRUE(cache.keep(key(), {"2026-11-29",
                                       {{{{"aa", "none"}}, odd, odd, 20 + odd},
                                        {{{"aa", "samples_4"}}, 2 * odd, 2 * odd, odd}}}));
        const std::string fast = choose({odd / 2, {}})->instead;
        EXPECT_TRUE(choose({number_behind(fast, "the fastest take "), {}})->choice.met()) << fast;
        const std::string fine = choose({{}, odd / 2})->instead;
        EXPECT_TRUE(choose({{}, number_behind(fine, "most accurate err ")})->choice.met()) << fine;
        const std::string both = choose({1.5 * odd, odd})->instead;
        const double takes = number_behind(both, " takes ");
        EXPECT_TRUE(choose({takes, odd})->choice.met()) << both;
    }
}

TEST_F(Budget, SaysWhatWasAskedForAsItWas) {
    ASSERT_TRUE(choose({1000, {}}));
    EXPECT_THAT(choose({0.001, {}})->instead, testing::StartsWith("--budget 0.001 ms: "));
    EXPECT_THAT(choose({1e-300 * 1000, {}})->instead, testing::StartsWith("--budget 1e-297 ms: "));
}

TEST_F(Budget, APictureWithoutReferenceIsRefused) {
    shot.options.convolution = "low_pass";
    const auto chosen = choose({1000, {}});
    ASSERT_FALSE(chosen);
    EXPECT_EQ(chosen.error().exit, Exit::usage);
}

// Whoever stops it, in the reference or among the rungs, is not kept waiting; nothing is kept.
TEST_F(Budget, StopsWhereItIsTold) {
    for (const int steps : {0, 1, 20}) {
        int asked = 0;
        bool traced_whole = false;
        const auto progress = [&](std::string_view doing, double) {
            traced_whole = traced_whole || doing == "measuring";
        };
        const auto stop = [&] { return asked++ >= steps; };
        const auto chosen = choose_rungs(
            {shot.scene, facts, view, shot.options, {"aa", "texture"}, jobs, 0, progress, stop},
            {1000, {}}, &cache);
        ASSERT_FALSE(chosen) << steps;
        EXPECT_EQ(chosen.error().exit, Exit::usage);
        EXPECT_LE(asked, steps + 4);
        EXPECT_FALSE(steps == 0 && traced_whole);
        EXPECT_FALSE(cache.find(key()));
    }
}

TEST_F(Budget, AxesThatAreNamedAreNotFree) {
    Settings s;
    EXPECT_THAT(free_axes(s), testing::IsSupersetOf({"aa", "texture", "shading"}));
    for (const Option& option : options()) {
        if (option.name == "samples" || option.name == "texture") {
            ASSERT_TRUE(apply(option, option.name == "samples" ? "1" : "auto", s));
        }
    }
    EXPECT_THAT(free_axes(s), testing::Not(testing::Contains("aa")));
    EXPECT_THAT(free_axes(s), testing::Not(testing::Contains("texture")));
    EXPECT_THAT(free_axes(s), testing::Contains("shading"));
}

} // namespace
} // namespace scanout::app
