// Pictures whose layers' colours decide what shows of that which lies behind: --blend multiply and
// screen, wherever a pixel's samples may go.
#include "image/compare.h"
#include "support/scenes.h"
#include "support/srgb_formula.h"

#include <array>
#include <cmath>

namespace scanout::test {
namespace {

constexpr const char* kModes[] = {"multiply", "screen"};

struct Layer {
    Vec3 colour;
    float alpha;
};

// Sheets before the whole picture, nearest first, each of one light everywhere.
Shot sheets(const std::vector<Layer>& layers, const char* mode) {
    Shot s = shot("sheets", 40, 40);
    s.options.blend = mode;
    s.options.lights = {light_of(scene::LightKind::ambient, 1)};
    s.options.tone = "clamp";
    s.camera.projection = scene::Projection::orthographic;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        s.scene.materials.push_back(glass(layers[i].colour, layers[i].alpha));
        add_square(s.scene.mesh, 9, -0.1F * static_cast<float>(i), static_cast<int>(i));
    }
    s.scene.mesh.uv.clear();
    return s;
}

image::Rgba8 middle(const Shot& s) {
    return draw(s).at(20, 20);
}

int difference(const image::Image& a, const image::Image& b) {
    return image::compare(a, b).max_difference;
}

TEST(Composing, MultiplyByWhiteAndScreenOfBlackLeaveThePictureAsItIs) {
    for (const char* mode : kModes) {
        for (const int samples : {1, 4}) {
            Shot s = solids("behind");
            s.options.samples = samples;
            s.options.tone = "clamp";
            s.options.background = {10, 99, 200, 255};
            const image::Image without = draw(s);
            s.options.blend = mode;
            scene::Material sheet = glass(Vec3(0), 0.7F);
            if (mode == std::string("multiply")) sheet.emission = Vec3(1);
            s.scene.materials.push_back(sheet);
            const int material = static_cast<int>(s.scene.materials.size()) - 1;
            add_square(s.scene.mesh, 0.9F, 0.9F, material);
            add_square(s.scene.mesh, 0.9F, -0.9F, material);
            EXPECT_EQ(difference(draw(s), without), 0) << mode << ' ' << samples;
            s.scene.materials.back().emission = Vec3(0.5F);
            EXPECT_GT(difference(draw(s), without), 20) << mode << ' ' << samples;
        }
    }
}

TEST(Composing, ColouredGlassTakesAndProjectorsAddOneChannelEach) {
    const Layer wall{{1, 1, 1}, 1}, red{{1, 0, 0}, 0.9999F}, green{{0, 1, 0}, 0.9999F};
    const auto close = [](const image::Rgba8& a, const std::array<int, 3>& b) {
        return std::abs(a.r - b[0]) < 3 && std::abs(a.g - b[1]) < 3 && std::abs(a.b - b[2]) < 3;
    };
    EXPECT_TRUE(close(middle(sheets({red, wall}, "multiply")), {255, 0, 0}));
    EXPECT_TRUE(close(middle(sheets({red, green, wall}, "multiply")), {0, 0, 0}));
    const Layer black{{0, 0, 0}, 1};
    EXPECT_TRUE(close(middle(sheets({red, black}, "screen")), {255, 0, 0}));
    EXPECT_TRUE(close(middle(sheets({red, green, black}, "screen")), {255, 255, 0}));
    EXPECT_TRUE(close(middle(sheets({red, wall}, "screen")), {255, 255, 255}));
}

TEST(Composing, TheOrderOfLayersDoesNotMatterBeforeWhatIsOpaque) {
    const std::vector<Layer> layers = {
        {{0.9F, 0.2F, 0.4F}, 0.8F}, {{0.3F, 0.8F, 0.9F}, 0.3F}, {{0.5F, 0.6F, 0.1F}, 0.99F}};
    const std::vector<Layer> others = {layers[2], layers[0], layers[1]};
    for (const char* mode : {"multiply", "screen", "over"}) {
        const image::Image a = draw(sheets(layers, mode)), b = draw(sheets(others, mode));
        if (mode == std::string("over"))
            EXPECT_GT(difference(a, b), 20);
        else
            EXPECT_LE(difference(a, b), 1) << mode;
    }
}

// All samples alike: no way of mixing them may change the picture.
TEST(Composing, EveryAntiAliasingAndFilterAgreesWhereAllSamplesAreAlike) {
    const std::vector<Layer> layers = {{{0.9F, 0.2F, 0.4F}, 0.8F}, {{0.3F, 0.8F, 0.9F}, 0.3F}};
    for (const char* mode : kModes) {
        for (const int alpha : {255, 100, 0}) {
            for (const bool wall : {false, true}) {
                Shot s = sheets(layers, mode);
                s.options.background = {200, 30, 90, static_cast<std::uint8_t>(alpha)};
                if (wall) {
                    s.scene.materials.push_back(plain({0.7F, 0.6F, 0.2F}));
                    add_square(s.scene.mesh, 9, -0.9F, 2);
                    s.scene.mesh.uv.clear();
                }
                const image::Image one = draw(s);
                for (const char* aa : {"samples_2", "samples_16", "tent", "gaussian",
                                       "supersampling_2", "supersampling_4", "area"}) {
                    s.options.aa = aa;
                    EXPECT_LE(difference(draw(s), one), 1)
                        << mode << ' ' << aa << ' ' << alpha << ' ' << wall;
                }
            }
        }
    }
}

TEST(Composing, InCodesMultipliesCodes) {
    for (const char* mode : kModes) {
        Shot s = sheets({{{0.9F, 0.2F, 0.4F}, 0.75F}}, mode);
        s.options.background = {200, 120, 40, 255};
        s.options.blend_space = "encoded";
        const image::Rgba8 p = middle(s);
        const int got[3] = {p.r, p.g, p.b};
        const double back[3] = {200, 120, 40};
        for (int k = 0; k < 3; ++k) {
            const double b = back[k] / 255;
            const double layer = encoded(s.scene.materials[0].diffuse[k]) / 255;
            const double mixed =
                mode == std::string("multiply") ? b * layer : b + layer - b * layer;
            EXPECT_NEAR(got[k], 255 * (0.75 * mixed + 0.25 * b), 1.1) << mode << ' ' << k;
        }
    }
}

// The light that is kept before any code is that of the picture; the blend space is no part of it.
TEST(Composing, KeepsItsLight) {
    for (const char* mode : kModes) {
        Shot s = sheets({{{0.9F, 0.2F, 0.4F}, 0.75F}, {{0.8F, 0.7F, 0.6F}, 1}}, mode);
        shade::LinearPicture linear, other;
        const image::Image picture = draw(s, {.linear = &linear});
        const std::array<float, 4>& light = linear.at(20, 20);
        const image::Rgba8 p = picture.at(20, 20);
        const int got[3] = {p.r, p.g, p.b};
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(got[k], encoded(double{light[k]}), 0.51) << mode;
        EXPECT_EQ(light[3], 1);
        s.options.blend_space = "encoded";
        draw(s, {.linear = &other});
        EXPECT_EQ(linear, other) << mode;
    }
}

// A surface brighter than white is no brighter a filter than white.
TEST(Composing, LayersAreNoBrighterThanWhite) {
    for (const char* mode : kModes)
        EXPECT_EQ(middle(sheets({{Vec3(7), 0.6F}, {{0.3F, 0.5F, 0.1F}, 1}}, mode)),
                  middle(sheets({{Vec3(1), 0.6F}, {{0.3F, 0.5F, 0.1F}, 1}}, mode)))
            << mode;
}

} // namespace
} // namespace scanout::test
