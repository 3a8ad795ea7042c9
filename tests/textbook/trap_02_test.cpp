// T2 [Compendium 2.2]: a near-horizontal edge moves by thousands of pixels a line.
#include "textbook/trap_page.h"

#include <algorithm>

namespace scanout::textbook::test {
namespace {

TEST(Trap02, SpansShootOutOfTheTriangleAlongANearHorizontalEdge) {
    // The document's figure: from 4.25, to 3.5 and 5.05, in 2e-5 of a line: dx = -37500 and 40000.
    const Points p = {DVec2(4.25, 9.99999), DVec2(3.5, 10.00001), DVec2(5.05, 10.00001)};
    EXPECT_NEAR((p[1].x - p[0].x) / (p[1].y - p[0].y), -37500, 1e-3);
    EXPECT_NEAR((p[2].x - p[0].x) / (p[2].y - p[0].y), 40000, 1e-3);
    int left = 0, right = 0;
    const auto widest = [&](int, int x0, int x1) {
        left = std::min(left, x0);
        right = std::max(right, x1 - 1);
    };
    fill_flat_halves_unclamped(p, widest);
    EXPECT_EQ(left, -37495); // (int)-37495.75
    EXPECT_EQ(right, 40004); // of 40004.25
    // Clamped, as the document ends up: within 3.5 to 5.05.
    left = right = 4;
    fill_flat_halves(p, widest);
    EXPECT_EQ(left, 3);
    EXPECT_EQ(right, 5);
    for (const FillMethod fill : {fill_x_scanline, fill_active_edges, fill_box_edge_functions})
        for (const Pixel& pixel : pixels_of(fill, p))
            EXPECT_TRUE(pixel.x >= 4 && pixel.x <= 5);

    const Points shown = {DVec2(20.25, 20.99), DVec2(44, 21.01), DVec2(30, 50)};
    const auto naive = hits_of(fill_flat_halves_unclamped, shown);
    std::map<Pixel, int> in_picture;
    for (const auto& [pixel, count] : naive)
        if (pixel.x >= 0 && pixel.x < 64) in_picture[pixel] = 1;
    const auto ours = production_hits({shown});
    for (const auto& [pixel, count] : ours)
        EXPECT_TRUE(pixel.x >= 20 && pixel.x <= 44 && pixel.y >= 20 && pixel.y <= 50);
    EXPECT_GT(naive.size(), ours.size() + 1000);
    check_page(
        {2, "near-horizontal-edge", "A near-horizontal edge",
         "A side that moves by 1/slope a line moves by thousands of pixels where its edge is "
         "almost level, and the span shoots out of the triangle; the document clamps both ends, "
         "ours asks three edge functions at each pixel and steps nothing.",
         "[Compendium 2.2]",
         "dx is -37500 and 40000 in the document's figure, the line from -37495 to 40004; here "
         "a line of " +
             std::to_string(naive.size() - ours.size()) + " pixels too many",
         enlarged(picture_of(in_picture, 64, 64), 3), enlarged(picture_of(ours, 64, 64), 3)});
}

} // namespace
} // namespace scanout::textbook::test
