#include "app/frontier/chart_axes.h"
#include "app/frontier/report.h"
#include "app/interrupt.h"
#include "app/report/markup.h"
#include "support/scenes.h"

#include <csignal>

#include <gmock/gmock.h>

namespace scanout::app {
namespace {

using testing::HasSubstr;

TEST(Markup, NoNameOfAFileIsATag) {
    EXPECT_EQ(as_markup("a<b>&\"c\".obj"), "a&lt;b&gt;&amp;&quot;c&quot;.obj");
    EXPECT_EQ(as_markup("bell\a"), "bell\\x07");
}

TEST(LogAxis, GoesFromATickToATick) {
    const LogAxis axis(0.7, 30);
    EXPECT_THAT(axis.ticks(), testing::ElementsAre(testing::DoubleEq(0.5), testing::DoubleEq(1),
                                                   testing::DoubleEq(2), testing::DoubleEq(5),
                                                   testing::DoubleEq(10), testing::DoubleEq(20),
                                                   testing::DoubleEq(50)));
    EXPECT_DOUBLE_EQ(axis.place(0.5), 0);
    EXPECT_DOUBLE_EQ(axis.place(5), 0.5);
    EXPECT_DOUBLE_EQ(axis.place(50), 1);
    EXPECT_DOUBLE_EQ(axis.place(0), 0); // no logarithm
    EXPECT_DOUBLE_EQ(axis.place(1e9), 1);
    EXPECT_GE(LogAxis(3, 3).ticks().size(), 2U);
    EXPECT_GE(LogAxis(1e-12, 1e12).ticks().size(), 2U);
}

Chart chart() {
    Chart c;
    c.title = "a<b>.obj";
    c.noise = 0.2;
    c.points = {{1, 0.9, 1.1, 4, 3.9, 4.1, 1, false, "--aa none"},
                {10, 9, 11, 0.5, 0.4, 0.6, 2, false, "--aa area"},
                {3, 3, 3, 6, 5, 7, 0, true, "as asked for"}};
    return c;
}

TEST(Chart, TextStandsWhereThePointsAre) {
    const std::vector<std::string> lines = text_plot(chart());
    const auto row_of = [&](char mark) {
        return std::find_if(lines.begin() + 1, lines.end(),
                            [mark](const std::string& line) {
                                return line.substr(10).find(mark) != std::string::npos;
                            }) -
               lines.begin();
    };
    const auto column_of = [&](char mark) {
        return lines[static_cast<std::size_t>(row_of(mark))].find(mark);
    };
    EXPECT_LT(row_of('@'), row_of('O')); // greater errors stand higher
    EXPECT_GT(column_of('@'), column_of('O'));
    EXPECT_LT(row_of('O'), row_of(':'));
    std::size_t marks = 0;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        EXPECT_LE(lines[i].size(), 80U);
        marks += static_cast<std::size_t>(std::count(lines[i].begin(), lines[i].end(), 'O'));
    }
    EXPECT_EQ(marks, 2U);
}

TEST(Chart, TheSvgIsWholeAndHoldsEveryPoint) {
    const std::string svg = chart_svg(chart());
    EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    EXPECT_THAT(svg, HasSubstr("a&lt;b&gt;.obj"));
    for (const ChartPoint& p : chart().points)
        EXPECT_THAT(svg, HasSubstr("<title>" + p.name));
    EXPECT_THAT(svg, HasSubstr("noise of the reference"));
    for (const char* number : {"1", "2"}) { // no point hides it
        const std::size_t at = svg.find(fmt::format("start\" fill=\"#333333\">{}</text>", number));
        EXPECT_GT(at, svg.rfind("<circle"));
        EXPECT_LT(at, svg.size());
    }
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

// The discs of the frontier are there, in its colour; the one to the right lies lower.
TEST(Chart, ThePictureShowsTheFrontier) {
    const image::Image picture = chart_picture(chart());
    const image::Rgba8 frontier{0xb5, 0x36, 0x7a, 255};
    int left = picture.width(), right = 0, left_y = 0, right_y = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            if (!(picture.at(x, y) == frontier)) continue;
            if (x < left) left = x, left_y = y;
            if (x > right) right = x, right_y = y;
        }
    EXPECT_LT(left, picture.width() / 3);
    EXPECT_GT(right, picture.width() / 2);
    EXPECT_LT(left_y, right_y);
}

TEST(Chart, ALongNameGoesOnInTheNextLine) {
    Chart one = chart(), two = chart();
    two.points[0].name = "--depth float32 --mapping perspective --texture anisotropic_16 --shading "
                         "per_sample --aa samples_16 --shadow volume --transparency exact";
    ASSERT_LT(chart_svg(two).find("exact</text>"), chart_svg(two).size());
    const image::Image picture = chart_picture(two), shorter = chart_picture(one);
    EXPECT_EQ(picture.width(), shorter.width());
    EXPECT_EQ(picture.height(), shorter.height() + 24);
    for (int y = shorter.height() / 2; y < picture.height(); ++y)
        for (int x = picture.width() - 8; x < picture.width(); ++x)
            ASSERT_EQ(picture.at(x, y).r, 255) << x << " " << y << ": a letter is cut";
}

// What was not measured is not said to be nothing.
TEST(FrontierSentences, SayWhatWasNotMeasured) {
    const test::Shot s = test::textured_cube("cube", "auto");
    const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                                       s.options.height);
    const image::Image reference = test::draw(s);
    Jobs jobs(2);
    measure::FrontierOptions how;
    how.seconds = 1e-9; // over after the first point
    FrontierReport report;
    report.reference = reference;
    report.found =
        *measure::frontier(s.scene, frame::facts(s.scene), *view, s.options, jobs, reference, how);
    const std::vector<std::string> said = frontier_sentences(report);
    ASSERT_EQ(said.size(), 3U);
    EXPECT_THAT(said[0], HasSubstr("as asked for"));
    EXPECT_EQ(said[1], "Dearest effect: not measured.");
    EXPECT_EQ(said[2], "Free: not measured.");
    EXPECT_EQ(stopped_sentence(report.found),
              "Not all was measured: the time was up (--seconds gives more); 1 of 1 rungs have no "
              "time.");
}

