// --hidden none: the edges of a mesh, each once, to the borders of the picture.
#include "support/scenes.h"
#include "textbook/models.h"
#include "textbook/wires.h"

#include <limits>

namespace scanout::textbook::test {
namespace {

constexpr std::array kLineClips = {Clip::cohen_sutherland, Clip::midpoint_subdivision,
                                   Clip::liang_barsky};

Parts wires_by(Line line, Clip clip = Clip::liang_barsky) {
    Parts parts = with(Hidden::none);
    parts.line = line;
    parts.line_clip = clip;
    return parts;
}

TEST(TextbookWires, EveryLineMethodDrawsTheEdges) {
    const Shot s = scanout::test::solids("solids");
    const image::Image expected = picture(s, wires_by(Line::bresenham));
    for (const Line line : {Line::dda, Line::midpoint, Line::bresenham, Line::wu}) {
        const image::Image drawn = picture(s, wires_by(line));
        EXPECT_GT(covered_pixels(drawn, s), 200);
        EXPECT_LT(different_pixels(drawn, expected, 128), 300);
    }
}

// A square that fills the picture, from border to border: its sides are the outermost pixels.
TEST(TextbookWires, SidesOnTheBordersOfThePictureAreDrawn) {
    for (const int size : {1, 2, 8, 31}) {
        Shot s = scanout::test::shot("square", size, size);
        const auto far = static_cast<float>(size);
        scanout::test::add_quad(s.scene.mesh,
                                {{{0, 0, 0}, {far, 0, 0}, {far, far, 0}, {0, far, 0}}}, {0, 0, 1});
        for (const Clip clip : kLineClips) {
            const image::Image drawn =
                picture(s, scanout::test::pixel_view(size, size), wires_by(Line::bresenham, clip));
            for (int i = 0; i < size; ++i)
                for (const Pixel& p : {Pixel{i, 0}, {i, size - 1}, {0, i}, {size - 1, i}})
                    EXPECT_FALSE(drawn.at(p.x, p.y) == s.options.background)
                        << size << ": " << p.x << ' ' << p.y;
        }
    }
}

// A model that is larger than the picture, from outside and from within: each clip cuts lines, and
// all draw the same but for the pixels at an end that rounds the other way.
TEST(TextbookWires, EachLineClipCutsWhatLeavesThePicture) {
    for (const double distance : {1.2, 0.4}) {
        Shot s = scanout::test::solids("solids");
        s.camera.distance = distance;
        const Look look = look_of(s);
        const Box box{-0.5, -0.5, look.width - 0.5, look.height - 0.5};
        const auto wires = wires_of(s.scene.mesh, view_of(s), look, with(Hidden::none));
        const image::Image expected = picture(s, wires_by(Line::bresenham));
        EXPECT_GT(covered_pixels(expected, s), 150) << distance;
        for (const Clip clip : kLineClips) {
            int cut = 0, gone = 0;
            for (const Wire& wire : wires) {
                const auto left = line_clip(clip)({wire.from, wire.to}, box);
                gone += left ? 0 : 1;
                cut += left && (!(left->first == wire.from) || !(left->second == wire.to)) ? 1 : 0;
            }
            EXPECT_GT(cut, 10) << static_cast<int>(clip);
            EXPECT_GT(gone, 10) << static_cast<int>(clip);
            EXPECT_LE(different_pixels(picture(s, wires_by(Line::bresenham, clip)), expected), 8)
                << distance << ' ' << static_cast<int>(clip);
        }
    }
}

// A cube has 12 edges and 6 diagonals, although its faces share no vertex; of those with a front,
// that is of three faces, 9 and 3.
TEST(TextbookWires, AnEdgeThatFacesShareIsDrawnOnce) {
    Shot s = scanout::test::shot("cube", 64, 64);
    scanout::test::add_cube(s.scene.mesh, 0.5F);
    s.camera.azimuth_degrees = 30;
    s.camera.elevation_degrees = 25;
    const auto count = [&](Left left) {
        Look look = look_of(s);
        look.left = left;
        return wires_of(s.scene.mesh, view_of(s), look, with(Hidden::none)).size();
    };
    EXPECT_EQ(count(Left::none), 18U);
    EXPECT_EQ(count(Left::backs), 12U);
    EXPECT_EQ(count(Left::fronts), 12U);
}

// The near plane cuts a floor that begins behind the eye: its edges and its one diagonal stay
// lines, and no side of the cut is an edge.
TEST(TextbookWires, TheNearPlaneCutsAnEdgeAndMakesNone) {
    Shot s = scanout::test::shot("floor", 96, 72);
    scanout::test::add_quad(
        s.scene.mesh,
        {{{-0.6F, -0.3F, 1}, {0.6F, -0.3F, 1}, {0.6F, -0.3F, -1}, {-0.6F, -0.3F, -1}}}, {0, 1, 0});
    s.camera.eye = DVec3(0, 0, 0.4);
    s.camera.target = DVec3(0, 0, -1);
    const auto wires = wires_of(s.scene.mesh, view_of(s), look_of(s), with(Hidden::none));
    EXPECT_EQ(wires.size(), 4U); // the side behind the eye is not there
    for (const Wire& wire : wires)
        EXPECT_TRUE(wire.from.y > 35 && wire.to.y > 35) << "above the horizon";
}

TEST(TextbookWires, EndsThatAreNoNumbersEndTheSearch) {
    const double infinite = std::numeric_limits<double>::infinity(),
                 none = std::numeric_limits<double>::quiet_NaN();
    const Box box{0, 0, 8, 8};
    for (const double odd : {infinite, -infinite, none}) {
        EXPECT_FALSE(clip_midpoint_subdivision({DVec2(odd, 1), DVec2(4, 4)}, box));
        EXPECT_FALSE(clip_midpoint_subdivision({DVec2(4, 4), DVec2(1, odd)}, box));
    }
    const auto far = clip_midpoint_subdivision({DVec2(-1e308, 4), DVec2(1.5e308, 4)}, box);
    ASSERT_TRUE(far);
    EXPECT_NEAR(far->first.x, 0, 0.01);
    EXPECT_NEAR(far->second.x, 8, 0.01);
}

} // namespace
} // namespace scanout::textbook::test
