// The light before it is encoded: what the picture is the code of.
#include "image/compare.h"
#include "math/srgb.h"
#include "support/scenes.h"
#include "support/srgb_formula.h"

#include <algorithm>
#include <cmath>

namespace scanout::test {
namespace {

TEST(LinearPicture, IsWhatThePictureEncodes) {
    for (const int samples : {1, 8}) {
        Shot s = solids("linear");
        s.options.samples = samples;
        shade::LinearPicture linear;
        const image::Image picture = draw(s, {.linear = &linear});
        ASSERT_EQ(linear.width, picture.width());
        const image::Rgba8 back = s.options.background;
        const double behind[3] = {srgb_decode(back.r), srgb_decode(back.g), srgb_decode(back.b)};
        int partly = 0;
        for (int y = 0; y < picture.height(); ++y) {
            for (int x = 0; x < picture.width(); ++x) {
                const auto& light = linear.at(x, y);
                partly += light[3] > 0 && light[3] < 1;
                const image::Rgba8 code = picture.at(x, y);
                const int codes[3] = {code.r, code.g, code.b};
                for (std::size_t c = 0; c < 3; ++c)
                    EXPECT_NEAR(codes[c],
                                encoded(double{light[c]} + behind[c] * (1 - double{light[3]})),
                                0.51)
                        << x << ", " << y;
            }
        }
        EXPECT_EQ(partly > 50, samples > 1);
    }
}

TEST(LinearPicture, ChangesNoBitOfThePictureAndDependsOnNoThread) {
    Shot s = soup("linear", 300, 0.9, 7);
    s.options.samples = 4;
    shade::LinearPicture one, two;
    const image::Image plain = draw(s);
    EXPECT_EQ(image::compare(draw(s, {.linear = &one}), plain).differing_pixels, 0);
    EXPECT_EQ(image::compare(draw(s, {.threads = 2, .tile_size = 32, .linear = &two}), plain)
                  .differing_pixels,
              0);
    EXPECT_EQ(one, two);
}

TEST(LinearPicture, KeepsWhatIsBrighterThanWhite) {
    Shot s = solids("bright");
    for (scene::Material& material : s.scene.materials)
        material.diffuse = Vec3(50);
    shade::LinearPicture linear;
    draw(s, {.linear = &linear});
    EXPECT_TRUE(std::any_of(linear.pixel.begin(), linear.pixel.end(),
                            [](const auto& p) { return p[0] > 20; }));
}

} // namespace
} // namespace scanout::test
