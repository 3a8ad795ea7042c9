#include "measure/frontier.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

namespace scanout::measure {
namespace {

using test::Shot;

scene::View view_of(const Shot& s) {
    return *scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                             s.options.height);
}

// What 16 samples draw, as a picture to be compared with.
image::Image fine(Shot s) {
    s.options.aa = "supersampling_4";
    return test::draw(s);
}

struct Measured {
    Shot shot;
    image::Image reference;
    Jobs jobs{2};
    Frontier found;

    Measured(Shot s, const FrontierOptions& how) : shot(std::move(s)), reference(fine(shot)) {
        auto made = frontier(shot.scene, frame::facts(shot.scene), view_of(shot), shot.options,
                             jobs, reference, how);
        EXPECT_TRUE(made) << (made ? "" : made.error().what);
        if (made) found = std::move(*made);
    }
    const Ladder& ladder(std::string_view axis) const {
        for (const Ladder& l : found.ladders)
            if (l.axis == axis) return l;
        static const Ladder none;
        ADD_FAILURE() << "no ladder " << axis;
        return none;
    }
};

FrontierOptions errors_alone() {
    FrontierOptions how;
    how.times = false;
    how.flip = FrontierOptions::Flip::of_frontier;
    return how;
}

FrontierOptions quick() {
    FrontierOptions how;
    how.axes = {{"aa", "texture", "shading"}};
    how.seconds_a_point = 0.001;
    return how;
}

double rmse_by_hand(const image::Image& a, const image::Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const image::Rgba8 &p = a.pixels()[i], &q = b.pixels()[i];
        sum += std::pow(p.r - q.r, 2) + std::pow(p.g - q.g, 2) + std::pow(p.b - q.b, 2);
    }
    return std::sqrt(sum / (3.0 * static_cast<double>(a.pixels().size())));
}

TEST(Ladder, AxesAreThoseWithRungs) {
    EXPECT_THAT(ladder_axes(),
                testing::IsSupersetOf({"interpolate", "texture", "shadow", "shading", "depth",
                                       "transparency", "aa", "render_scale"}));
    EXPECT_THAT(ladder_axes(), testing::Not(testing::Contains("reflection")));
    EXPECT_THAT(ladder_axes(), testing::Not(testing::Contains("tone")));
}

// Rungs are what is measured, models what it is measured of.
TEST(Ladder, AReferenceKeepsModelsAndFilters) {
    frame::FrameOptions asked;
    asked.samples = 8;
    asked.shadow = "attached";
    asked.texture = "bicubic";
    asked.tone = "filmic";
    frame::FrameOptions plain = without_rungs(asked);
    EXPECT_EQ(plain.samples, 1);
    EXPECT_EQ(plain.shadow, "auto");
    EXPECT_EQ(plain.texture, "bicubic");
    EXPECT_EQ(plain.tone, "filmic");
    asked.aa = "tent";
    EXPECT_EQ(without_rungs(asked).aa, "tent");
    asked.ambient_occlusion = "gtao_4"; // comes only on request
    EXPECT_EQ(without_rungs(asked).ambient_occlusion, "gtao_4");
}

// Each rung's error is that of the picture that the option draws.
TEST(Ladder, ErrorsAreThoseOfThePicturesDrawnWithTheOption) {
    const Measured m(test::textured_cube("cube", "auto"), errors_alone());
    int rungs = 0;
    for (const std::string_view axis : {"aa", "texture", "shading"}) {
        std::set<double> different;
        for (const LadderRung& rung : m.ladder(axis).rungs) {
            Shot s = m.shot;
            ASSERT_TRUE(frame::ask(s.options, axis, rung.technique));
            const double error = rmse_by_hand(m.reference, test::draw(s));
            ASSERT_TRUE(rung.point) << rung.technique << ": " << rung.refusal;
            EXPECT_NEAR(m.found.error(*rung.point), error, 1e-9) << axis << " " << rung.technique;
            different.insert(error);
            ++rungs;
        }
        EXPECT_GT(different.size(), axis == "shading" ? 0U : 1U) << axis; // a cube is flat
    }
    EXPECT_GT(rungs, 15);
    EXPECT_EQ(m.ladder("aa").rungs.front().technique, "none");
    EXPECT_FALSE((*m.found.points)[1].price); // nothing was timed
    EXPECT_TRUE(m.found.frontier.empty());
}

TEST(Ladder, IsFlatWhereNothingCallsForTheAxis) {
    const Measured m(test::solids("solids"), errors_alone()); // no texture
    EXPECT_TRUE(m.ladder("texture").is_flat());
    EXPECT_TRUE(m.ladder("transparency").is_flat());
    EXPECT_FALSE(m.ladder("aa").is_flat());
}

TEST(Ladder, LeavesAnAxisOutWhereAFilterIsAskedFor) {
    Shot s = test::solids("solids");
    s.options.aa = "tent";
    const Measured m(std::move(s), errors_alone());
    EXPECT_THAT(m.ladder("aa").left_out, testing::HasSubstr("tent"));
    EXPECT_TRUE(m.ladder("aa").rungs.empty());
    EXPECT_FALSE(m.ladder("shading").rungs.empty());
}

