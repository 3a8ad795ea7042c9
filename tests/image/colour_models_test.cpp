// Models of colour: published values, round trips, bounds, views of channels.
#include "image/colour_models.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace scanout::image {
namespace {

const ColourModel& model(std::string_view name) {
    return *find_colour_model(name);
}

DVec3 of(std::string_view name, int r, int g, int b) {
    return model(name).of_rgb(DVec3(r, g, b) / 255.0);
}

void expect_near(const DVec3& got, const DVec3& expected, double tolerance) {
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(got[i], expected[i], tolerance) << i;
}

// Of CSS Color 4's named colours: values of its own conversions (hsl, and Lab and XYZ for D65 of
// IEC 1999's primaries); JPEG's by ITU 2011's formula with its printed digits.
TEST(ColourModels, HavePublishedValues) {
    expect_near(of("hsl", 102, 51, 153), {270, 0.5, 0.4}, 1e-12);          // rebeccapurple
    expect_near(of("hsl", 255, 165, 0), {38.8235, 1, 0.5}, 1e-4);          // orange
    expect_near(of("hsl", 64, 224, 208), {174, 0.720721, 0.564706}, 1e-6); // turquoise
    expect_near(of("hsv", 128, 0, 0), {0, 1, 128 / 255.0}, 1e-12);         // maroon
    expect_near(of("hsv", 64, 224, 208), {174, 0.714286, 0.878431}, 1e-6);
    expect_near(of("cmy", 255, 0, 51), {0, 1, 0.8}, 1e-12);
    expect_near(of("xyz", 255, 0, 0), {0.4124, 0.2126, 0.0193}, 2e-4); // IEC 1999's matrix
    expect_near(of("xyz", 0, 255, 0), {0.3576, 0.7152, 0.1192}, 2e-4);
    expect_near(of("xyz", 0, 0, 255), {0.1805, 0.0722, 0.9505}, 2e-4);
    expect_near(of("lab", 255, 0, 0), {53.24, 80.09, 67.20}, 0.01);
    expect_near(of("lab", 0, 255, 0), {87.73, -86.18, 83.18}, 0.01);
    expect_near(of("lab", 0, 0, 255), {32.30, 79.19, -107.86}, 0.01);
    expect_near(of("ycbcr", 255, 0, 0), {76.245, 84.972, 255.5}, 0.001);
    expect_near(of("ycbcr", 0, 255, 0), {149.685, 43.528, 21.235}, 0.001);
    expect_near(of("ycbcr", 0, 0, 255), {29.07, 255.5, 107.265}, 0.001);
    for (int grey = 0; grey < 256; ++grey)
        expect_near(of("ycbcr", grey, grey, grey), {double(grey), 128, 128}, 1e-12);
    expect_near(of("linear", 188, 128, 0), {0.502886, 0.215861, 0}, 1e-6);
}

TEST(ColourModels, LeadBackToEveryCode) {
    for (const ColourModel& m : colour_models())
        for (int r = 0; r < 256; r += 15)
            for (int g = 0; g < 256; g += 15)
                for (int b = 0; b < 256; b += 15) {
                    const DVec3 rgb = DVec3(r, g, b) / 255.0;
                    const DVec3 back = m.to_rgb(m.of_rgb(rgb));
                    for (int i = 0; i < 3; ++i)
                        ASSERT_NEAR(back[i], rgb[i], 1e-7) << m.name << r << g << b;
                }
}

TEST(ColourModels, StayWithinTheirBounds) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int n = 0; n < 20000; ++n) {
        DVec3 rgb(unit(random), unit(random), unit(random));
        if (n < 8) rgb = DVec3(n & 1, (n >> 1) & 1, n >> 2);
        for (const ColourModel& m : colour_models()) {
            const DVec3 values = m.of_rgb(rgb);
            for (int i = 0; i < 3; ++i) {
                const ColourComponent& c = m.components[static_cast<std::size_t>(i)];
                // ITU 2011 rounds 255.5 down to a code.
                const double slack = m.name == "ycbcr" ? 0.5 : 1e-4;
                ASSERT_GE(values[i], c.low - slack) << m.name << c.name;
                ASSERT_LE(values[i], c.high + slack) << m.name << c.name;
            }
        }
    }
}

TEST(ColourModels, AreThoseOfTheirNames) {
    std::string names;
    for (const ColourModel& m : colour_models())
        names += (names.empty() ? "" : " ") + std::string(m.name);
    EXPECT_EQ(names, kColourModelNames);
    EXPECT_EQ(find_colour_model("lcd"), nullptr);
}

TEST(ChannelsOf, APictureIsGreyFromLowToHigh) {
    Image picture(3, 1);
    picture.at(0, 0) = {255, 0, 0, 255};
    picture.at(1, 0) = {255, 255, 255, 7};
    picture.at(2, 0) = {0, 0, 0, 255};
    Jobs jobs(2);
    const auto greys = [&](std::string_view name, std::size_t i) {
        const Image out = channels_of(picture, model(name), jobs)[i];
        EXPECT_EQ(out.at(1, 0).a, 7);
        return std::array<int, 3>{out.at(0, 0).r, out.at(1, 0).g, out.at(2, 0).b};
    };
    EXPECT_EQ(greys("lab", 0), (std::array<int, 3>{136, 255, 0}));
    EXPECT_EQ(greys("lab", 1), (std::array<int, 3>{208, 128, 128}));
    EXPECT_EQ(greys("cmy", 2), (std::array<int, 3>{255, 0, 255}));
    EXPECT_EQ(greys("hsv", 1), (std::array<int, 3>{255, 0, 0}));
    EXPECT_EQ(greys("rgb", 0), (std::array<int, 3>{255, 255, 0}));
    EXPECT_EQ(greys("xyz", 1), (std::array<int, 3>{54, 255, 0}));
}

} // namespace
} // namespace scanout::image
