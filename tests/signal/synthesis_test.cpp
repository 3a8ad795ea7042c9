// Texture synthesis: the search against all places one by one, the seam against all seams, and what
// both ways make of samples whose continuation is known.
#include "image/hash.h"
#include "signal/candidates.h"
#include "signal/seam.h"
#include "signal/synthesis.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace scanout::signal {
namespace {

constexpr std::array kWays = {SynthesisBy::pixel, SynthesisBy::patch};

image::Image coloured_noise(int width, int height) {
    Random random(3);
    image::Image out(width, height);
    for (image::Rgba8& p : out.pixels()) {
        const std::uint64_t bits = random.next();
        p = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8U),
             static_cast<std::uint8_t>(bits >> 16U), 255};
    }
    return out;
}

// Stripes of three colours.
image::Image stripes(int width, int height, bool upright) {
    constexpr std::array<image::Rgba8, 3> kColours = {
        {{200, 40, 30, 255}, {30, 160, 60, 255}, {20, 60, 220, 255}}};
    image::Image out(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            out.at(x, y) = kColours[static_cast<std::size_t>((upright ? x : y) % 3)];
    return out;
}

image::Image made(const image::Image& sample, SynthesisBy by, int width, int height,
                  std::uint64_t seed = 1, int threads = 1, int window = 0) {
    Jobs jobs(threads);
    return synthesised(
        sample, {width, height, by, window > 0 ? window : default_window(sample, by), seed}, jobs);
}

TEST(BestPlaces, AreThoseOfASearchThatGivesNothingUp) {
    const image::Image sample = coloured_noise(24, 17);
    const image::Rect within{2, 2, 22, 15};
    Jobs jobs(2);
    BestPlaces places(sample, within, jobs);
    Random random(9);
    for (int round = 0; round < 200; ++round) {
        std::vector<Known> known;
        for (int dy = -2; dy <= 2; ++dy)
            for (int dx = -2; dx <= 2; ++dx)
                if (random.below(3) == 0) {
                    const std::uint64_t bits = random.next();
                    known.push_back({dx,
                                     dy,
                                     {static_cast<std::uint8_t>(bits), 9, 200, 255},
                                     1 + random.below(50)});
                }
        std::vector<std::pair<std::uint64_t, Place>> all;
        std::uint64_t least = ~std::uint64_t{0};
        for (int y = within.y0; y < within.y1; ++y)
            for (int x = within.x0; x < within.x1; ++x) {
                std::uint64_t sum = 0;
                for (const Known& k : known) {
                    const image::Rgba8& p = sample.at(x + k.dx, y + k.dy);
                    const int r = p.r - k.colour.r, g = p.g - k.colour.g, b = p.b - k.colour.b;
                    sum += k.weight * static_cast<std::uint64_t>(r * r + g * g + b * b);
                }
                all.push_back({sum, {x, y}});
                least = std::min(least, sum);
            }
        std::vector<Place> fitting;
        for (const auto& [sum, place] : all)
            if (sum <= least + least / 10) fitting.push_back(place);
        Random mine = random;
        const Place drawn = places.draw(known, random);
        const Place expected = fitting[mine.below(static_cast<std::uint32_t>(fitting.size()))];
        ASSERT_EQ(drawn.x, expected.x);
        ASSERT_EQ(drawn.y, expected.y);
    }
}

// Of all seams: as many as 5 x 3^5.
std::uint32_t least_cost(const std::vector<std::uint32_t>& cost, int across, int row, int at) {
    if (at < 0 || at >= across) return 0x40000000;
    const std::uint32_t here = cost[static_cast<std::size_t>(row * across + at)];
    if (row == 0) return here;
    return here + std::min({least_cost(cost, across, row - 1, at - 1),
                            least_cost(cost, across, row - 1, at),
                            least_cost(cost, across, row - 1, at + 1)});
}

TEST(Seam, IsTheCheapestOfAll) {
    Random random(4);
    for (int round = 0; round < 300; ++round) {
        const int across = 1 + static_cast<int>(random.below(5));
        const int length = 1 + static_cast<int>(random.below(6));
        std::vector<std::uint32_t> cost(static_cast<std::size_t>(across * length));
        for (std::uint32_t& c : cost)
            c = random.below(100);
        const std::vector<int> path = cheapest_path(cost, across);
        ASSERT_EQ(path.size(), static_cast<std::size_t>(length));
        std::uint32_t sum = 0, least = ~0U;
        for (int i = 0; i < length; ++i) {
            const int at = path[static_cast<std::size_t>(i)];
            ASSERT_LE(i > 0 ? std::abs(at - path[static_cast<std::size_t>(i) - 1]) : 0, 1);
            sum += cost[static_cast<std::size_t>(i * across + at)];
        }
        for (int at = 0; at < across; ++at)
            least = std::min(least, least_cost(cost, across, length - 1, at));
        ASSERT_EQ(sum, least);
    }
}

TEST(Synthesis, GoesOnWithStripesWithoutAFault) {
    for (const SynthesisBy by : kWays)
        for (const bool upright : {true, false}) {
            const image::Image out = made(stripes(20, 19, upright), by, 37, 31);
            // In whatever phase it began.
            int faults = 0;
            for (int y = 3; y < out.height(); ++y)
                for (int x = 3; x < out.width(); ++x) {
                    const image::Rgba8& here = out.at(x, y);
                    faults += here == out.at(x - (upright ? 3 : 1), y) ? 0 : 1;
                    faults += here == out.at(x, y - (upright ? 1 : 3)) ? 0 : 1;
                    faults += here == out.at(x - (upright ? 1 : 3), y - (upright ? 3 : 1)) ? 1 : 0;
                }
            EXPECT_EQ(faults, 0) << upright;
        }
}

TEST(Synthesis, TakesEveryPixelFromTheSample) {
    const image::Image sample = coloured_noise(16, 16);
    std::set<std::array<int, 3>> colours;
    for (const image::Rgba8& p : sample.pixels())
        colours.insert({p.r, p.g, p.b});
    for (const SynthesisBy by : kWays)
        for (const auto& [width, height] : {std::pair{40, 23}, {5, 5}, {1, 1}, {2, 30}, {16, 16}}) {
            const image::Image out = made(sample, by, width, height);
            ASSERT_EQ(out.width(), width);
            ASSERT_EQ(out.height(), height);
            for (const image::Rgba8& p : out.pixels())
                ASSERT_EQ(colours.count({p.r, p.g, p.b}), 1U);
        }
}

TEST(Synthesis, HasTheSameBitsForEveryNumberOfThreadsAndOthersForAnotherSeed) {
    const image::Image sample = coloured_noise(20, 15);
    for (const SynthesisBy by : kWays) {
        const image::Image one = made(sample, by, 33, 22, 5, 1);
        for (const int threads : {2, 3, 7})
            EXPECT_EQ(made(sample, by, 33, 22, 5, threads), one);
        EXPECT_NE(made(sample, by, 33, 22, 6), one);
    }
}

TEST(Synthesis, TakesAnyWindowThatTheSampleHasRoomFor) {
    const image::Image sample = coloured_noise(9, 7);
    EXPECT_EQ(greatest_window(sample), 7);
    for (int window = kLeastWindow; window <= 7; ++window) {
        EXPECT_EQ(made(sample, SynthesisBy::patch, 20, 20, 1, 1, window).width(), 20);
        if (window % 2 == 1) {
            EXPECT_EQ(made(sample, SynthesisBy::pixel, 12, 12, 1, 1, window).width(), 12);
        }
    }
    for (int side = kLeastWindow; side < 200; ++side) {
        const image::Image square(side, side);
        EXPECT_LE(default_window(square, SynthesisBy::patch), side);
        EXPECT_LE(default_window(square, SynthesisBy::pixel), side);
        EXPECT_EQ(default_window(square, SynthesisBy::pixel) % 2, 1);
        EXPECT_GE(default_window(square, SynthesisBy::patch), kLeastWindow);
        EXPECT_GE(default_window(square, SynthesisBy::pixel), kLeastWindow);
    }
}

TEST(Synthesis, TellsItsProgressUpwards) {
    for (const SynthesisBy by : kWays) {
        const image::Image sample = coloured_noise(16, 16);
        Jobs jobs(1);
        double last = -1;
        int told = 0;
        synthesised(sample, {40, 40, by, default_window(sample, by), 1}, jobs, [&](double share) {
            EXPECT_GE(share, last);
            EXPECT_LE(share, 1);
            last = share;
            ++told;
        });
        EXPECT_GT(told, 3);
        EXPECT_GT(last, 0.9);
    }
}

// What the repository keeps.
TEST(Synthesis, HasItsBits) {
    const auto hash = [](SynthesisBy by) {
        return image::hash_text(image::frame_hash(made(coloured_noise(20, 15), by, 33, 22, 5, 2)));
    };
    EXPECT_EQ(hash(SynthesisBy::pixel), "bf373615677cde08");
    EXPECT_EQ(hash(SynthesisBy::patch), "5e113fc256403c09");
}

} // namespace
} // namespace scanout::signal
