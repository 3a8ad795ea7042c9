// T9 [Compendium 6.2]: depth cleared to 1000, compared with >, and equal depths.
#include "textbook/hidden/hidden.h"
#include "textbook/trap_page.h"

namespace scanout::textbook::test {
namespace {

// Two faces in one plane, as a decal lies on a wall, and a third far away. Mesh x, y are pixels.
Shot wall(bool decal_last) {
    Shot s = scanout::test::shot("wall", 64, 64);
    s.scene.materials = {scanout::test::plain({0.1F, 0.5F, 0.2F}),
                         scanout::test::plain({0.8F, 0.1F, 0.05F})};
    const auto add = [&](float low, float high, int material) {
        scanout::test::add_quad(
            s.scene.mesh,
            {{{low, low, 0.5F}, {high, low, 0.5F}, {high, high, 0.5F}, {low, high, 0.5F}}},
            {0, 0, 1}, material);
    };
    for (const bool decal : {!decal_last, decal_last})
        decal ? add(20, 44, 1) : add(8, 56, 0);
    return s;
}

image::Image naive(const Shot& s) {
    Parts parts = parts_of(Renderer::compendium); // an equal depth passes
    return picture(s, scanout::test::pixel_view(64, 64), parts);
}

TEST(Trap09, WhereEqualDepthsPassTheOrderOfDrawingDecidesAndFartherThan1000IsNothing) {
    // Frame 1 draws the decal last, frame 2, sorted the other way, first.
    const int flickers = different_pixels(naive(wall(true)), naive(wall(false)));
    EXPECT_GT(flickers, 400); // at the others rounding decides
    // Ours: of equal depths the lower number of the file, in whatever order they are drawn.
    using raster::test::Corners;
    const Corners big = {{{2048, 2048}, {14336, 2048}, {2048, 14336}}},
                  small = {{{4096, 4096}, {8192, 4096}, {4096, 8192}}};
    raster::VisibilityTile tile[2];
    for (const bool reversed : {false, true}) {
        tile[reversed].reset({0, 0, 64, 64}, 1);
        if (reversed) tile[1].draw(raster::test::set_up(small, 2));
        tile[reversed].draw(raster::test::set_up(big, 1));
        if (!reversed) tile[0].draw(raster::test::set_up(small, 2));
    }
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            EXPECT_EQ(tile[0].id(x, y), tile[1].id(x, y));
    const Shot s = wall(true);
    for (const int threads : {1, 3}) {
        scanout::test::DrawOptions how;
        how.threads = threads;
        how.tile_size = threads == 1 ? 64 : 32;
        EXPECT_EQ(different_pixels(draw_in_pixels(s, how), draw_in_pixels(s)), 0);
    }
    // Cleared to 1000: z z / z of what lies farther never passes. Ours has no far limit.
    const double cleared = 1000, far_away = 1000.5;
    EXPECT_FALSE(far_away * far_away / far_away <= cleared);
    Shot distant = scanout::test::shot("far", 64, 64);
    scanout::test::add_square(distant.scene.mesh, 0.9F);
    distant.camera.distance = 1100;
    distant.camera.fov_degrees = 0.11;
    EXPECT_GT(different_pixels(scanout::test::draw(distant),
                               image::Image(64, 64, distant.options.background)),
              800);
    image::Image flicker = naive(wall(true));
    const image::Image other = naive(wall(false));
    for (int y = 0; y < 64; ++y) // two frames in one picture: even and odd lines
        for (int x = 0; x < 64 && y % 2 == 1; ++x)
            flicker.at(x, y) = other.at(x, y);
    check_page(
        {9, "equal-depths", "Equal depths",
         "Where a depth that is equal passes, the face that is drawn last shows, so a picture "
         "flickers when faces are sorted anew (even lines: one frame, odd lines: the next); ours "
         "shows the lower number of the file, drawn in any order. And a depth cleared to 1000 "
         "hides what lies farther.",
         "[Compendium 6.2]", fmt::format("{} pixels flicker", flickers), enlarged(flicker, 3),
         enlarged(draw_in_pixels(s), 3)});
}

} // namespace
} // namespace scanout::textbook::test
