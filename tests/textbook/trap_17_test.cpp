// T17 [Primer 4.1], [Compendium 2.1]: steep lines, lines to the left, vertical ones, and points.
#include "raster/lines.h"
#include "textbook/trap_page.h"

#include <algorithm>
#include <cmath>

namespace scanout::textbook::test {
namespace {

PixelSet production_pixels(Pixel a, Pixel b) {
    static raster::VisibilityTile tile;
    PixelSet out;
    for (const auto& [x, y] : raster::test::line_pixels({a.x * 256 + 128, a.y * 256 + 128},
                                                        {b.x * 256 + 128, b.y * 256 + 128}, tile))
        out.insert({x, y});
    return out;
}

// All pixels are reached from `from`, each from one of its eight neighbours.
bool is_connected(const PixelSet& pixels, Pixel from) {
    PixelSet reached = {from};
    std::vector<Pixel> open = {from};
    while (!open.empty()) {
        const Pixel p = open.back();
        open.pop_back();
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (const Pixel q{p.x + dx, p.y + dy};
                    pixels.count(q) > 0 && reached.insert(q).second)
                    open.push_back(q);
    }
    return reached.size() == pixels.size() && pixels.count(from) > 0;
}

TEST(Trap17, SteepLinesHaveGapsAndLinesToTheLeftAreNotThere) {
    EXPECT_EQ(pixels_of(line_kx_b, {10, 10}, {4, 12}).size(), 0U);  // to the left
    EXPECT_EQ(pixels_of(line_kx_b, {10, 10}, {10, 20}).size(), 0U); // k = 10/0
    EXPECT_EQ(pixels_of(line_kx_b, {10, 10}, {10, 10}).size(), 0U); // k = 0/0
    EXPECT_EQ(pixels_of(line_dda_one_axis, {0, 1}, {2, 5}),
              (PixelSet{{0, 1}, {1, 3}, {2, 5}})); // the document's figure
    EXPECT_EQ(pixels_of(line_dda_one_axis, {10, 10}, {10, 20}).size(), 1U);
    std::map<Pixel, int> naive, ours;
    int gaps = 0, missing = 0, lines = 0;
    for (int i = 0; i < 24; ++i) {
        const double angle = 2 * 3.14159265358979 * i / 24;
        const Pixel a{31, 31}, b{31 + static_cast<int>(std::lround(26 * std::cos(angle))),
                                 31 + static_cast<int>(std::lround(26 * std::sin(angle)))};
        const PixelSet one = pixels_of(line_kx_b, a, b);
        missing += one.empty() ? 1 : 0;
        gaps += one.empty() || is_connected(one, a) ? 0 : 1;
        for (const Pixel& p : one)
            naive[p] = 1;
        const PixelSet right = production_pixels(a, b);
        EXPECT_TRUE(is_connected(right, a) && right.count(b) > 0);
        for (const LineMethod line : {line_dda, line_midpoint, line_bresenham})
            EXPECT_TRUE(is_connected(pixels_of(line, a, b), a));
        for (const Pixel& p : right)
            ours[p] = 1;
        ++lines;
    }
    EXPECT_EQ(production_pixels({10, 10}, {10, 10}), (PixelSet{{10, 10}}));
    EXPECT_EQ(missing, 13); // eleven to the left, two upright
    EXPECT_EQ(gaps, 4);
    check_page(
        {17, "line-ends", "Steep lines, and those to the left",
         "y = k x + b draws a pixel a column: steep lines fall apart, a vertical one has no k, and "
         "a loop from x0 to x1 draws nothing to the left; the one-axis DDA turns such lines round, "
         "and has the same gaps. The longer axis must lead. Ours draws every pixel whose diamond "
         "the line touches, both "
         "ends included.",
         "[Primer 4.1], [Compendium 2.1]",
         fmt::format("of {} lines {} have gaps and {} are not there", lines, gaps, missing),
         enlarged(picture_of(naive, 64, 64), 3), enlarged(picture_of(ours, 64, 64), 3)});
}

} // namespace
} // namespace scanout::textbook::test
