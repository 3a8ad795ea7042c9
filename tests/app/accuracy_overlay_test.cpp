#include "app/overlay/accuracy_overlay.h"
#include "app/overlay/text_block.h"
#include "image/heat_map.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

constexpr image::Rgba8 kSky{90, 120, 150, 255};
const std::string kTitle = "error against the reference, codes";
const std::string kNone = "no reference: it draws no lines and points, which this model has";

image::Image sky(int width, int height) {
    return image::Image(width, height, kSky);
}

// The columns and rows that something is drawn in.
image::Rect drawn_in(const image::Image& picture) {
    image::Rect area{picture.width(), picture.height(), 0, 0};
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            if (!(picture.at(x, y) == kSky))
                area = {std::min(area.x0, x), std::min(area.y0, y), std::max(area.x1, x + 1),
                        std::max(area.y1, y + 1)};
    return area;
}

// As many in a narrow picture as in a wide one: nothing is cut off, and nothing overlaps.
std::size_t text_pixels(const image::Image& picture) {
    return static_cast<std::size_t>(
        std::count(picture.pixels().begin(), picture.pixels().end(), kBlockText));
}

TEST(AccuracyOverlay, ALegendStaysAsWideAndAsHighWhateverItSaysOfAPixel) {
    image::Image a = sky(640, 480), b = sky(640, 480);
    draw_error_legend(a, {{kTitle, "1,1: 0 codes", ""}, true}, 453, 1);
    draw_error_legend(
        b, {{kTitle, "639,479: 255 codes", "drawn 255 255 255, reference 255 255 255"}, true}, 453,
        1);
    EXPECT_EQ(drawn_in(a), drawn_in(b));
    EXPECT_EQ(drawn_in(b).y1, 453);
    EXPECT_EQ(drawn_in(b).x1, 640);
}

// Letters that are cut off or overlap would leave fewer pixels of text.
TEST(AccuracyOverlay, ANarrowPictureBreaksTheLinesAndCutsNone) {
    for (const ErrorLegend& legend :
         {ErrorLegend{{kNone}, false}, ErrorLegend{{kTitle, "1,2: 3 codes", "x"}, false}}) {
        image::Image wide = sky(1279, 480);
        draw_error_legend(wide, legend, 453, 1);
        for (const int width : {640, 320, 160}) {
            image::Image narrow = sky(width, 480);
            draw_error_legend(narrow, legend, 453, 1);
            EXPECT_EQ(text_pixels(narrow), text_pixels(wide)) << width;
            EXPECT_GE(drawn_in(narrow).y0, 0);
        }
    }
}

TEST(AccuracyOverlay, TheColoursOfANarrowLegendStandWithinThePicture) {
    for (const int width : {640, 300, 160, 80}) {
        image::Image picture = sky(width, 480);
        draw_error_legend(picture, {{"1"}, true}, 453, 1);
        const auto count = [&](const image::Rgba8& colour) {
            return std::count(picture.pixels().begin(), picture.pixels().end(), colour);
        };
        EXPECT_GE(count(image::heat_colour(0)), 10) << width << ": ten pixels high";
        EXPECT_GE(count(image::heat_colour(1)), 10) << width;
    }
}

TEST(AccuracyOverlay, TheNamesOfTheSidesAreBrokenWhereASideIsNarrow) {
    image::Image wide = sky(1279, 480), narrow = sky(640, 480);
    draw_split_names(wide, {320, "now", kNone}, 453, 1);
    draw_split_names(narrow, {320, "now", kNone}, 453, 1);
    EXPECT_EQ(text_pixels(narrow), text_pixels(wide));
}

// The line is at most a shade of the panel over it.
TEST(AccuracyOverlay, PanelsLieOverTheSplitLine) {
    const std::vector<std::string> rows(20, std::string(50, ' '));
    Overlay help, info, legend;
    for (const std::string& row : rows)
        help.help.columns.resize(1), help.help.columns[0].lines.push_back({{}, "H", row, {}});
    help.help.columns[0].letters = 60;
    info.info = rows;
    legend.legend = ErrorLegend{{kTitle, "", ""}, true};
    for (Overlay overlay : {help, info, legend}) {
        overlay.split = SplitLine{320, "now", "reference"};
        image::Image without = sky(640, 480), with = sky(640, 480);
        Overlay plain = overlay;
        plain.split.reset();
        draw_overlay(without, plain);
        draw_overlay(with, overlay);
        int covered = 0;
        for (int y = 0; y < 480; ++y)
            if (!(without.at(320, y) == kSky)) {
                EXPECT_FALSE(with.at(320, y) == (image::Rgba8{255, 255, 255, 255})) << y;
                ++covered;
            }
        EXPECT_GT(covered, 0);
        EXPECT_EQ(with.at(320, 479), (image::Rgba8{255, 255, 255, 255}));
    }
}

} // namespace
} // namespace scanout::app
