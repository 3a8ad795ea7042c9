// Lines of textbooks: those that hold everywhere hold the same laws; the others are a trap
// (trap_17_test.cpp).
#include "textbook/pixels.h"

#include <algorithm>
#include <cmath>

namespace scanout::textbook::test {
namespace {

int steps_between(Pixel a, Pixel b) {
    return std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
}

// In every direction: one pixel a step, both ends, no pixel farther than half a pixel from the
// line.
TEST(TextbookLine, DdaMidpointAndBresenhamDrawOnePixelAStepNextToTheLine) {
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
        const Pixel a{random.whole(-20, 20), random.whole(-20, 20)},
            b{random.whole(-20, 20), random.whole(-20, 20)};
        for (const LineMethod line : {line_dda, line_midpoint, line_bresenham}) {
            const PixelSet pixels = pixels_of(line, a, b);
            const int steps = steps_between(a, b);
            ASSERT_EQ(pixels.size(), static_cast<std::size_t>(steps) + 1);
            EXPECT_TRUE(pixels.count(a) == 1 && pixels.count(b) == 1);
            for (const Pixel& p : pixels) {
                if (steps == 0) continue;
                const double cross = static_cast<double>(b.x - a.x) * (p.y - a.y) -
                                     static_cast<double>(b.y - a.y) * (p.x - a.x);
                EXPECT_LE(std::abs(cross) / steps, 0.5 + 1e-9); // along the shorter axis
            }
        }
    }
}

// Where the line passes half way between two pixels either may be drawn; nowhere else they differ.
TEST(TextbookLine, DdaMidpointAndBresenhamDifferOnlyWhereTwoPixelsAreEquallyNear) {
    Random random(2);
    int ties = 0;
    for (int i = 0; i < 2000; ++i) {
        const Pixel a{0, 0}, b{random.whole(-20, 20), random.whole(-20, 20)};
        const int steps = steps_between(a, b);
        const PixelSet one = pixels_of(line_bresenham, a, b);
        for (const LineMethod line : {line_dda, line_midpoint}) {
            PixelSet differ;
            const PixelSet other = pixels_of(line, a, b);
            std::set_symmetric_difference(one.begin(), one.end(), other.begin(), other.end(),
                                          std::inserter(differ, differ.end()));
            for (const Pixel& p : differ) {
                const int cross = b.x * p.y - b.y * p.x;
                EXPECT_EQ(2 * std::abs(cross), steps) << b.x << ' ' << b.y;
                ++ties;
            }
        }
    }
    EXPECT_GT(ties, 100);
}

TEST(TextbookLine, WuGivesEveryStepTheWeightOfOnePixelAboutTheLine) {
    Random random(3);
    for (int i = 0; i < 500; ++i) {
        const Pixel a{random.whole(-20, 20), random.whole(-20, 20)},
            b{random.whole(-20, 20), random.whole(-20, 20)};
        const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x);
        std::map<int, double> weight, place; // along the longer axis; the mean across it
        line_wu(a, b, [&](int x, int y, double share) {
            weight[steep ? y : x] += share;
            place[steep ? y : x] += share * (steep ? x : y);
        });
        EXPECT_EQ(weight.size(), static_cast<std::size_t>(steps_between(a, b)) + 1);
        const int begin = steep ? a.y : a.x, steps = (steep ? b.y : b.x) - begin;
        const double across = steep ? a.x : a.y, rise = (steep ? b.x : b.y) - across;
        for (const auto& [step, sum] : weight) {
            EXPECT_NEAR(sum, 1, 1e-12);
            const double way = steps == 0 ? 0 : static_cast<double>(step - begin) / steps;
            EXPECT_NEAR(place[step], across + rise * way, 1e-12);
        }
    }
}

// The document's own lines: (0, 1)-(3, 4), and (0, 1)-(2, 5), which is steep.
TEST(TextbookLine, TheDocumentsExamplesAreDrawnAsItDrawsThem) {
    const PixelSet diagonal = {{0, 1}, {1, 2}, {2, 3}, {3, 4}};
    for (const LineMethod line :
         {line_kx_b, line_dda_one_axis, line_dda, line_midpoint, line_bresenham})
        EXPECT_EQ(pixels_of(line, {0, 1}, {3, 4}), diagonal);
    EXPECT_EQ(pixels_of(line_dda, {0, 1}, {2, 5}),
              (PixelSet{{0, 1}, {1, 2}, {1, 3}, {2, 4}, {2, 5}}));
}

} // namespace
} // namespace scanout::textbook::test
