#include "app/report/explain_report.h"
#include "app/report/report.h"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::app {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

measure::EffectRow row(const std::string& effect, const std::string& technique,
                       const std::string& fact) {
    measure::EffectRow r;
    r.decision.effect = effect;
    r.decision.technique = technique;
    r.decision.because = fact;
    r.decision.needed = r.decision.on();
    r.change = measure::Change{};
    return r;
}

measure::Price price(double median, double half) {
    measure::Price p;
    p.pairs = 6;
    p.cpu_ms = p.wall_ms = {median, median - half, median + half};
    return p;
}

struct Example {
    LoadedModel model;
    measure::Explanation e;
    Example() {
        model.scene.path = "models/x.obj";
        model.scene.counts.triangles = 12;
        e.width = 64;
        e.height = 48;
        e.covered_share = 0.5;
        e.special = 1;
        e.rows = {row("texture", "bilinear", "3 of 14 materials have a map"),
                  row("fog", "off", "there is none")};
        e.rows[0].pixel_share = 0.018;
        e.rows[0].bytes = 65536;
        e.rows[0].change = measure::Change{100, 77, 0.0123};
        e.rows[1].pixel_share = 0;
    }
};

TEST(ExplainTable, ShowsWhatRunsWhyAndWhatItChanges) {
    const Example x;
    EXPECT_EQ(explain_table(x.model, x.e),
              (std::vector<std::string>{
                  "x.obj  12 triangles  64x48  50.0 % of pixels covered",
                  "effect   runs      memory  codes    FLIP  pixels  because",
                  "texture  bilinear  64 KiB     77  0.0123     100  3 of 14 materials have a map, "
                  "1.8 % of pixels",
                  "fog      off            0      0  0.0000       0  there is none",
                  "switching on any of the 1 that are off: 0 pixels differ"}));
}

TEST(ExplainTable, HasAColumnOfTimesWhereTheyWereMeasured) {
    Example x;
    x.e.cost = measure::Cost{6.5, 3.25, {}};
    x.e.rows.push_back(row("gloss", "off", "no map"));
    x.e.rows.push_back(row("bump", "on", "a map"));
    x.e.rows[0].price = price(1.5, 0.1);
    x.e.rows[1].price = measure::equal_by_construction();
    x.e.rows[2].price = price(0.75, 0.25);
    x.e.rows[3].price = price(0.5, 0.6);
    EXPECT_EQ(
        explain_table(x.model, x.e),
        (std::vector<std::string>{
            "x.obj  12 triangles  64x48  50.0 % of pixels covered  3.25 ms, 6.50 ms of CPU time",
            "effect   runs           CPU ms  memory  codes    FLIP  pixels  because",
            "texture  bilinear  1.50 ± 0.10  64 KiB     77  0.0123     100  3 of 14 materials have "
            "a map, 1.8 % of pixels",
            "fog      off         same plan       0      0  0.0000       0  there is none",
            "gloss    off                 0       0      0  0.0000       0  no map; on it would "
            "take +0.75 ± 0.25 ms",
            "bump     on           0 ± 1.10       0      0  0.0000       0  a map",
            "switching on any of the 2 that are off: 0 pixels differ",
            "CPU ms: of all threads, median ± half of its 95 % interval; same plan: equal by "
            "construction, not timed; this machine counts no instructions"}));
    x.e.cost->instructions = 1e6;
    EXPECT_THAT(explain_table(x.model, x.e).back(), Not(HasSubstr("instructions")));
}

TEST(ExplainTable, IsWrittenAsJsonWithIntervals) {
    Example x;
    x.e.cost = measure::Cost{6.5, 3.25, {}};
    x.e.rows[0].price = price(1.5, 0.1);
    x.e.rows[1].price = measure::equal_by_construction();
    const std::string json = to_json(x.model, x.e);
    for (const char* part : {"\"same_plan\": true", "\"same_plan\": false", "\"pairs\": 6",
                             "\"low\": 1.4", "\"high\": 1.6", "\"zero\": false",
                             "\"instructions\": null", "\"cpu_ms\": 6.5", "\"ms\": 3.25"})
        EXPECT_THAT(json, HasSubstr(part));
}

