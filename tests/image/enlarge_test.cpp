#include "image/enlarge.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::image {
namespace {

Image enlarged(const Image& small, int width, int height, int threads = 1) {
    Jobs jobs(threads);
    Image large(width, height, {1, 2, 3, 4});
    Enlarger().run(small, large, jobs);
    return large;
}

Image random_picture(int width, int height, bool opaque) {
    Image picture(width, height);
    for (Rgba8& p : picture.pixels())
        p = {*rc::gen::arbitrary<std::uint8_t>(), *rc::gen::arbitrary<std::uint8_t>(),
             *rc::gen::arbitrary<std::uint8_t>(),
             opaque ? std::uint8_t{255} : *rc::gen::arbitrary<std::uint8_t>()};
    return picture;
}

// Where the large pixel's middle lies among the middles of the small ones, and how far.
std::array<double, 4> bilinear(const Image& s, double u, double v) {
    const auto at = [](double place, int size) {
        const double held = std::min(std::max(place, 0.0), size - 1.0);
        return std::pair(static_cast<int>(held), held - std::floor(held));
    };
    const auto [x, fx] = at(u, s.width());
    const auto [y, fy] = at(v, s.height());
    std::array<double, 4> sum{};
    for (int dy = 0; dy < 2; ++dy)
        for (int dx = 0; dx < 2; ++dx) {
            const double weight = (dx == 1 ? fx : 1 - fx) * (dy == 1 ? fy : 1 - fy);
            if (weight == 0) continue;
            const Rgba8& p = s.at(x + dx, y + dy);
            sum[0] += weight * p.a * p.r;
            sum[1] += weight * p.a * p.g;
            sum[2] += weight * p.a * p.b;
            sum[3] += weight * p.a;
        }
    for (int c = 0; c < 3; ++c)
        sum[static_cast<std::size_t>(c)] /= std::max(sum[3], 1e-9);
    return sum;
}

// The formula in double, where places lie on the grid; a code off where it rounds.
RC_GTEST_PROP(Enlarge, IsBilinear, (bool opaque)) {
    const int width = *rc::gen::inRange(1, 9), height = *rc::gen::inRange(1, 9),
              scale = *rc::gen::element(1, 2, 4);
    const Image small = random_picture(width, height, opaque);
    const Image large = enlarged(small, width * scale, height * scale);
    for (int y = 0; y < large.height(); ++y)
        for (int x = 0; x < large.width(); ++x) {
            const auto expected = bilinear(small, (x + 0.5) / scale - 0.5, (y + 0.5) / scale - 0.5);
            const Rgba8& got = large.at(x, y);
            RC_ASSERT(std::abs(got.a - expected[3]) <= 0.5 + 1e-9);
            if (expected[3] < 1) continue;
            RC_ASSERT(std::abs(got.r - expected[0]) <= 0.5 + 1e-9);
            RC_ASSERT(std::abs(got.g - expected[1]) <= 0.5 + 1e-9);
            RC_ASSERT(std::abs(got.b - expected[2]) <= 0.5 + 1e-9);
        }
}

// Other sizes: a place is off by 1/32 of a pixel at most, on each axis.
RC_GTEST_PROP(Enlarge, IsNearlyBilinearAtAnySize, ()) {
    const Image small = random_picture(*rc::gen::inRange(1, 9), *rc::gen::inRange(1, 9), true);
    const int width = small.width() + *rc::gen::inRange(0, 20),
              height = small.height() + *rc::gen::inRange(0, 20);
    const Image large = enlarged(small, width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto expected = bilinear(small, (x + 0.5) * small.width() / width - 0.5,
                                           (y + 0.5) * small.height() / height - 0.5);
            RC_ASSERT(std::abs(large.at(x, y).r - expected[0]) <= 255.0 * 2 / 32 + 0.5);
            RC_ASSERT(large.at(x, y).a == 255);
        }
}

RC_GTEST_PROP(Enlarge, KeepsAPictureOfTheSameSizeAndOneOfOneColour, (bool opaque)) {
    const Image picture = random_picture(*rc::gen::inRange(1, 9), *rc::gen::inRange(1, 9), opaque);
    const Image same = enlarged(picture, picture.width(), picture.height());
    for (std::size_t i = 0; i < picture.pixels().size(); ++i)
        RC_ASSERT(same.pixels()[i] == picture.pixels()[i] || picture.pixels()[i].a == 0);
    const Rgba8 colour = picture.at(0, 0);
    const Image plain =
        enlarged(Image(3, 2, colour), 3 + *rc::gen::inRange(0, 9), 2 + *rc::gen::inRange(0, 9));
    for (const Rgba8& p : plain.pixels())
        RC_ASSERT(p == (colour.a == 0 ? Rgba8{0, 0, 0, 0} : colour));
}

// Opaque rows are drawn another way than others: the same bits.
RC_GTEST_PROP(Enlarge, BothWaysToMixAreTheSame, ()) {
    Image opaque = random_picture(7, 5, true);
    Image other = opaque;
    for (int y = 0; y < 5; ++y)
        other.at(6, y).a = 254;
    const Image a = enlarged(opaque, 21, 14), b = enlarged(other, 21, 14);
    for (int y = 0; y < 14; ++y)
        for (int x = 0; x < 15; ++x) // what the last column does not reach
            RC_ASSERT(a.at(x, y) == b.at(x, y));
}

TEST(Enlarge, TransparentPixelsLendNoColour) {
    Image small(2, 1, {200, 100, 50, 255});
    small.at(1, 0) = {0, 0, 0, 0};
    const Image large = enlarged(small, 4, 2);
    for (int y = 0; y < 2; ++y) {
        EXPECT_EQ(large.at(0, y), (Rgba8{200, 100, 50, 255}));
        EXPECT_EQ(large.at(1, y), (Rgba8{200, 100, 50, 191}));
        EXPECT_EQ(large.at(2, y), (Rgba8{200, 100, 50, 64}));
        EXPECT_EQ(large.at(3, y), (Rgba8{0, 0, 0, 0}));
    }
}

TEST(Enlarge, ThreadsDoNotMatter) {
    Image small(37, 29);
    std::uint32_t state = 1;
    for (Rgba8& p : small.pixels()) {
        state = state * 1664525 + 1013904223;
        p = {static_cast<std::uint8_t>(state >> 8), static_cast<std::uint8_t>(state >> 16),
             static_cast<std::uint8_t>(state >> 24), 255};
    }
    const Image one = enlarged(small, 100, 87, 1);
    for (const int threads : {2, 3, 7})
        EXPECT_EQ(enlarged(small, 100, 87, threads), one) << threads;
}

} // namespace
} // namespace scanout::image
