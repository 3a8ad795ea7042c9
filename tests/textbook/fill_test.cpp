// Every fill covers the same pixels, but for those that its trap names.
#include "textbook/pixels.h"

#include <algorithm>
#include <cmath>

namespace scanout::textbook::test {
namespace {

PixelSet only_in(const PixelSet& a, const PixelSet& b) {
    PixelSet out;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::inserter(out, out.end()));
    return out;
}

bool lies_on_an_edge(const Points& p, const Pixel& pixel) {
    for (std::size_t i = 0; i < 3; ++i)
        if (twice_area(p[i], p[(i + 1) % 3], DVec2(pixel.x, pixel.y)) == 0) return true;
    return false;
}

TEST(TextbookFill, OnIntegerVerticesThreeFillsCoverTheSamePixelsOnceEach) {
    Random random(1);
    for (int i = 0; i < 3000; ++i) {
        const Points p = whole_triangle(random, 24);
        const auto expected = hits_of(fill_box_edge_functions, p);
        EXPECT_EQ(hits_of(fill_x_scanline, p), expected);
        EXPECT_EQ(hits_of(fill_box_all_edges, p), expected);
        for (const auto& [pixel, count] : expected)
            EXPECT_EQ(count, 1);
    }
}

// Sums of 1/k miss a pixel centre that an edge passes exactly, by a rounding: on either side.
TEST(TextbookFill, ActiveEdgesDifferOnlyAtPixelsOnAnEdge) {
    Random random(2);
    std::size_t differ = 0, pixels = 0;
    for (int i = 0; i < 3000; ++i) {
        const Points p = whole_triangle(random, 24);
        const PixelSet exact = pixels_of(fill_box_edge_functions, p),
                       stepped = pixels_of(fill_active_edges, p);
        pixels += exact.size();
        for (const PixelSet& odd : {only_in(exact, stepped), only_in(stepped, exact)})
            for (const Pixel& pixel : odd) {
                EXPECT_TRUE(lies_on_an_edge(p, pixel));
                ++differ;
            }
    }
    EXPECT_GT(differ, 0U);
    EXPECT_LT(differ, pixels / 100);
    record("differ", static_cast<double>(differ));
    record("of", static_cast<double>(pixels));
}

// T8: the flat halves as the document has them draw the lower and the right edge, too, and begin a
// line at (int)sx, up to a pixel too early. The pixels of one triangle by name:
TEST(TextbookFill, FlatHalvesDrawThePixelsThatTheirTrapNames) {
    const Points p = {DVec2(1, 0), DVec2(7, 3), DVec2(0, 6)};
    EXPECT_EQ(
        only_in(pixels_of(fill_flat_halves, p), pixels_of(fill_box_edge_functions, p)),
        (PixelSet{{1, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}, {0, 6}, {3, 1}, {5, 2}, {7, 3}}));
}

// Over many triangles: nothing is missed but at a pixel on an edge, where a sum of steps falls
// short; what is more lies on an edge, or less than a pixel to the left of one.
TEST(TextbookFill, FlatHalvesHoldAllPixelsOfTheOthersAndThoseOfTheirTrap) {
    Random random(3);
    int more = 0;
    for (int i = 0; i < 3000; ++i) {
        const Points p = whole_triangle(random, 24);
        const PixelSet exact = pixels_of(fill_box_edge_functions, p),
                       book = pixels_of(fill_flat_halves, p);
        for (const Pixel& pixel : only_in(exact, book))
            EXPECT_TRUE(lies_on_an_edge(p, pixel));
        for (const Pixel& pixel : only_in(book, exact)) {
            const Points left = {DVec2(pixel.x, pixel.y), DVec2(pixel.x + 1, pixel.y),
                                 DVec2(pixel.x, pixel.y)};
            bool touches = false; // the way from the pixel to its right neighbour meets an edge
            for (std::size_t k = 0; k < 3; ++k) {
                const double here = twice_area(p[k], p[(k + 1) % 3], left[0]),
                             there = twice_area(p[k], p[(k + 1) % 3], left[1]);
                touches = touches || here == 0 || there == 0 || (here < 0) != (there < 0);
            }
            EXPECT_TRUE(touches);
            ++more;
        }
    }
    EXPECT_GT(more, 3000);
}

// Between whole coordinates, all fills whose crossings are not stepped from line to line agree but
// where an edge passes a pixel within a rounding.
TEST(TextbookFill, AnywhereTheFillsCoverTheSamePixels) {
    Random random(4);
    for (int i = 0; i < 1000; ++i) {
        Points p;
        for (DVec2& corner : p)
            corner = DVec2(random.in(0, 24), random.in(0, 24));
        const PixelSet expected = pixels_of(fill_box_edge_functions, p);
        EXPECT_EQ(pixels_of(fill_x_scanline, p), expected);
        EXPECT_EQ(pixels_of(fill_active_edges, p), expected);
        EXPECT_EQ(pixels_of(fill_box_all_edges, p), expected);
    }
}

// A line of a triangle is one run, which values can be stepped along.
TEST(TextbookFill, EveryFillGivesALineInOneSpan) {
    Random random(5);
    for (int i = 0; i < 300; ++i) {
        const Points p = whole_triangle(random, 24);
        for (const FillMethod fill :
             {fill_x_scanline, fill_active_edges, fill_box_all_edges, fill_box_edge_functions}) {
            std::map<int, int> spans;
            fill(p, [&](int y, int x0, int x1) { spans[y] += x0 < x1 ? 1 : 0; });
            for (const auto& [y, count] : spans)
                EXPECT_LE(count, 1) << y;
        }
    }
}

TEST(TextbookFill, RunsEndWhereAPixelIsNotIn) {
    const std::string in = ".##.#...###";
    std::vector<std::pair<int, int>> runs;
    for_each_run(
        0, static_cast<int>(in.size()),
        [&](int x) { return in[static_cast<std::size_t>(x)] == '#'; },
        [&](int from, int end) { runs.emplace_back(from, end); });
    EXPECT_EQ(runs, (std::vector<std::pair<int, int>>{{1, 3}, {4, 5}, {8, 11}}));
}

} // namespace
} // namespace scanout::textbook::test