TEST(ExplainTable, SaysWhenNothingSpecialIsCalledFor) {
    Example x;
    EXPECT_THAT(explain_table(x.model, x.e), Each(Not(HasSubstr("nothing special"))));
    x.e.special = 0;
    EXPECT_THAT(explain_table(x.model, x.e)[1], HasSubstr("nothing special"));
}

TEST(ExplainTable, DoesNotHideThatSwitchingOnWouldChangeSomething) {
    Example x;
    x.e.rows[1].change->pixels = 5;
    EXPECT_EQ(explain_table(x.model, x.e).back(),
              "switching on what is off changes pixels in 1 of 1 rows");
}

TEST(ExplainTable, SaysWhatWasForcedAndWhatCannotBeSwitched) {
    Example x;
    x.e.rows[0].decision.forced = true;
    EXPECT_THAT(because(x.e.rows[0]), HasSubstr("1.8 % of pixels (forced)"));
    x.e.rows[1].change.reset();
    x.e.rows[1].refusal = "it cannot be";
    EXPECT_EQ(because(x.e.rows[1]), "there is none; it cannot be");
    EXPECT_THAT(to_json(x.model, x.e), HasSubstr("\"refused\": \"it cannot be\""));
}

TEST(ExplainTable, SaysWhatATechniqueThatTheUserNamesLosesAgainstTheAutomaticOne) {
    Example x;
    x.e.rows[0].automatic = measure::Alternative{"trilinear", {7, 34, 0.0021}, {}};
    EXPECT_EQ(because(x.e.rows[0]),
              "3 of 14 materials have a map, 1.8 % of pixels; trilinear would be chosen: 34 codes, "
              "FLIP 0.0021, 7 pixels differ");
    EXPECT_THAT(to_json(x.model, x.e), HasSubstr("\"technique\": \"trilinear\""));
    x.e.rows[0].automatic->price = price(-0.25, 0.05); // what runs takes less
    EXPECT_THAT(because(x.e.rows[0]), HasSubstr("7 pixels differ, +0.25 ± 0.05 ms"));
    x.e.rows[0].automatic->price = price(0.001, 0.02);
    EXPECT_THAT(because(x.e.rows[0]), HasSubstr("7 pixels differ, 0 ± 0.02 ms"));
    x.e.rows[0].automatic->price = price(1.5, 0.1);
    EXPECT_THAT(because(x.e.rows[0]), HasSubstr("7 pixels differ, -1.50 ± 0.10 ms"));
    x.e.rows[0].automatic->price = measure::equal_by_construction();
    EXPECT_THAT(because(x.e.rows[0]), testing::EndsWith("7 pixels differ"));
}

TEST(ScreenTable, HasTheFiguresThatAreKnownAndFitsTheScreen) {
    measure::Explanation e;
    for (int i = 0; i < 10; ++i)
        e.rows.push_back(row("effect" + std::to_string(i), i < 9 ? "on" : "off", "a fact"));
    e.rows[9].decision.needed = true; // so it keeps its line
    e.rows[0].change = measure::Change{120, 37, 0.0125};
    e.rows[0].price = price(1.25, 0.05);
    e.rows[0].bytes = 4096;
    const auto all = screen_table(e, 1, 200, 40, 1).lines;
    ASSERT_EQ(all.size(), 12U) << "heads, rows, and how far it is";
    for (const char* part : {"effect0", "1.25 ± 0.05", "4096 B", "37", "0.0125", "120", "a fact"})
        EXPECT_THAT(all[1], HasSubstr(part));
    EXPECT_EQ(all.back(), "measured 1 of 10");
    const auto whole = screen_table(e, 10, 200, 40, 1).lines;
    EXPECT_THAT(whole.back(), HasSubstr("pixels"));
    EXPECT_THAT(all[0], HasSubstr(" CPU ms "));
    e.rows[0].price.reset();
    EXPECT_THAT(screen_table(e, 10, 200, 40, 1).lines[0], Not(HasSubstr(" ms ")))
        << "nothing of it was timed";

    const auto low = screen_table(e, 1, 60, 8, 1);
    EXPECT_EQ(low.pages, 2U) << "five rows a page";
    ASSERT_EQ(low.lines.size(), 8U);
    EXPECT_THAT(low.lines[5], HasSubstr("effect4"));
    EXPECT_EQ(low.lines[6], "measured 1 of 10");
    EXPECT_EQ(low.lines.back(), "page 1 of 2: the same key goes on");
    EXPECT_THAT(low.lines[1], Not(HasSubstr("0.0125"))) << "no room for all columns";
    EXPECT_THAT(screen_table(e, 1, 60, 8, 2).lines[1], HasSubstr("effect5"));
    EXPECT_EQ(screen_table(e, 1, 60, 8, 9).lines, screen_table(e, 1, 60, 8, 2).lines);
}

