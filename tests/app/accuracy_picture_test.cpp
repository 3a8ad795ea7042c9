#include "app/lit_sphere.h"
#include "app/view/accuracy_picture.h"
#include "image/heat_map.h"
#include "image/metrics.h"
#include "support/random.h"

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

using trace::Known;
using trace::Progressive;

// A lit sphere, and a picture of noise to compare with it.
struct AccuracyPicture : ::testing::Test {
    AccuracyPicture() {
        test::Random random(5);
        for (image::Rgba8& p : drawn.pixels())
            p = {static_cast<std::uint8_t>(random.whole(0, 255)),
                 static_cast<std::uint8_t>(random.whole(0, 255)),
                 static_cast<std::uint8_t>(random.whole(0, 255)), 255};
        reference = *Progressive::create(sphere.scene, sphere.view, sphere.look, {256, true});
    }
    void finish() { reference->step(jobs, Progressive::Time::max()); }
    // Until so many pixels have what is asked.
    void trace(Known least, int pixels) {
        while (count(least) < pixels)
            reference->step(jobs, Progressive::Time::min());
    }
    int count(Known least) const {
        int found = 0;
        for (int i = 0; i < 600; ++i)
            found += reference->known(i) >= least ? 1 : 0;
        return found;
    }
    LitSphere sphere{30, 20};
    Jobs jobs{2};
    image::Image drawn{30, 20};
    std::unique_ptr<Progressive> reference;
    image::Image out;
};

TEST_F(AccuracyPicture, WhereAllIsKnownTheyAreTheReferenceItsHeatMapAndItsMetrics) {
    finish();
    converging(drawn, *reference, out);
    EXPECT_EQ(out, reference->image());
    error_map(drawn, *reference, out);
    EXPECT_EQ(out, image::heat_map(reference->image(), drawn));
    const auto figures = error_figures(drawn, *reference);
    ASSERT_TRUE(figures);
    EXPECT_DOUBLE_EQ(figures->drawn, image::metrics(reference->image(), drawn).rmse_codes);
    EXPECT_EQ(figures->converging, 0);
    out = drawn;
    lay_reference(*reference, 11, out);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 30; ++x)
            EXPECT_EQ(out.at(x, y), x < 11 ? drawn.at(x, y) : reference->image().at(x, y));
}

TEST_F(AccuracyPicture, BeforeAnythingIsKnownThePictureStaysAndHasNoFigures) {
    EXPECT_FALSE(error_figures(drawn, *reference));
    converging(drawn, *reference, out);
    EXPECT_EQ(out, drawn);
    lay_reference(*reference, 0, out);
    EXPECT_EQ(out, drawn);
    error_map(drawn, *reference, out);
    for (const image::Rgba8& p : out.pixels())
        EXPECT_EQ(p, (image::Rgba8{64, 64, 64, 255})) << "no colour of the map";
}

// Estimates are not shown; a pixel changes once.
TEST_F(AccuracyPicture, OnlyFinalPixelsReplaceDrawnOnes) {
    trace(Known::estimate, 600);
    ASSERT_LT(count(Known::final), 600);
    ASSERT_GT(count(Known::final), 0);
    converging(drawn, *reference, out);
    image::Image last = out;
    for (int i = 0; i < 600; ++i) {
        const auto k = static_cast<std::size_t>(i);
        EXPECT_EQ(out.pixels()[k], reference->known(i) == Known::final
                                       ? reference->image().pixels()[k]
                                       : drawn.pixels()[k]);
    }
}

TEST_F(AccuracyPicture, TheErrorOnTheScreenFallsToNothing) {
    trace(Known::estimate, 600);
    double last = error_figures(drawn, *reference)->converging;
    const double drawn_error = error_figures(drawn, *reference)->drawn;
    EXPECT_LT(last, drawn_error);
    EXPECT_GT(last, 0);
    while (!reference->finished()) {
        reference->step(jobs, Progressive::Time::min());
        const ErrorFigures now = *error_figures(drawn, *reference);
        EXPECT_LE(now.converging, last + 1e-9);
        EXPECT_NEAR(now.drawn, drawn_error, 1) << "an estimate of 16 samples is near";
        last = now.converging;
    }
    EXPECT_EQ(last, 0);
}

TEST_F(AccuracyPicture, WhatIsNotKnownYetShowsWhatStandsAboveIt) {
    trace(Known::estimate, 60); // two whole rows, the upper one first
    const image::Image& known = reference->image();
    const int row = 16; // of 20, in bit-reversed order after row 0
    ASSERT_NE(reference->known(row * 30), Known::nothing);
    ASSERT_EQ(reference->known((row - 1) * 30), Known::nothing);
    out = drawn;
    lay_reference(*reference, 0, out);
    EXPECT_EQ(out.at(3, row - 1), known.at(3, 0));
    EXPECT_EQ(out.at(3, row), known.at(3, row));
    EXPECT_EQ(out.at(3, 19), known.at(3, row));
}

} // namespace
} // namespace scanout::app
