#include "math/srgb.h"
#include "support/scenes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

// What a compositor makes of straight alpha over white, in linear light.
double over_white(std::uint8_t code, std::uint8_t alpha) {
    const double share = alpha / 255.0;
    return static_cast<double>(srgb_decode(code)) * share + (1 - share);
}

TEST(TransparentBackground, LaidOverWhiteIsThePictureOnWhite) {
    for (const int samples : {1, 4, 16}) {
        Shot s = solids("over white");
        s.options.samples = samples;
        s.options.background = {0, 0, 0, 0};
        const image::Image clear = draw(s);
        s.options.background = {255, 255, 255, 255};
        const image::Image white = draw(s);
        int partly = 0;
        for (int y = 0; y < clear.height(); ++y) {
            for (int x = 0; x < clear.width(); ++x) {
                const image::Rgba8 c = clear.at(x, y), w = white.at(x, y);
                partly += c.a > 0 && c.a < 255;
                // Half a code of colour, and alpha in whole 255ths.
                ASSERT_NEAR(over_white(c.r, c.a), srgb_decode(w.r), 0.009) << x << ' ' << y;
                ASSERT_NEAR(over_white(c.g, c.a), srgb_decode(w.g), 0.009) << x << ' ' << y;
                ASSERT_NEAR(over_white(c.b, c.a), srgb_decode(w.b), 0.009) << x << ' ' << y;
            }
        }
        EXPECT_EQ(partly > 50, samples > 1);
    }
}

// Tiles without anything in them are not mixed; what they show must be the same.
TEST(TransparentBackground, LooksTheSameWhateverTheTiles) {
    for (const char* aa : {"none", "samples_4", "supersampling_2", "tent", "area"}) {
        for (const image::Rgba8 background :
             {image::Rgba8{200, 100, 50, 0}, {200, 100, 50, 1}, {200, 100, 50, 128}}) {
            Shot s = solids(aa);
            s.options.aa = aa;
            s.options.background = background;
            s.camera.distance = 6; // much of it stays empty
            const image::Image whole = draw(s, {.tile_size = 64});
            for (const int tile : {8, 16, 32})
                EXPECT_EQ(draw(s, {.tile_size = tile}), whole)
                    << aa << " " << int{background.a} << " " << tile;
        }
    }
}

} // namespace
} // namespace scanout::test
