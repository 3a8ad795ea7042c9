#include "app/progress_bar.h"

#include <vector>

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

struct Terminal {
    std::vector<std::string> lines;
    ProgressBar::Write write() {
        return [this](std::string_view line) { lines.emplace_back(line); };
    }
};

TEST(ProgressBar, GrowsEvenlyOnOneLineAndIsErased) {
    Terminal terminal;
    {
        ProgressBar bar("reading knot.stl", 0, terminal.write());
        for (int i = 0; i <= 1000; ++i)
            bar.show(i / 1000.0);
    }
    ASSERT_EQ(terminal.lines.size(), 102u) << "a line for each percent, and the end";
    EXPECT_EQ(terminal.lines.back(), "");
    EXPECT_EQ(terminal.lines.front(), "reading knot.stl  [....................]   0 %");
    EXPECT_EQ(terminal.lines[50], "reading knot.stl  [##########..........]  50 %");
    EXPECT_EQ(terminal.lines[100], "reading knot.stl  [####################] 100 %");
}

// What is left to do may turn out to be more than it seemed.
TEST(ProgressBar, NeverGoesBack) {
    Terminal terminal;
    ProgressBar bar("tracing", 0, terminal.write());
    for (const double fraction : {0.5, 0.9, 0.7, 0.9, 0.91})
        bar.show(fraction);
    EXPECT_EQ(terminal.lines.size(), 3U);
}

TEST(ProgressBar, WaitsAndLeavesNoTraceWhenItWasNotNeeded) {
    Terminal terminal;
    {
        ProgressBar bar("reading", 1e9, terminal.write());
        for (int i = 0; i <= 100; ++i)
            bar.show(i / 100.0);
    }
    EXPECT_TRUE(terminal.lines.empty());
}

TEST(ProgressBar, FitsIntoALineWhateverTheName) {
    for (const char* part : {"x", "\u00e9", "\u4e2d"}) {
        std::string name = "reading ";
        for (int i = 0; i < 300; ++i) {
            name += part;
            Terminal terminal;
            ProgressBar(name, 0, terminal.write()).show(0.5);
            ASSERT_EQ(terminal.lines.size(), 2u);
            ASSERT_LE(terminal.lines.front().size(), ProgressBar::kWidth);
            const std::string& line = terminal.lines.front();
            EXPECT_TRUE(line.starts_with("reading "));
            const std::size_t dots = line.find("...");
            if (dots == std::string::npos) continue;
            for (const std::size_t at : {dots, dots + 3}) {
                std::string_view rest = std::string_view(line).substr(at);
                EXPECT_NE(static_cast<unsigned char>(rest[0]) & 0xc0, 0x80) << "a character is cut";
            }
        }
    }
}

TEST(ProgressBar, KeepsVerbNameAndTimeOfALongPath) {
    const std::string folders = "/home/somebody/models/of/last/year/and/of/this/one/";
    EXPECT_EQ(progress_line("reading " + folders + "knot.stl", 50, ", 99999 s left"),
              "reading ...nd/of/this/one/knot.stl  [##########..........]  50 %, 99999 s left");
    EXPECT_EQ(progress_line("examining knot.stl", 5, ", 7 s left"),
              "examining knot.stl  [#...................]   5 %, 7 s left");
    const std::string line =
        progress_line("reading " + folders + std::string(40, 'a') + std::string(40, 'b') + ".stl",
                      100, ", 99999 s left");
    EXPECT_LE(line.size(), ProgressBar::kWidth);
    EXPECT_TRUE(line.starts_with("reading /home")) << line;
    EXPECT_NE(line.find("bbb.stl  ["), std::string::npos) << line;
    EXPECT_LE(progress_line(std::string(90, '\n'), 100, ", 9 s left").size(), ProgressBar::kWidth)
        << "as it is printed";
}

TEST(ProgressBar, TellsOfLongWorkHowMuchTimeIsLeft) {
    EXPECT_EQ(time_left(0.5, 4000), "") << "soon done";
    EXPECT_EQ(time_left(0, 60000), "") << "nobody knows";
    EXPECT_EQ(time_left(0.25, 6000), ", 18 s left");
    EXPECT_EQ(time_left(1, 6000), ", 0 s left");
    EXPECT_EQ(time_left(1e-9, 6000), ", 99999 s left") << "fits into the line";
}

TEST(ProgressBar, SharesOutOfRangeAreItsEnds) {
    Terminal terminal;
    ProgressBar bar("a", 0, terminal.write());
    bar.show(-1);
    bar.show(7);
    ASSERT_EQ(terminal.lines.size(), 2u);
    EXPECT_TRUE(terminal.lines[0].ends_with("  0 %"));
    EXPECT_TRUE(terminal.lines[1].ends_with("100 %"));
}

} // namespace
} // namespace scanout::app
