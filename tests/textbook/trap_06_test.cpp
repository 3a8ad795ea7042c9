// T6 [Compendium 7.3], [ClipSpace 1], [Course 5.1], [SoftwareGraphics]: a corner at or behind the
// eye.
#include "textbook/hidden/hidden.h"
#include "textbook/projection.h"
#include "textbook/trap_page.h"

#include <cmath>

namespace scanout::textbook::test {
namespace {

// A floor that begins behind the eye.
Shot floor() {
    Shot s = scanout::test::shot("floor", 96, 72);
    scanout::test::add_quad(
        s.scene.mesh,
        {{{-0.6F, -0.3F, 1.0F}, {0.6F, -0.3F, 1.0F}, {0.6F, -0.3F, -1.0F}, {-0.6F, -0.3F, -1.0F}}},
        {0, 1, 0});
    s.camera.eye = DVec3(0, 0, 0.4);
    s.camera.target = DVec3(0, 0, -1);
    return s;
}

TEST(Trap06, WithoutANearPlaneWhatLiesBehindTheEyeIsDrawnUpsideDown) {
    const Shot s = floor();
    const scene::View view = view_of(s);
    const Projection projection(view, {}, view.near_distance, 10);
    image::Image wrong(96, 72, kPaper);
    int above = 0; // the horizon: pixels that no floor can have
    for (std::size_t t = 0; t < 2; ++t) {
        Triangle triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            const DVec3 place =
                view.linear * DVec3(s.scene.mesh.position[s.scene.mesh.index[3 * t + k]]) +
                view.translation;
            triangle.corner[k] = projection.on_screen({projection.clip_of(place), {}}, 96, 72);
        }
        fill_x_scanline(points_of(triangle), [&](int y, int x0, int x1) {
            for (int x = std::max(x0, 0); x < std::min(x1, 96); ++x)
                if (y >= 0 && y < 72) {
                    wrong.at(x, y) = kInk;
                    above += y < 35 ? 1 : 0;
                }
        });
    }
    EXPECT_GT(above, 200);
    const image::Image ours = scanout::test::draw(s), blank(96, 72, s.options.background);
    image::Image sky_of_ours(96, 35), sky(96, 35);
    for (int y = 0; y < 35; ++y)
        for (int x = 0; x < 96; ++x) {
            sky_of_ours.at(x, y) = ours.at(x, y);
            sky.at(x, y) = s.options.background;
        }
    EXPECT_EQ(different_pixels(sky_of_ours, sky), 0);
    EXPECT_LE(different_pixels(picture(s), ours, 2), 8);
    EXPECT_GT(different_pixels(ours, blank), 1500);
    // At w = 0 there is no division at all.
    EXPECT_FALSE(
        std::isfinite(projection.on_screen({projection.clip_of(DVec3(1, 1, 0)), {}}, 96, 72).x));
    check_page(
        {6, "behind-the-eye", "Behind the eye",
         "A corner behind the eye, divided by its negative w, comes out mirrored, and the face "
         "turns over into the sky; at w = 0 there is nothing to divide by, and close to it "
         "coordinates grow until the viewer hangs. Faces are cut at the near plane before the "
         "division.",
         "[Compendium 7.3], [ClipSpace 6], [Course 5.1]",
         fmt::format("{} pixels of floor above the horizon", above), enlarged(wrong, 3),
         enlarged(ours, 3)});
}

} // namespace
} // namespace scanout::textbook::test