RC_GTEST_PROP(Frontier, TheParetoSetIsWhatNothingBeats, ()) {
    const auto size = *rc::gen::inRange<std::size_t>(0, 30);
    std::vector<TimedError> points(size);
    for (TimedError& p : points)
        p = {static_cast<double>(*rc::gen::inRange(0, 12)),
             static_cast<double>(*rc::gen::inRange(0, 12))};
    std::set<std::pair<double, double>> expected, got;
    for (const TimedError& p : points) {
        const bool beaten = std::any_of(points.begin(), points.end(), [&](const TimedError& q) {
            return q.time <= p.time && q.error <= p.error && (q.time < p.time || q.error < p.error);
        });
        if (!beaten) expected.emplace(p.time, p.error);
    }
    const std::vector<std::size_t> set = pareto_set(points);
    for (const std::size_t i : set)
        got.emplace(points[i].time, points[i].error);
    RC_ASSERT(got == expected);
    RC_ASSERT(set.size() == expected.size()); // equal ones once
    RC_ASSERT(std::is_sorted(set.begin(), set.end(), [&](std::size_t a, std::size_t b) {
        return points[a].time < points[b].time;
    }));
}

TEST(Frontier, TheKneeIsFarthestBelowTheLine) {
    // Of ranges: a third and two thirds of the times, 0.022 and 0.015 of the errors are left.
    EXPECT_EQ(knee_of({{1, 100}, {10, 3.1623}, {100, 2.5119}, {1000, 1}}), 1U);
    EXPECT_EQ(knee_of({{1, 100}, {10, 50.119}, {100, 1.2589}, {1000, 1}}), 2U);
    EXPECT_EQ(knee_of({{1, 100}, {10, 90}, {100, 1}}), 0U); // above the line
    EXPECT_EQ(knee_of({{5, 1}}), 0U);
}

TEST(Frontier, TheBestBuyGainsMostForADoublingOfTheTime) {
    const std::vector<TimedError> set = {{1, 9}, {2, 3}, {3.5, 2.9}, {4.4, 1.1}, {70, 0.5}};
    EXPECT_EQ(best_buy(set, 1), 3U) << "2.2 times the time for 1.9, not 1.75 times for 0.1";
    EXPECT_EQ(best_buy(set, 3), 4U);
    EXPECT_EQ(best_buy(set, 4), std::nullopt);
    EXPECT_EQ(best_buy({{1, 9}, {1.01, 8}, {2, 7}, {16, 0}}, 0), 3U) << "2.25 a doubling";
    EXPECT_EQ(best_buy({{1, 9}, {1.01, 8}, {2, 6.7}, {16, 1}}, 0), 2U) << "a little more is no buy";
}

// No point that was timed beats one on the frontier by more than the intervals of both, and each
// of them was measured as a whole.
TEST(Frontier, NothingMeasuredBeatsIt) {
    const Measured m(test::textured_cube("cube", "auto"), quick());
    const Frontier& f = m.found;
    ASSERT_GE(f.frontier.size(), 3U);
    EXPECT_FALSE(f.stopped);
    bool whole = false; // some configuration differs on two axes
    for (const FrontierPoint& p : f.frontier) {
        ASSERT_TRUE((*f.points)[p.point].price);
        EXPECT_TRUE((*f.points)[p.point].mean_flip);
        const Difference own = (*f.points)[p.point].price->cpu_ratio;
        for (std::size_t i = 0; i < f.points->all().size(); ++i) {
            const auto& price = (*f.points)[i].price;
            EXPECT_FALSE(price && price->cpu_ratio.high < own.low && f.error(i) < f.error(p.point));
        }
    }
    for (const Point& p : f.points->all())
        whole = whole || (p.rungs.size() > 1 && p.price);
    EXPECT_TRUE(whole);
    for (std::size_t i = 1; i < f.frontier.size(); ++i) {
        EXPECT_GE(f.cpu_ms(f.frontier[i].point), f.cpu_ms(f.frontier[i - 1].point));
        EXPECT_LT(f.error(f.frontier[i].point), f.error(f.frontier[i - 1].point));
    }
    EXPECT_TRUE(f.knee());
    EXPECT_EQ(f.best_within(1e9), f.frontier.back().point);
    EXPECT_EQ(f.quickest_below(1e9), f.frontier.front().point);
    EXPECT_TRUE(f.best_within(f.least_wall_ms()));
    EXPECT_FALSE(f.best_within(0.999 * f.least_wall_ms()));
    EXPECT_FALSE(f.best_within(0));
    EXPECT_FALSE(f.quickest_below(f.error(f.frontier.back().point) - 1e-6));
}

