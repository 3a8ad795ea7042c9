// T4 [Compendium 5.3], HARD-CASES T4: interpolation that is straight on the screen bends textures.
#include "support/scenes.h"
#include "textbook/trap_page.h"

namespace scanout::textbook::test {
namespace {

TEST(Trap04, AffineInterpolationBendsTexturesAndTheErrorGrowsWithTheSpreadOfW) {
    Shot s = scanout::test::shot("floor", 96, 72);
    s.scene.materials = {scanout::test::textured(0)};
    s.scene.textures = {scanout::test::checkers()};
    scanout::test::add_quad(
        s.scene.mesh,
        {{{-0.7F, -0.2F, 0.7F}, {0.7F, -0.2F, 0.7F}, {0.7F, -0.2F, -0.7F}, {-0.7F, -0.2F, -0.7F}}},
        {0, 1, 0}, 0);
    s.options.texture = "nearest";
    s.camera.elevation_degrees = 20;
    int before = 0;
    image::Image wrong, ours;
    for (const double distance : {8.0, 3.0, 1.4}) {
        s.camera.distance = distance;
        s.camera.fov_degrees = 2 * 60 / distance;
        Parts affine;
        affine.interpolation = Interpolation::affine;
        ours = scanout::test::draw(s);
        wrong = picture(s, affine);
        const int bent = different_pixels(wrong, ours, 8);
        EXPECT_GT(bent, before) << distance;
        EXPECT_LT(different_pixels(picture(s), ours, 8), 40) << distance;
        before = bent;
    }
    check_page(
        {4, "affine", "Straight on the screen",
         "A value that changes evenly on the screen does not on the surface: textures bend at "
         "the diagonal of every square, the more the farther its corners' distances lie apart; "
         "value/w and 1/w are even, and their quotient is right.",
         "[Compendium 5.3]",
         fmt::format("{} of {} pixels differ by more than 8 codes", before, 96 * 72),
         enlarged(wrong, 3), enlarged(ours, 3)});
}

} // namespace
} // namespace scanout::textbook::test
