// What `bench_peers --check` calls met and missed, of figures that are made up.
#include "bench/peers/report.h"

#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::bench {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr Load kLit{"lit", "ball", Shading::blinn_phong, 1, 4, 6};
constexpr Load kDepth{"depth", "ball", Shading::depth, 1, 5, 8};
constexpr Load kFree{"free", "ball", Shading::depth, 1, 0, 0}; // no gate
constexpr Load kSamples{"samples", "ball", Shading::blinn_phong, 4, 5, 10};

// llvmpipe takes 40 ms, we as much as makes this ratio.
Duel of_ratio(double ratio) {
    Duel d;
    d.theirs.cpu = d.theirs.wall = {40};
    d.ours.cpu = d.ours.wall = {40 / ratio};
    d.first = 1.5;
    d.floor = 40 / ratio / 3;
    d.difference = {0.01, 0.001};
    return d;
}
std::vector<std::string> missed_bounds(const Load& load, const Duel& duel) {
    Report r;
    r.duels.emplace_back(load, duel);
    return judge(r).missed;
}
std::vector<std::string> missed_bounds(const ThreadsResult& threads) {
    Report r;
    r.threads.emplace_back(kLit, threads);
    return judge(r).missed;
}

TEST(Report, VerdictsSayHowFarOff) {
    EXPECT_EQ(verdict(6, 4, 6), "goal met");
    EXPECT_EQ(verdict(5, 4, 6), "gate met, goal short by 1.20x");
    EXPECT_EQ(verdict(2, 4, 6), "MISSED by 2.00x");
    EXPECT_EQ(verdict(2, 0, 0), "-");
    EXPECT_EQ(verdict(1.2, 2, 1.2, true), "goal met");
    EXPECT_EQ(verdict(1.8, 2, 1.2, true), "gate met, goal short by 1.50x");
    EXPECT_EQ(verdict(3, 2, 1.2, true), "MISSED by 1.50x");
}

TEST(Report, ARatioBelowItsGateIsMissed) {
    EXPECT_THAT(missed_bounds(kLit, of_ratio(4)), IsEmpty());
    EXPECT_THAT(missed_bounds(kLit, of_ratio(3.9)),
                ElementsAre(HasSubstr("lit: 3.90x, the gate is 4x")));
    EXPECT_THAT(missed_bounds(kFree, of_ratio(0.5)), IsEmpty());
}

TEST(Report, AFirstFrameIsMissedWhereItIsLateOrNoProcessDrewIt) {
    Duel late = of_ratio(4), none = of_ratio(4);
    late.first = 2.01;
    none.first = 0;
    EXPECT_THAT(missed_bounds(kLit, late),
                ElementsAre(HasSubstr("lit: the first frame takes 2.01")));
    EXPECT_THAT(missed_bounds(kLit, none), ElementsAre(HasSubstr("lit: not judged")));
    EXPECT_THAT(missed_bounds(kDepth,
                              [&] {
                                  Duel depth = of_ratio(5);
                                  depth.first = 0;
                                  return depth;
                              }()),
                IsEmpty());
    Report r;
    r.duels.emplace_back(kLit, none);
    EXPECT_THAT(to_markdown(r), HasSubstr("| lit | - | - |"));
}

TEST(Report, PicturesThatDifferAreMissedWithoutAGate) {
    Duel d = of_ratio(9);
    d.difference.flip = 0.06;
    EXPECT_THAT(missed_bounds(kFree, d), ElementsAre(HasSubstr("FLIP 0.0600")));
    d.difference.flip = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(missed_bounds(kFree, d), ElementsAre(HasSubstr("FLIP")));
    d.difference = {0.01, 0.006};
    EXPECT_THAT(missed_bounds(kFree, d), ElementsAre(HasSubstr("one side alone covers 0.60 %")));
    d.difference.one_sided = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(missed_bounds(kFree, d), ElementsAre(HasSubstr("one side alone")));
}

TEST(Report, AFirstFrameIsJudgedWhereItIsTheRenderers) {
    Duel d = of_ratio(9);
    d.first = 2.1;
    EXPECT_THAT(missed_bounds(kLit, d), ElementsAre(HasSubstr("first frame takes 2.10")));
    EXPECT_THAT(missed_bounds(kDepth, d), IsEmpty());
}