// An effect that is on is priced by a frame without it.
TEST(Frontier, PricesEffects) {
    const Measured m(test::textured_cube("cube", "auto"), quick());
    const auto texture = std::find_if(m.found.effects.begin(), m.found.effects.end(),
                                      [](const EffectPrice& e) { return e.effect == "texture"; });
    ASSERT_NE(texture, m.found.effects.end());
    Shot without = m.shot;
    without.options.effects["texture"] = false;
    const image::Image a = test::draw(m.shot), b = test::draw(without);
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i)
        pixels += a.pixels()[i] == b.pixels()[i] ? 0 : 1;
    EXPECT_GT(pixels, 100U);
    EXPECT_NEAR(texture->changed_share,
                static_cast<double>(pixels) / static_cast<double>(a.pixels().size()), 1e-12);
}

// Without its light a surface has no highlight either: the time of both is not the light's.
TEST(Frontier, PricesNoLightThatTakesAHighlightWithIt) {
    const Measured m(test::glossy("ball", "blinn_phong"), quick());
    std::vector<std::string> priced;
    for (const EffectPrice& e : m.found.effects)
        priced.push_back(e.effect);
    EXPECT_THAT(priced, testing::Contains("highlight"));
    EXPECT_THAT(priced, testing::Not(testing::Contains("directional_light")));
}

// A matt surface has none: what the light takes is its own.
TEST(Frontier, PricesALightThatTakesNothingWithIt) {
    const Measured m(test::ball("ball"), quick());
    std::vector<std::string> priced;
    for (const EffectPrice& e : m.found.effects)
        priced.push_back(e.effect);
    EXPECT_THAT(priced, testing::Contains("directional_light"));
}

// The quickest rung of an axis and the most accurate one.
std::set<std::size_t> ends_of(const Frontier& found, const Ladder& ladder) {
    std::vector<std::size_t> drawn;
    for (const LadderRung& rung : ladder.rungs)
        if (rung.point) drawn.push_back(*rung.point);
    const auto least = [&](auto of) {
        return *std::min_element(drawn.begin(), drawn.end(),
                                 [&](std::size_t a, std::size_t b) { return of(a) < of(b); });
    };
    return {least([&](std::size_t i) { return (*found.points)[i].first_ms; }),
            least([&](std::size_t i) { return found.error(i); })};
}

// Rungs are timed from the quickest on, after the ends of the axes: where the time is up, slow ones
// between them are left out.
TEST(Frontier, LeavesSlowRungsOut) {
    FrontierOptions how = quick();
    bool timing = false;
    int left = 60;                                                        // steps: four frames each
    how.progress = [&](double done) { timing = timing || done >= 0.15; }; // effects are done
    how.stop = [&] { return timing && --left < 0; };
    const Measured m(test::textured_cube("cube", "auto"), how);
    EXPECT_TRUE(m.found.stopped);
    EXPECT_TRUE(m.found.interrupted);
    std::set<std::size_t> ends;
    for (const Ladder& ladder : m.found.ladders)
        if (!ladder.is_flat()) ends.merge(ends_of(m.found, ladder));
    EXPECT_GE(ends.size(), 4U);
    double slowest_timed = 0, quickest_left = 1e9;
    int timed = 0;
    const std::vector<std::size_t> untimed = m.found.untimed_rungs();
    EXPECT_EQ(untimed.size() + static_cast<std::size_t>(std::count_if(
                                   m.found.points->all().begin(), m.found.points->all().end(),
                                   [](const Point& p) { return p.price.has_value(); })),
              m.found.drawn_rungs().size());
    for (std::size_t i = 0; i < m.found.points->all().size(); ++i) {
        const Point& p = (*m.found.points)[i];
        EXPECT_EQ(std::count(untimed.begin(), untimed.end(), i), p.price ? 0 : 1);
        if (ends.count(i) != 0) {
            EXPECT_TRUE(p.price) << p.options();
            continue;
        }
        if (p.rungs.size() != 1) continue; // as asked for, or none of the ladders
        if (p.price) slowest_timed = std::max(slowest_timed, p.first_ms);
        if (!p.price) quickest_left = std::min(quickest_left, p.first_ms);
        timed += p.price ? 1 : 0;
    }
    EXPECT_GE(timed, 1);
    EXPECT_LE(slowest_timed, quickest_left);
    EXPECT_LT(quickest_left, 1e9);
}

TEST(Frontier, KeepsWhatIsMeasuredWhereItIsStopped) {
    FrontierOptions how = quick();
    int left = 12;
    how.stop = [&] { return --left < 0; };
    const Measured m(test::textured_cube("cube", "auto"), how);
    EXPECT_TRUE(m.found.stopped);
    EXPECT_GE(m.found.points->all().size(), 5U);
    EXPECT_TRUE(m.found.frontier.empty()); // nothing was timed
}

TEST(Frontier, TimesWhatIsAskedForWhereDrawingTookAllTheTime) {
    FrontierOptions how = quick();
    how.seconds = 1e-9;
    const Measured m(test::textured_cube("cube", "auto"), how);
    EXPECT_TRUE(m.found.stopped);
    ASSERT_EQ(m.found.frontier.size(), 1U);
    EXPECT_EQ(m.found.frontier[0].point, 0U);
    EXPECT_GT(m.found.cpu_ms(0), 0);
    EXPECT_GT(m.found.wall_ms(0), 0);
}

} // namespace
} // namespace scanout::measure
