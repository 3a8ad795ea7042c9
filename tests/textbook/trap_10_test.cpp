// T10 [Primer 4.2.1]: a scanline through a vertex meets two edges there.
#include "textbook/trap_page.h"

#include <algorithm>
#include <cmath>

namespace scanout::textbook::test {
namespace {

// Each edge owns both of its ends: a vertex counts twice, whatever its edges do. A crossing without
// a partner runs on to the edge of the picture.
void fill_counting_both_ends(const Points& p, const Span& span) {
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    for (int y = static_cast<int>(std::ceil(top)); y <= bottom; ++y) {
        std::vector<double> crossings;
        for (std::size_t i = 0; i < 3; ++i) {
            const DVec2 &a = p[i], &b = p[(i + 1) % 3];
            if (a.y != b.y && std::min(a.y, b.y) <= y && y <= std::max(a.y, b.y))
                crossings.push_back(a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y));
        }
        std::sort(crossings.begin(), crossings.end());
        if (crossings.size() % 2 == 1) crossings.push_back(64);
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
            span(y, static_cast<int>(std::ceil(crossings[i])),
                 static_cast<int>(std::ceil(crossings[i + 1])));
    }
}

TEST(Trap10, AVertexThatCountsForBothOfItsEdgesLeavesAnOddNumberOfCrossings) {
    // Corners on whole lines: left, right and in the middle of two triangles.
    const std::vector<Points> triangles = {{DVec2(30, 6), DVec2(8, 28), DVec2(40, 50)},
                                           {DVec2(42, 8), DVec2(56, 30), DVec2(46, 56)}};
    std::map<Pixel, int> naive;
    int wrong = 0;
    for (const Points& p : triangles) {
        const PixelSet one = pixels_of(fill_counting_both_ends, p),
                       right = pixels_of(fill_x_scanline, p);
        for (const Pixel& pixel : one)
            ++naive[pixel];
        PixelSet differ;
        std::set_symmetric_difference(one.begin(), one.end(), right.begin(), right.end(),
                                      std::inserter(differ, differ.end()));
        for (const Pixel& pixel : differ) { // on the line through the middle vertex alone
            EXPECT_EQ(pixel.y, static_cast<int>(p[1].y));
            ++wrong;
        }
    }
    EXPECT_GT(wrong, 30);
    for (const Points& p : triangles) { // ours, and the vertex rule
        const auto ours = production_hits({p});
        EXPECT_EQ(ours, textbook::test::hits_of(fill_x_scanline, p));
    }
    check_page(
        {10, "scanline-vertex", "A line through a vertex",
         "Where a scanline passes a vertex it meets two edges: counted twice at a vertex whose "
         "edges lie on both sides, three crossings are left, the pairs go wrong, and the line "
         "runs to the edge of the picture; a vertex counts once there, and twice or not at all "
         "where both edges lie on one side: an edge owns its upper end alone.",
         "[Primer 4.2.1]", fmt::format("{} pixels of two lines are wrong", wrong),
         enlarged(picture_of(naive, 64, 64), 3),
         enlarged(picture_of(production_hits(triangles), 64, 64), 3)});
}

} // namespace
} // namespace scanout::textbook::test