// Whatever the screen, on its pages every word of every reason can be read, in order.
TEST(ScreenTable, LosesNoWordOfAReason) {
    measure::Explanation e;
    for (int i = 0; i < 25; ++i) {
        std::string reason;
        for (int k = 0; k < i; ++k)
            reason += "w" + std::to_string(i) + "." + std::to_string(k) + " ";
        e.rows.push_back(row("effect" + std::to_string(i), i % 2 == 0 ? "blinn_phong" : "on",
                             reason + "end" + std::to_string(i)));
    }
    for (const std::size_t letters : {50U, 78U, 105U, 158U, 300U})
        for (const std::size_t lines : {12U, 34U, 60U}) {
            std::string text;
            const std::size_t pages = screen_table(e, 25, letters, lines, 1).pages;
            for (std::size_t page = 1; page <= pages; ++page) {
                const auto shown = screen_table(e, 25, letters, lines, page);
                EXPECT_LE(shown.lines.size(), lines);
                EXPECT_THAT(shown.lines, Each(testing::SizeIs(testing::Le(letters))));
                for (const std::string& line : shown.lines)
                    text += line + " ";
            }
            std::size_t at = 0;
            for (const measure::EffectRow& r : e.rows) {
                std::istringstream words(r.decision.effect + " " + r.decision.because);
                for (std::string word; words >> word;) {
                    at = text.find(word, at);
                    ASSERT_NE(at, std::string::npos) << word << " on " << letters;
                    at += word.size();
                }
            }
        }
}

TEST(ScreenTable, WhatIsOffFoldsIntoOneLineUnlessItWasAskedFor) {
    measure::Explanation e;
    e.rows = {row("fog", "off", "no fog"), row("texture", "bilinear", "a fact"),
              row("edges", "none", "on request"), row("shadow", "off", "taken out")};
    e.rows[3].decision.forced = true;
    const auto lines = screen_table(e, 4, 100, 20, 1).lines;
    ASSERT_GE(lines.size(), 4U);
    EXPECT_THAT(lines[1], HasSubstr("texture"));
    EXPECT_THAT(lines[2], HasSubstr("taken out"));
    EXPECT_EQ(lines[3], "off: fog, edges");
}

TEST(PlanLines, AreOneAnEffectAndNoLongerThanTheScreen) {
    frame::FramePlan plan;
    plan.decisions = {row("texture", "bilinear", "a fact").decision,
                      row("fog", "off", "none").decision};
    const auto lines = plan_lines(plan, true, 60, 9, 1).lines;
    ASSERT_EQ(lines.size(), 4U);
    EXPECT_EQ(lines[0], "effect   runs      because");
    EXPECT_EQ(lines[1], "texture  bilinear  a fact");
    EXPECT_EQ(lines[2], "off: fog");
    EXPECT_EQ(lines[3], "times, memory and changes: when the picture stands still");
    EXPECT_EQ(plan_lines(plan, false, 60, 9, 1).lines[3],
              "memory and changes: when the picture stands still");
    EXPECT_THAT(plan_lines(plan, true, 5, 9, 1).lines, Each(testing::SizeIs(testing::Le(5U))));
}

} // namespace
} // namespace scanout::app
