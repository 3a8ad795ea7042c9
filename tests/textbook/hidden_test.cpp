// Hidden surfaces: methods that must agree do, over several models and views.
#include "support/scenes.h"
#include "textbook/hidden/hidden.h"
#include "textbook/models.h"
#include "textbook/pixels.h"

namespace scanout::textbook::test {
namespace {

using scanout::test::add_sphere;

std::vector<Shot> models() {
    std::vector<Shot> shots = {scanout::test::solids("solids"), scanout::test::ball("ball"),
                               scanout::test::textured_cube("cube", "nearest")};
    for (const char* name : {"spot/spot.obj", "suzanne/suzanne.obj", "dice/dice.glb"})
        shots.push_back(shot_of_model(name, 160, 120));
    for (Shot& s : shots) {
        s.options.width = 160;
        s.options.height = 120;
    }
    return shots;
}

template <class Of>
void for_each_picture(Of of) {
    for (Shot& s : models())
        for (const double azimuth : {0.0, 70.0, 200.0}) {
            s.camera.azimuth_degrees = azimuth;
            s.camera.elevation_degrees = azimuth / 8;
            of(s);
        }
}

// All depths that are right, and windows instead of a buffer, show the same faces.
TEST(TextbookHidden, WarnockAndEveryDepthShowTheSamePicture) {
    int pictures = 0;
    for_each_picture([&](const Shot& s) {
        const image::Image expected = picture(s, with(Hidden::z_pseudo));
        EXPECT_GT(covered_pixels(expected, s), 2000) << s.name;
        for (const Hidden hidden : {Hidden::warnock, Hidden::z_linear, Hidden::z_squared})
            EXPECT_EQ(different_pixels(picture(s, with(hidden)), expected), 0)
                << s.name << ' ' << s.camera.azimuth_degrees << ' ' << static_cast<int>(hidden);
        ++pictures;
    });
    EXPECT_EQ(pictures, 18);
}

// Where faces overlap in no ring and none crosses another, an order by pairs is right to the pixel;
// the order by the middles' distance is not, and the pixels in which it errs are counted. The faces
// of two models cross: the solids', which stand in one another, and the eyes of Suzanne.
TEST(TextbookHidden, PaintersInOrderAgreesWithTheZBufferWhereNoFacesCross) {
    int by_middle = 0, crossing = 0, pictures = 0;
    for_each_picture([&](const Shot& s) {
        const image::Image expected = picture(s, with(Hidden::z_pseudo));
        EXPECT_GT(covered_pixels(expected, s), 2000) << s.name;
        const int wrong = different_pixels(picture(s, with(Hidden::painters_ordered)), expected);
        if (s.name == "solids" || s.name == "suzanne/suzanne.obj") {
            crossing += wrong;
            return;
        }
        EXPECT_EQ(wrong, 0) << s.name << ' ' << s.camera.azimuth_degrees;
        by_middle += different_pixels(picture(s, with(Hidden::painters)), expected);
        ++pictures;
    });
    EXPECT_EQ(pictures, 12);
    EXPECT_GT(crossing, 0);
    EXPECT_GT(by_middle, 0);
    record("wrong_pixels_by_the_middle", by_middle);
    record("wrong_pixels_of_crossing_faces", crossing);
}

// One call of shade a run of pixels, of which values are stepped: the nearest face has whole lines,
// the farther one what is left of them.
TEST(TextbookHidden, ZBuffersShadeRunsOfPixels) {
    Triangle near, far;
    near.corner = {{{8, 2, 0.2, 1, {}}, {24, 2, 0.2, 1, {}}, {16, 26, 0.2, 1, {}}}};
    far.corner = {{{0, 1, 0.6, 1, {}}, {32, 1, 0.6, 1, {}}, {16, 31, 0.6, 1, {}}}};
    const std::vector<Triangle> triangles = {near, far};
    const std::vector<Wire> no_wires;
    for (const Fill fill : {Fill::x_scanline, Fill::box_edge_functions}) {
        const HiddenTask task{triangles, 32, 32, fill_method(fill), false, no_wires, {}};
        std::map<std::pair<const Triangle*, int>, int> runs;
        hidden_z_pseudo(task,
                        [&](const Triangle& t, int y, int, int) { ++runs[std::pair(&t, y)]; });
        EXPECT_EQ((runs[std::pair(&triangles[0], 10)]), 1);
        EXPECT_EQ((runs[std::pair(&triangles[1], 10)]), 2); // to the left and to the right
    }
}

// A convex body without its backs needs no order at all.
TEST(TextbookHidden, WithoutBacksAConvexBodyIsRightInAnyOrder) {
    Shot s = scanout::test::shot("ball", 160, 120);
    add_sphere(s.scene.mesh, Vec3(0), 0.9F, 24, 12);
    s.options.cull = frame::Cull::back;
    const image::Image expected = picture(s, with(Hidden::z_pseudo));
    EXPECT_GT(covered_pixels(expected, s), 2000);
    for (const Hidden hidden : {Hidden::drawing_order, Hidden::painters})
        EXPECT_EQ(different_pixels(picture(s, with(hidden)), expected), 0);
}

// The faces' three ways of clipping: a camera in the middle of things.
TEST(TextbookHidden, ThreeWaysOfClippingShowTheSame) {
    Shot s = scanout::test::solids("solids");
    s.camera.distance = 0.7;
    s.camera.azimuth_degrees = 30;
    const image::Image expected = picture(s);
    EXPECT_GT(covered_pixels(expected, s), 1000);
    for (const Clip clip : {Clip::four_cases, Clip::sutherland_hodgman}) {
        Parts parts;
        parts.clip = clip;
        EXPECT_LE(different_pixels(picture(s, parts), expected), 4) << static_cast<int>(clip);
    }
}

} // namespace
} // namespace scanout::textbook::test
