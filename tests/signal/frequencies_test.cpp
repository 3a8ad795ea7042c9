// Spectra as pictures, and filters by dropping frequencies.
#include "image/compare.h"
#include "image/hash.h"
#include "math/srgb.h"
#include "signal/frequencies.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace scanout::signal {
namespace {

// Waves in linear light, so many a picture along x and along y.
image::Image waves(int width, int height, int kx, int ky) {
    image::Image out(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double angle = 2 * M_PI * (double(kx * x) / width + double(ky * y) / height);
            const std::uint8_t code = srgb_encode(static_cast<float>(0.5 + 0.4 * std::cos(angle)));
            out.at(x, y) = {code, code, code, 255};
        }
    return out;
}

image::Image noise(int width, int height) {
    std::mt19937 random(3);
    image::Image out(width, height);
    for (image::Rgba8& p : out.pixels()) {
        const auto bits = random();
        p = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8U),
             static_cast<std::uint8_t>(bits >> 16U), static_cast<std::uint8_t>(bits >> 24U)};
    }
    return out;
}

TEST(SpectrumPicture, OfAWaveHasItsSpotsAndZeroInTheMiddle) {
    Jobs jobs(1);
    for (const auto& [width, height] : {std::pair{96, 64}, {75, 50}, {33, 47}}) {
        const image::Image s = spectrum_picture(waves(width, height, 9, -4), jobs);
        const int cx = width / 2, cy = height / 2;
        EXPECT_EQ(s.at(cx, cy).r, 255);
        EXPECT_GT(s.at(cx + 9, cy - 4).r, 200);
        EXPECT_GT(s.at(cx - 9, cy + 4).r, 200);
        int bright = 0;
        for (const image::Rgba8& p : s.pixels())
            bright += p.r > 128 ? 1 : 0;
        EXPECT_EQ(bright, 3) << width; // all else is rounding to codes
    }
}

TEST(SpectrumPicture, OfNothingIsBlackAndOfOnePixelWhite) {
    Jobs jobs(1);
    EXPECT_EQ(spectrum_picture(image::Image(8, 5, {0, 0, 0, 255}), jobs),
              image::Image(8, 5, {0, 0, 0, 255}));
    EXPECT_EQ(spectrum_picture(image::Image(1, 1, {90, 90, 90, 255}), jobs).at(0, 0).g, 255);
}

TEST(Kept, AllFrequenciesGiveThePictureBack) {
    Jobs jobs(2);
    for (const auto& [width, height] : {std::pair{64, 64}, {75, 50}, {31, 1}, {1, 9}})
        EXPECT_EQ(kept(noise(width, height), {}, jobs), noise(width, height)) << width;
}

TEST(Kept, ALowPassDropsTheWaveAndLeavesTheMean) {
    Jobs jobs(1);
    const image::Image wave = waves(80, 60, 20, 0); // half of Nyquist's frequency
    const image::Image flat = kept(wave, {0, 0.4}, jobs);
    for (const image::Rgba8& p : flat.pixels())
        ASSERT_NEAR(srgb_decode(p.r), 0.5, 0.005);
    const image::Difference same = image::compare(kept(wave, {0, 0.6}, jobs), wave, 1);
    EXPECT_EQ(same.over_tolerance, 0);
    EXPECT_EQ(kept(wave, {0, 0.5}, jobs), kept(wave, {0, 0.55}, jobs)); // ends are included
}

TEST(Kept, AHighPassLeavesTheWaveAroundHalfTheLight) {
    Jobs jobs(1);
    const image::Image wave = waves(80, 60, 20, 0);
    EXPECT_EQ(image::compare(kept(wave, {0.3, 2}, jobs), wave, 1).over_tolerance, 0);
    const image::Image left = kept(wave, {0.7, 2}, jobs);
    for (const image::Rgba8& p : left.pixels())
        ASSERT_NEAR(srgb_decode(p.r), 0.5, 0.01);
}

TEST(Kept, TwoBandsAddUpToThePicture) {
    Jobs jobs(1);
    const image::Image picture = waves(64, 48, 3, 5);
    const image::Image low = kept(picture, {0, 0.15}, jobs),
                       high = kept(picture, {0.1500001, 2}, jobs);
    for (std::size_t i = 0; i < picture.pixels().size(); ++i)
        ASSERT_NEAR(srgb_decode(low.pixels()[i].r) + srgb_decode(high.pixels()[i].r) - 0.5,
                    srgb_decode(picture.pixels()[i].r), 0.01);
}

TEST(Kept, SlantingWavesHaveTheRootOfTheSumOfSquares) {
    Jobs jobs(1);
    const image::Image wave = waves(80, 80, 24, 32); // 0.6 and 0.8 of Nyquist's: 1
    const image::Image left = kept(wave, {0, 0.99}, jobs);
    for (const image::Rgba8& p : left.pixels())
        ASSERT_NEAR(srgb_decode(p.r), 0.5, 0.01);
    EXPECT_EQ(image::compare(kept(wave, {0, 1.01}, jobs), wave, 1).over_tolerance, 0);
}

// What the repository keeps: the same on every machine, compiler and number of threads.
TEST(Kept, HasItsBits) {
    Jobs jobs(3);
    EXPECT_EQ(image::hash_text(image::frame_hash(kept(noise(75, 50), {0.1, 0.7}, jobs))),
              "ac644ba21236a5f9");
    EXPECT_EQ(image::hash_text(image::frame_hash(spectrum_picture(noise(75, 50), jobs))),
              "6981ad518a35c7c3");
}

} // namespace
} // namespace scanout::signal
