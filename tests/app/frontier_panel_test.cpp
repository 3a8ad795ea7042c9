#include "app/overlay/frontier_panel.h"
#include "app/overlay/overlay.h"
#include "app/overlay/text_block.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

constexpr image::Rgba8 kHere{255, 196, 64, 255};

struct Centre {
    double x = 0, y = 0;
    int pixels = 0;
};

// Of the pixels that have the colour of the dot that says where we are.
Centre here(const FrontierPanel& panel) {
    image::Image picture(640, 480, image::Rgba8{40, 40, 40, 255});
    draw_frontier_panel(picture, panel, 20, 1);
    Centre c;
    for (int y = 0; y < 480; ++y)
        for (int x = 0; x < 640; ++x)
            if (picture.at(x, y) == kHere) {
                c.x += x;
                c.y += y;
                ++c.pixels;
            }
    if (c.pixels > 0) c.x /= c.pixels, c.y /= c.pixels;
    return c;
}

TEST(FrontierPanel, TheDotGoesRightAndDownToSlowerAndMoreAccurate) {
    FrontierPanel panel{{"1 of 3", "2.00 ms  8.00 codes RMSE"}, {{2, 8}, {4, 2}, {8, 0.5}}, 0};
    const Centre first = here(panel);
    EXPECT_GT(first.pixels, 40);
    panel.at = 1;
    const Centre middle = here(panel);
    panel.at = 2;
    const Centre last = here(panel);
    EXPECT_NEAR(middle.x, (first.x + last.x) / 2, 1) << "logarithms: 2, 4, 8";
    EXPECT_NEAR(middle.y, (first.y + last.y) / 2, 1);
    EXPECT_LT(first.x + 100, last.x);
    EXPECT_LT(first.y + 50, last.y);
}

TEST(FrontierPanel, TheOverlayDrawsItAndTheHelpSheetTakesItsRoom) {
    Overlay overlay;
    overlay.frontier = FrontierPanel{{"2.00 ms  8.00 codes RMSE"}, {{2, 8}, {4, 2}}, 0};
    image::Image picture(640, 480, image::Rgba8{40, 40, 40, 255}), panel = picture;
    draw_frontier_panel(panel, *overlay.frontier, 0, 1);
    draw_overlay(picture, overlay);
    EXPECT_EQ(picture, panel);
    overlay.help = {{{{{{}, "H", "help", {}}}, 1, 7}}, ""};
    draw_overlay(picture = image::Image(640, 480), overlay);
    EXPECT_EQ(std::count(picture.pixels().begin(), picture.pixels().end(), kHere), 0);
}

TEST(FrontierPanel, WithoutPointsOrWithOneItIsTextAlone) {
    FrontierPanel panel{{"frontier: measuring, 43 %"}, {}, 0};
    EXPECT_EQ(here(panel).pixels, 0);
    panel.points = {{2, 8}};
    EXPECT_EQ(here(panel).pixels, 0);
}

TEST(FrontierPanel, PointsWithoutErrorAndEqualOnesStayInThePlot) {
    FrontierPanel panel{{"x"}, {{2, 1}, {2, 0}, {2, 0}}, 1};
    const Centre c = here(panel);
    EXPECT_GT(c.pixels, 40);
    EXPECT_GT(c.x, 640 - 320);
    EXPECT_LT(c.y, 200);
    image::Image tiny(20, 10);
    draw_frontier_panel(tiny, panel, 0, 1); // clipped
}

} // namespace
} // namespace scanout::app
