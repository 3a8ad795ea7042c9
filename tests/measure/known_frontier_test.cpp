#include "measure/frontier_search.h"
#include "measure/known_frontier.h"
#include "support/random.h"
#include "support/scenes.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace scanout::measure {
namespace {

using test::Shot;

// Quickest first, as a frontier is.
std::vector<KnownPoint> ladder_of_four() {
    return {{{{"aa", "none"}}, 2, 3, 8},
            {{}, 4, 6, 4},
            {{{"aa", "samples_4"}}, 8, 12, 2},
            {{{"aa", "area"}}, 16, 24, 1}};
}

TEST(Choose, WithinATimeTheMostAccurateIsTaken) {
    const std::vector<KnownPoint> points = ladder_of_four();
    EXPECT_EQ(choose(points, {15.9, {}}).point, 2U);
    EXPECT_EQ(choose(points, {16.0, {}}).point, 3U) << "the limit itself is in time";
    EXPECT_EQ(choose(points, {1000, {}}).point, 3U);
    EXPECT_TRUE(choose(points, {2.0, {}}).met());
}

TEST(Choose, WhereNothingIsInTimeTheQuickestIsNamed) {
    const Choice choice = choose(ladder_of_four(), {1.9, {}});
    EXPECT_EQ(choice.point, 0U);
    EXPECT_FALSE(choice.in_time);
    EXPECT_FALSE(choice.met());
}

TEST(Choose, BelowAnErrorTheQuickestIsTaken) {
    const std::vector<KnownPoint> points = ladder_of_four();
    EXPECT_EQ(choose(points, {{}, 2.5}).point, 2U);
    EXPECT_EQ(choose(points, {{}, 2.0}).point, 2U);
    EXPECT_EQ(choose(points, {{}, 255}).point, 0U);
    const Choice choice = choose(points, {{}, 0.9});
    EXPECT_EQ(choice.point, 3U) << "the most accurate";
    EXPECT_TRUE(choice.in_time);
    EXPECT_FALSE(choice.accurate);
}

TEST(Choose, BothLimitsTakeTheQuickestThatIsAccurateIfItIsInTime) {
    const std::vector<KnownPoint> points = ladder_of_four();
    EXPECT_EQ(choose(points, {16, 4.5}).point, 1U) << "not the most accurate in time";
    EXPECT_TRUE(choose(points, {16, 4.5}).met());
    const Choice choice = choose(points, {9, 1.5});
    EXPECT_EQ(choice.point, 2U) << "the most accurate in time";
    EXPECT_TRUE(choice.in_time);
    EXPECT_FALSE(choice.accurate);
    EXPECT_EQ(choose(points, {1, 1.5}).point, 0U);
}

TEST(Choose, OfEqualsTheFirstIsTaken) {
    const std::vector<KnownPoint> points = {
        {{}, 5, 5, 2}, {{{"aa", "none"}}, 5, 5, 2}, {{}, 5, 5, 3}};
    EXPECT_EQ(choose(points, {10, {}}).point, 0U);
    EXPECT_EQ(choose(points, {{}, 2}).point, 0U);
    EXPECT_EQ(choose(points, {1, {}}).point, 0U);
}

RC_GTEST_PROP(Choose, NothingMeetsTheLimitsBetter, ()) {
    const auto number = [](int most) { return static_cast<double>(*rc::gen::inRange(0, most)); };
    std::vector<KnownPoint> points(*rc::gen::inRange<std::size_t>(1, 12));
    for (KnownPoint& p : points)
        p = {{}, number(8), 1, number(8)};
    Limits limits;
    if (*rc::gen::arbitrary<bool>()) limits.wall_ms = number(8);
    if (*rc::gen::arbitrary<bool>()) limits.error = number(8);
    const Choice choice = choose(points, limits);
    const KnownPoint& taken = points[choice.point];
    for (const KnownPoint& p : points) {
        const bool in_time = !limits.wall_ms || p.wall_ms <= *limits.wall_ms;
        const bool accurate = !limits.error || p.error <= *limits.error;
        if (in_time && accurate) {
            RC_ASSERT(choice.met());
            RC_ASSERT((limits.error ? taken.wall_ms <= p.wall_ms : taken.error <= p.error));
        }
        if (in_time) RC_ASSERT(choice.in_time);
        if (in_time && !choice.accurate) RC_ASSERT(taken.error <= p.error);
        if (!choice.in_time) RC_ASSERT(taken.wall_ms <= p.wall_ms);
    }
}

// What a frontier says of its points by wall time, and each point's options draw it.
TEST(KnownFrontier, HoldsWhatNoOtherPointBeats) {
    Shot s = test::textured_cube("cube", "auto");
    Shot fine = s;
    fine.options.aa = "supersampling_4";
    const image::Image reference = test::draw(fine);
    const scene::View view = *scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {},
                                               s.options.width, s.options.height);
    FrontierOptions how;
    how.axes = {{"aa", "texture"}};
    how.seconds_a_point = 0.001;
    how.effects = false;
    how.flip = FrontierOptions::Flip::none;
    Jobs jobs(2);
    const auto search = FrontierSearch::create(s.scene, frame::facts(s.scene), view, s.options,
                                               jobs, reference, how);
    ASSERT_TRUE(search);
    int steps = 0;
    double before = 0;
    while (!(*search)->finished()) {
        (*search)->step();
        EXPECT_GE((*search)->fraction(), before);
        before = (*search)->fraction();
        ++steps;
    }
    EXPECT_GT(steps, 50) << "steps are short";
    const Frontier found = (*search)->take();
    EXPECT_TRUE(found.effects.empty());
    EXPECT_FALSE(found.stopped);
    const KnownFrontier known = measure::known(found, "2026-11-29");
    EXPECT_EQ(known.date, "2026-11-29");
    ASSERT_GE(known.points.size(), 2U);
    for (std::size_t i = 0; i < known.points.size(); ++i) {
        const KnownPoint& p = known.points[i];
        if (i > 0) {
            EXPECT_GT(p.wall_ms, known.points[i - 1].wall_ms);
            EXPECT_LT(p.error, known.points[i - 1].error);
        }
        Shot drawn = s;
        drawn.options = with(drawn.options, p.rungs);
        EXPECT_DOUBLE_EQ(image::metrics(reference, test::draw(drawn)).rmse_codes, p.error)
            << p.options();
    }
}

TEST(FrontierSearch, AStopIsTheNextStep) {
    const Shot s = test::solids("solids");
    const scene::View view = *scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {},
                                               s.options.width, s.options.height);
    const image::Image reference = test::draw(s);
    Jobs jobs(1);
    const auto search = FrontierSearch::create(s.scene, frame::facts(s.scene), view, s.options,
                                               jobs, reference, {});
    ASSERT_TRUE(search);
    for (int i = 0; i < 5; ++i)
        (*search)->step();
    ASSERT_FALSE((*search)->finished());
    (*search)->stop();
    (*search)->step();
    ASSERT_TRUE((*search)->finished());
    const Frontier found = (*search)->take();
    EXPECT_TRUE(found.stopped);
    std::size_t rungs = 0;
    for (const Ladder& ladder : found.ladders)
        rungs += ladder.rungs.size();
    EXPECT_EQ(rungs, 5U) << "what was drawn";
}

} // namespace
} // namespace scanout::measure
