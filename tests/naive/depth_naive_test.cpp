// Depth and interpolation that must fail where ours holds: a plane equation in float, logarithmic
// depth a vertex, stepping from pixel to pixel (HARD-CASES 15, 16, 35).
#include "oracle/plane.h"
#include "raster/exact.h"

#include <cmath>

namespace scanout::naive {
namespace {

using namespace raster;
using namespace raster::test;
using oracle::Three;

constexpr int kSide = 64;

// The usual set-up: gradients and constant in float.
struct FloatPlane {
    float x, y, c;
    FloatPlane(const Corners& v, const Three& f) {
        const auto px = [](std::int32_t u) { return static_cast<float>(u) / 256; };
        const float x1 = px(v[1].x) - px(v[0].x), y1 = px(v[1].y) - px(v[0].y),
                    x2 = px(v[2].x) - px(v[0].x), y2 = px(v[2].y) - px(v[0].y);
        const auto f0 = static_cast<float>(f[0]);
        const float f1 = static_cast<float>(f[1]) - f0, f2 = static_cast<float>(f[2]) - f0;
        const float area = x1 * y2 - x2 * y1;
        x = (f1 * y2 - f2 * y1) / area;
        y = (x1 * f2 - x2 * f1) / area;
        c = f0 - (x * px(v[0].x) + y * px(v[0].y));
    }
    float at(int px, int py) const {
        return (x * (static_cast<float>(px) + 0.5F) + y * (static_cast<float>(py) + 0.5F)) + c;
    }
};

// HARD-CASES 15
TEST(NaiveDepth, AFloatPlaneLosesTheFarEndAndOursDoesNot) {
    // The far edge stands on the left, through pixel centres: they belong to the triangle.
    const Corners v = {{{60 * 256 + 131, 30 * 256 + 77},
                        {8 * 256 + 128, 4 * 256 + 128},
                        {8 * 256 + 128, 61 * 256 + 128}}};
    for (const auto& [ratio, at_least] : {std::pair{1e3, 1e-5}, {1e5, 1e-3}, {1e7, 0.1}}) {
        const Three depth = {0.9, 0.9 / ratio, 1.1 / ratio};
        const FloatPlane plane(v, depth);
        VisibilityTile tile;
        tile.reset({0, 0, kSide, kSide}, 1);
        tile.draw(set_up(v, 0, depth));
        double naive = 0, ours = 0;
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                if (tile.id(x, y) != 0) continue;
                const auto exact = oracle::linear_at(v, depth, x * 256 + 128, y * 256 + 128);
                naive = std::max(naive, oracle::relative_error(plane.at(x, y), exact) * 0x1p-23);
                ours = std::max(ours, oracle::relative_error(tile.depth(x, y), exact));
            }
        EXPECT_LE(ours, 1) << ratio; // 2^-23
        EXPECT_GT(naive, at_least) << ratio;
        record("float_plane_relative_at_" + std::to_string(static_cast<long>(ratio)), naive);
        record("ours_in_2^-23_at_" + std::to_string(static_cast<long>(ratio)), ours);
    }
}

// HARD-CASES 16: log w is not linear on the screen.
TEST(NaiveDepth, LogarithmicDepthAVertexBendsAndOursDoesNot) {
    const Corners v = {{{0, 0}, {64 * 256, 0}, {0, 64 * 256}}};
    const Three w = {1, 1000, 1}, depth = {0.5, 0.5 / 1000, 0.5};
    const Three logarithm = {std::log(w[0]), std::log(w[1]), std::log(w[2])};
    VisibilityTile tile;
    tile.reset({0, 0, kSide, kSide}, 1);
    tile.draw(set_up(v, 0, depth));
    double naive = 0, ours = 0;
    for (int x = 0; x < kSide - 1; ++x) {
        const double exact = oracle::perspective_at(v, w, w, x * 256 + 128, 128).nearest();
        const double bent = std::exp(oracle::linear_at(v, logarithm, x * 256 + 128, 128).nearest());
        naive = std::max(naive, std::abs(bent - exact) / exact);
        ours = std::max(ours, std::abs(0.5 / tile.depth(x, 0) - exact) / exact);
    }
    EXPECT_LE(ours, 1e-6);
    EXPECT_GT(naive, 1);
    record("naive_relative", naive);
    record("ours_relative", ours);
}

// HARD-CASES 35, T3: a float that is stepped 3840 times. (What the renderer shows over 3840 pixels
// is measured in tests/frame.)
TEST(NaiveDepth, SteppingAFloatAcrossAPictureDriftsAndTakingItAnewDoesNot) {
    double stepped = 0, restarted = 0, direct = 0;
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const auto step = static_cast<float>(random.in(0.5, 1) / 3840);
        float at = 0, since = 0;
        for (int x = 0; x < 3840; ++x) {
            if (x % 64 == 0) since = static_cast<float>(x) * step;
            const double exact = x * static_cast<double>(step);
            stepped = std::max(stepped, std::abs(at - exact) * 0x1p24);
            restarted = std::max(restarted, std::abs(since - exact) * 0x1p24);
            direct = std::max(direct, std::abs(static_cast<float>(x) * step - exact) * 0x1p24);
            at += step;
            since += step;
        }
    }
    EXPECT_GT(stepped, 32);
    EXPECT_LE(restarted, 32);
    EXPECT_LE(direct, 2);
    record("stepped_in_2^-24", stepped);
    record("restarted_in_2^-24", restarted);
    record("direct_in_2^-24", direct);
}

} // namespace
} // namespace scanout::naive
