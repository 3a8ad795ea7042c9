// Lines that must fail where ours hold: the diamond-exit rule along one chosen direction, pixel
// centres alone, a stepped float, ends cut again and again in float (HARD-CASES 49-51, P10).
#include "oracle/diamond.h"
#include "raster/lines.h"

#include <cmath>

namespace scanout::naive {
namespace {

using namespace raster;
using namespace raster::test;

// The diamond-exit rule, walked from the upper end to the lower one, so that no bit depends on the
// order of the file: two lines that end in one corner both leave it out.
Pixels exits_of(Corner a, Corner b) {
    if (std::pair(b.y, b.x) < std::pair(a.y, a.x)) std::swap(a, b);
    Pixels out;
    for (int y = std::min(a.y, b.y) / 256 - 1; y <= std::max(a.y, b.y) / 256 + 1; ++y)
        for (int x = std::min(a.x, b.x) / 256 - 1; x <= std::max(a.x, b.x) / 256 + 1; ++x)
            if (oracle::exits_diamond(a, b, x, y)) out.insert({x, y});
    return out;
}

// A pixel for each pixel centre that is passed on the longer axis, and nothing for the ends.
Pixels centres_of(const Corner& a, const Corner& b) {
    Pixels out;
    const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x);
    const double from = steep ? a.y : a.x, to = steep ? b.y : b.x, start = steep ? a.x : a.y,
                 rise = (steep ? b.x : b.y) - start;
    for (int pixel = 0; pixel < kTileSize; ++pixel) {
        const double at = pixel * 256 + 128;
        if (at < std::min(from, to) || at > std::max(from, to)) continue;
        const auto across =
            static_cast<int>(std::floor((start + (at - from) * rise / (to - from)) / 256));
        out.insert(steep ? std::pair{across, pixel} : std::pair{pixel, across});
    }
    return out;
}

// HARD-CASES P10
TEST(NaiveLines, OtherRulesLeaveRingsOpenAndOursDoesNot) {
    VisibilityTile tile;
    Random random(11);
    int exit_open = 0, centres_open = 0, ours_open = 0;
    for (int n = 3; n <= 24; ++n)
        for (int i = 0; i < 10; ++i) {
            const std::vector<Corner> ring = ring_of(random, n, 16);
            exit_open += is_closed(ring, exits_of) ? 0 : 1;
            centres_open += is_closed(ring, centres_of) ? 0 : 1;
            ours_open += is_closed(ring, [&](const Corner& a,
                                             const Corner& b) { return line_pixels(a, b, tile); })
                             ? 0
                             : 1;
        }
    EXPECT_EQ(ours_open, 0);
    EXPECT_GT(exit_open, 22);
    EXPECT_GT(centres_open, 5);
    record("open_of_220_by_exit", exit_open);
    record("open_of_220_by_centres", centres_open);
}

// HARD-CASES 50: y += slope, from the guard band's edge on.
TEST(NaiveLines, ASteppedFloatDriftsAndOursDoesNot) {
    VisibilityTile tile;
    Random random(50);
    int wrong = 0, ours_wrong = 0;
    for (int i = 0; i < 200; ++i) {
        auto [a, b] = long_line(random);
        const Pixels exact = exact_long_line(a, b);
        ours_wrong += line_pixels(a, b, tile) == exact ? 0 : 1;
        const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x);
        if (steep) std::swap(a.x, a.y), std::swap(b.x, b.y);
        if (b.x < a.x) std::swap(a, b);
        const float slope = static_cast<float>(b.y - a.y) / static_cast<float>(b.x - a.x);
        const int first = a.x / 256 + 1;
        float y = static_cast<float>(a.y) / 256 +
                  (static_cast<float>(first) + 0.5F - static_cast<float>(a.x) / 256) * slope;
        Pixels stepped;
        for (int x = first; x < kTileSize; ++x, y += slope)
            if (x >= 0 && y >= 0 && y < kTileSize) {
                const int row = static_cast<int>(std::floor(y));
                stepped.insert(steep ? std::pair{row, x} : std::pair{x, row});
            }
        wrong += stepped == exact ? 0 : 1;
    }
    EXPECT_EQ(ours_wrong, 0);
    EXPECT_GT(wrong, 100);
    record("wrong_of_200", wrong);
}

// HARD-CASES 51: Cohen and Sutherland's way in float on the screen: an end that was cut is cut
// again from where rounding left it.
TEST(NaiveLines, EndsCutAgainAndAgainInFloatsMoveAndOursDoNot) {
    Random random(53);
    double worst = 0, ours = 0;
    int cut = 0, most = 0;
    for (int i = 0; i < 20'000; ++i) {
        FarSegment s = far_segment(random);
        s.a.w = s.b.w = 1; // on the screen already
        const auto exact = exact_part(s);
        if (!exact || exact->length < 1) continue;
        ClipVertex a = s.a, b = s.b;
        if (!clip(a, b, ClipBox{.near_w = kNearOfSegments})) continue;
        ours = std::max({ours, exact->off(a, true), exact->off(b, false)});
        float x[] = {static_cast<float>(s.a.x), static_cast<float>(s.b.x)},
              y[] = {static_cast<float>(s.a.y), static_cast<float>(s.b.y)};
        constexpr auto kGuard = static_cast<float>(kGuardPixels);
        int steps = 0;
        for (bool outside = true; outside && steps < 100;) {
            outside = false;
            for (int end = 0; end < 2; ++end) {
                const float dx = x[1] - x[0], dy = y[1] - y[0];
                const float to_x = std::clamp(x[end], -kGuard, kGuard);
                const float to_y = std::clamp(y[end], -kGuard, kGuard);
                if (x[end] != to_x)
                    y[end] += (to_x - x[end]) * dy / dx, x[end] = to_x;
                else if (y[end] != to_y)
                    x[end] += (to_y - y[end]) * dx / dy, y[end] = to_y;
                else
                    continue;
                outside = true;
                ++steps;
            }
        }
        most = std::max(most, steps);
        const ClipVertex first{x[0], y[0], 1, 1}, last{x[1], y[1], 1, 1};
        worst = std::max({worst, exact->off(first, true), exact->off(last, false)});
        ++cut;
    }
    EXPECT_GT(cut, 1000);
    EXPECT_LE(ours, 1.0 / 256);
    EXPECT_GT(worst, 1.0 / 8);
    record("naive_px", worst);
    record("ours_px", ours);
    record("naive_steps", most);
}

} // namespace
} // namespace scanout::naive
