// T15 [Compendium 3.3], HARD-CASES T15: texels at u = 1, texel centres, and which way v runs.
#include "support/scenes.h"
#include "textbook/texture.h"
#include "textbook/trap_page.h"

namespace scanout::textbook::test {
namespace {

TEST(Trap15, UOfOneAddressesATexelPastTheEnd) {
    const scene::Texture checkers = scanout::test::checkers();
    const image::Image& texture = checkers.image;
    const int w = texture.width(), h = texture.height();
    EXPECT_EQ(static_cast<int>(1.0 * w), w); // past the end
    // Scaled by w - 1 it stays inside, and the last texel has a single point: u = 1.
    EXPECT_EQ(static_cast<int>(0.999 * (w - 1)), w - 2);
    scene::TextureMap clamped;
    clamped.wrap_u = clamped.wrap_v = scene::Wrap::clamp;
    for (int y = 0; y < h; ++y) // ours: texel i lies from i/w to (i + 1)/w, v up
        for (int x = 0; x < w; ++x) {
            const DVec3 texel = nearest_texel(texture, clamped, (x + 0.5) / w, (y + 0.5) / h);
            EXPECT_EQ(texel.x > 0.5, texture.at(x, h - 1 - y).r > 127);
        }
    for (const double one : {1.0, 1.0 - 0x1p-53, 0.0, -1.0, 17.0})
        for (const scene::Wrap wrap :
             {scene::Wrap::repeat, scene::Wrap::mirror, scene::Wrap::clamp}) {
            scene::TextureMap map;
            map.wrap_u = map.wrap_v = wrap;
            nearest_texel(texture, map, one, one); // in the picture: the sanitizers look
        }

    Shot s = scanout::test::shot("square", 64, 64);
    s.scene.materials = {scanout::test::textured(0)};
    s.scene.textures = {checkers};
    scene::TextureMap& map = s.scene.materials[0].map_diffuse.edit();
    map.wrap_u = map.wrap_v = scene::Wrap::clamp;
    scanout::test::add_quad(s.scene.mesh, {{{8, 8, 0}, {56, 8, 0}, {56, 56, 0}, {8, 56, 0}}},
                            {0, 0, 1}, 0);
    s.options.texture = "nearest";
    scene::Light everywhere;
    everywhere.kind = scene::LightKind::ambient;
    s.options.lights = {everywhere};
    const image::Image ours = draw_in_pixels(s);
    image::Image wrong(64, 64, s.options.background);
    for (int y = 8; y < 56; ++y) // row 0 is the picture's first, u scaled by w - 1
        for (int x = 8; x < 56; ++x)
            wrong.at(x, y) = texture.at(static_cast<int>((x + 0.5 - 8) / 48 * (w - 1)),
                                        static_cast<int>((55.5 - y) / 48 * (h - 1)));
    EXPECT_EQ(different_pixels(picture(s, scanout::test::pixel_view(64, 64), {}), ours), 0);
    EXPECT_GT(different_pixels(wrong, ours, 8), 500);
    check_page(
        {15, "texels", "The texel past the end",
         "(int)(u w) is past the end at u = 1, and scaled by w - 1 instead, seven columns share "
         "the width of eight and the last one is lost; row 0 is the picture's first line, but v "
         "runs up, so it stands on its head. Texel i lies from i/w to (i + 1)/w.",
         "[Compendium 3.3]",
         fmt::format("{} of {} pixels differ", different_pixels(wrong, ours, 8), 48 * 48),
         enlarged(wrong, 3), enlarged(ours, 3)});
}

} // namespace
} // namespace scanout::textbook::test