// A rung that has no time is not said to be none.
TEST(FrontierSentences, NameARungThatWasNotTimed) {
    const test::Shot s = test::textured_cube("cube", "auto");
    test::Shot fine = s;
    fine.options.aa = "supersampling_4";
    const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                                       s.options.height);
    const image::Image reference = test::draw(fine);
    Jobs jobs(2);
    measure::FrontierOptions how;
    bool timing = false;
    how.progress = [&](double done) { timing = timing || done >= 0.15; };
    how.stop = [&] { return timing; };
    FrontierReport report;
    report.reference = reference;
    report.found =
        *measure::frontier(s.scene, frame::facts(s.scene), *view, s.options, jobs, reference, how);
    ASSERT_FALSE(report.found.untimed_rungs().empty());
    EXPECT_THAT(stopped_sentence(report.found),
                testing::MatchesRegex("Not all was measured: it was interrupted; [0-9]+ of [0-9]+ "
                                      "rungs have no time\\."));
    const ReportTable errors = frontier_tables(report)[1];
    EXPECT_EQ(errors.rows.back().front(), "0.5");
    EXPECT_EQ(errors.rows.back().back(),
              "nothing that was timed; --aa supersampling_4 errs 0.000 codes");
}

// A plain model's frame is made of techniques alone.
TEST(FrontierSentences, NameTheDearestTechniqueWhereNoEffectIsOn) {
    test::Shot s = test::solids("solids");
    s.options.aa = "supersampling_4";
    const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                                       s.options.height);
    Jobs jobs(2);
    measure::FrontierOptions how;
    how.axes = {"aa", "render_scale"};
    how.seconds_a_point = 0.05;
    how.effects = false;
    FrontierReport report;
    report.reference = test::draw(s);
    report.found = *measure::frontier(s.scene, frame::facts(s.scene), *view, s.options, jobs,
                                      report.reference, how);
    const std::string said = frontier_sentences(report).at(1);
    EXPECT_THAT(said, HasSubstr("aa supersampling_4: "));
    EXPECT_THAT(said, HasSubstr("% of the frame's CPU time, over none, for "));
}

TEST(Interrupt, TheFirstOneOnlySetsAFlag) {
    const Interrupt interrupt;
    EXPECT_FALSE(Interrupt::asked());
    std::raise(SIGINT);
    EXPECT_TRUE(Interrupt::asked());
    struct sigaction now {};
    ::sigaction(SIGINT, nullptr, &now);
    EXPECT_EQ(now.sa_handler, SIG_DFL); // the next one ends the program
}

} // namespace
} // namespace scanout::app
