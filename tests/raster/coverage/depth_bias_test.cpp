// HARD-CASES R19, R20, P12: the depth bias of Direct3D, Vulkan and WebGPU.
#include "raster/coverage/depth_bias.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace scanout::raster {
namespace {

// The float32 vectors of WebGPU 2021 (depth_bias.spec.ts). Flat: a square at depth 0.25. Tilted:
// from 0 to 0.5 across the one pixel of the picture, 0.25 at its centre.
TEST(DepthBias, GivesTheKnownAnswers) {
    constexpr double kQuarter = 8388608; // 0.25 / 2^(-2 - 23)
    constexpr struct {
        float max_depth;
        double max_slope;
        DepthBias bias;
        double depth; // of the pixel, with the bias
    } kKnown[] = {
        {0.25F, 0, {kQuarter, 0, 0}, 0.5},    {0.25F, 0, {kQuarter, 0, 0.125}, 0.375},
        {0.25F, 0, {-kQuarter, 0, 0.125}, 0}, {0.25F, 0, {-kQuarter, 0, -0.125}, 0.125},
        {0.5F, 0.5, {0, 0, 0}, 0.25},         {0.5F, 0.5, {0, 1, 0}, 0.75},
        {0.5F, 0.5, {0, -0.5, 0}, 0},
    };
    for (const auto& known : kKnown)
        EXPECT_EQ(0.25 + depth_bias(known.bias, known.max_depth, known.max_slope), known.depth)
            << known.bias.constant << ' ' << known.bias.slope_scale << ' ' << known.bias.clamp;
}

TEST(DepthBias, WithoutASlopeScaleIsFiniteOnASurfaceSeenEdgeOn) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(depth_bias({.constant = 2}, 0.75F, infinity), 0x1p-23);
    EXPECT_EQ(depth_bias({.slope_scale = 1, .clamp = 0.125}, 0.75F, infinity), 0.125);
}

TEST(DepthBias, StepsByTheDistanceToTheNextFloat) {
    for (const float depth : {1.0F, 0.99999994F, 0.5F, 0.3F, 0x1p-100F, 0x1.8p-126F, 0x1p-126F,
                              0x1p-127F, 0x1p-149F, 0.0F}) {
        const float next = std::nextafter(depth, 2.0F);
        EXPECT_EQ(depth_step(depth), static_cast<double>(next) - static_cast<double>(depth))
            << depth;
    }
}

} // namespace
} // namespace scanout::raster