TEST(Report, TheFloorIsJudgedWhereItIsKnown) {
    Duel d = of_ratio(9);
    d.floor = d.ours.cpu[0] / 4.5;
    EXPECT_THAT(missed_bounds(kLit, d), ElementsAre(HasSubstr("lit: 4.50 times the floor")));
    EXPECT_THAT(missed_bounds(kFree, d), IsEmpty());
    d.floor = d.ours.cpu[0] * 1.1;
    EXPECT_THAT(missed_bounds(kLit, d), ElementsAre(HasSubstr("lit: faster than its floor")));
    d.floor = 0;
    EXPECT_THAT(missed_bounds(kSamples, d), IsEmpty());
    EXPECT_THAT(missed_bounds(kLit, d), ElementsAre(HasSubstr("lit: not judged: its floor")));
}

TEST(Report, TwoThreadsAreJudgedBesideAPairThatHasTheMachine) {
    EXPECT_THAT(missed_bounds({1.7, 2}), IsEmpty());
    EXPECT_THAT(missed_bounds({1.6, 2}), ElementsAre(HasSubstr("the gate is 1.7x")));
    EXPECT_THAT(missed_bounds({1.6, 1.6}), IsEmpty()); // all that the machine gave
    EXPECT_THAT(missed_bounds({0.98, 0.73}), ElementsAre(HasSubstr("not judged")));
    EXPECT_THAT(missed_bounds({2.3, 2}), ElementsAre(HasSubstr("not judged")));
}

TEST(Report, NoGateIsMetThatWasNotJudged) {
    const std::vector<Load> both = {kLit, kSamples};
    EXPECT_EQ(gates_of(both), 6 + 4); // kSamples: no floor, no two threads
    Report r;
    r.duels = {{kLit, of_ratio(5)}, {kSamples, of_ratio(6)}};
    r.threads = {{kLit, {1.9, 2}}};
    EXPECT_TRUE(judge(r).all_met());
    EXPECT_EQ(count_line(judge(r), 10), "10 of 10 gates judged");
    r.threads = {{kLit, {0.9, 0.8}}}; // other work had the rest
    EXPECT_FALSE(judge(r).all_met());
    EXPECT_EQ(count_line(judge(r), 10), "9 of 10 gates judged");
    r.threads.clear();
    EXPECT_THAT(judge(r).missed, IsEmpty());
    EXPECT_FALSE(judge(r).all_met());
}

TEST(Report, ALoadThatIsLeftOutIsMissedAndOneThatNoOneAskedForIsNot) {
    Report r;
    r.duels = {{kSamples, of_ratio(6)}};
    EXPECT_TRUE(judge(r).all_met());
    EXPECT_EQ(count_line(judge(r), 10), "4 of 10 gates judged; 6 were not asked for (--only)");
    r.left_out = {{kLit, "no such file"}};
    EXPECT_THAT(judge(r).missed, ElementsAre("lit: left out, not judged: no such file"));
    EXPECT_FALSE(judge(r).all_met());
    EXPECT_EQ(count_line(judge(r), 10), "4 of 10 gates judged");
}

TEST(Report, TablesNameEveryLoadAndVerdict) {
    Report r;
    r.width = 1920;
    r.height = 1080;
    r.duels = {{kLit, of_ratio(5)}, {kFree, of_ratio(6)}, {kSamples, of_ratio(4)}};
    r.duels.back().second.floor = 0;
    r.threads = {{kLit, {0.9, 0.8}}, {kLit, {1.95, 2}}};
    const std::string text = to_markdown(r);
    EXPECT_THAT(text, HasSubstr("| lit | 0 | 0.00 | 40.00 | 8.00 | **5.00x** | 5.00x | 4x / 6x | "
                                "gate met, goal short by 1.20x | 0.0100 | 0.100 % |"));
    EXPECT_THAT(text, HasSubstr("| lit | 1.50 | gate met, goal short by 1.25x | 2.67 | 3.00 | gate "
                                "met, goal short by 1.50x |"));
    EXPECT_THAT(text, HasSubstr("| samples | 1.50 | gate met, goal short by 1.25x | - | - | - |"));
    EXPECT_THAT(text, HasSubstr("| lit | 0.90x | 0.80x | **2.25x** | 1.7x / 1.9x | not judged |"));
    EXPECT_THAT(text, HasSubstr("| lit | 1.95x | 2.00x | **1.95x** | 1.7x / 1.9x | goal met |"));
}

} // namespace
} // namespace scanout::bench
