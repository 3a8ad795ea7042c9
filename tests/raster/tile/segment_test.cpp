#include "raster/lines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>

#include <gtest/gtest.h>

namespace scanout::raster::test {
namespace {

constexpr int kSegmentSide = kTileSize;
constexpr image::Rect kSegmentArea{0, 0, kSegmentSide, kSegmentSide};

Segment segment(const Corner& a, const Corner& b, double depth_a = 0.5, double depth_b = 0.5) {
    return {{a.x, b.x}, {a.y, b.y}, {depth_a, depth_b}, 9};
}

template <class Primitive>
Pixels pixels(const Primitive& primitive, VisibilityTile& tile) {
    tile.reset(kSegmentArea, 1);
    if constexpr (std::is_same_v<Primitive, Segment>)
        tile.draw_line(primitive);
    else
        tile.draw_point(primitive);
    Pixels out;
    for (int y = 0; y < kSegmentSide; ++y)
        for (int x = 0; x < kSegmentSide; ++x)
            if (tile.id(x, y) == 9) out.insert({x, y});
    return out;
}

std::int64_t floor_of(Int128 numerator, Int128 denominator) {
    Int128 q = numerator / denominator;
    if (numerator % denominator != 0 && (numerator < 0) != (denominator < 0)) --q;
    return static_cast<std::int64_t>(q);
}

// Every pixel centre on the longer axis that the segment passes, and the pixel that its exact point
// there falls into; and the pixel of an end that lies in its diamond.
Pixels exact_pixels(Corner a, Corner b) {
    Pixels out;
    const std::int64_t dx = b.x - a.x, dy = b.y - a.y;
    const bool steep = std::abs(dy) > std::abs(dx);
    const auto add_end = [&](const Corner& end, bool always) {
        const auto x = static_cast<int>(floor_of(end.x, 256)),
                   y = static_cast<int>(floor_of(end.y, 256));
        if (x < 0 || y < 0 || x >= kSegmentSide || y >= kSegmentSide) return;
        const int off = std::abs(end.x - x * 256 - 128) + std::abs(end.y - y * 256 - 128);
        const int centre = (steep ? y : x) * 256 + 128;
        const auto [low, high] = steep ? std::minmax(a.y, b.y) : std::minmax(a.x, b.x);
        const bool passed = low <= centre && centre <= high;
        if (always || (!passed && off <= 128)) out.insert({x, y});
    };
    add_end(a, dx == 0 && dy == 0);
    add_end(b, false);
    for (int pixel = 0; pixel < kSegmentSide && (dx != 0 || dy != 0); ++pixel) {
        const std::int64_t centre = pixel * 256 + 128;
        const std::int64_t from = steep ? a.y : a.x, to = steep ? b.y : b.x;
        if (centre < std::min(from, to) || centre > std::max(from, to)) continue;
        // other = start + (centre - from) * rise / run, over 256: one rational number, one floor
        const Int128 run = to - from, rise = steep ? dx : dy, start = steep ? a.x : a.y;
        const auto other =
            static_cast<int>(floor_of(start * run + (centre - from) * rise, run * 256));
        if (other < 0 || other >= kSegmentSide) continue;
        out.insert(steep ? std::pair{other, pixel} : std::pair{pixel, other});
    }
    return out;
}

Corner random_end(Random& random, int kind) {
    switch (kind % 5) {
    case 0:
        return {random.whole(-10, 74) * 256 + 128, random.whole(-10, 74) * 256 + 128};
    case 1:
        return {random.whole(-10, 74) * 256, random.whole(-10, 74) * 256};
    case 2:
        return {random.whole(-32767 * 256, 32767 * 256), random.whole(-32767 * 256, 32767 * 256)};
    case 3:
        return {random.whole(20 * 16, 25 * 16) * 16, random.whole(20 * 16, 25 * 16) * 16};
    default:
        return {random.whole(-2000, 18000), random.whole(-2000, 18000)};
    }
}

TEST(Segment, CoversOnePixelForEveryPixelCentreItPassesAndTheDiamondsOfItsEnds) {
    Random random(1);
    VisibilityTile tile;
    for (int i = 0; i < 40000; ++i) {
        Corner a = random_end(random, i), b = random_end(random, i + (i % 7 == 0 ? 1 : 0));
        if (i % 11 == 0) b.y = a.y;
        if (i % 13 == 0) b.x = a.x;
        if (i % 17 == 0)
            b = {a.x + (b.x - a.x) / 256, a.y + (b.x - a.x) / 256}; // 45 degrees, short
        ASSERT_EQ(pixels(segment(a, b), tile), exact_pixels(a, b))
            << i << ": " << a.x << ',' << a.y << ' ' << b.x << ',' << b.y;
    }
}

TEST(Segment, DoesNotDependOnItsDirection) {
    Random random(2);
    VisibilityTile tile;
    for (int i = 0; i < 20000; ++i) {
        const Corner a = random_end(random, i), b = random_end(random, i);
        const double da = random.in(0.1, 1), db = random.in(0.1, 1);
        const Pixels there = pixels(segment(a, b, da, db), tile);
        std::map<std::pair<int, int>, float> depth;
        for (const auto& [x, y] : there)
            depth[{x, y}] = tile.depth(x, y);
        ASSERT_EQ(there, pixels(segment(b, a, db, da), tile)) << i;
        for (const auto& [x, y] : there)
            ASSERT_EQ((depth[{x, y}]), tile.depth(x, y)) << i;
    }
}

TEST(Segment, HasNoGapAndOnePixelARowOrColumn) {
    Random random(3);
    VisibilityTile tile;
    for (int i = 0; i < 20000; ++i) {
        const Corner a = {random.whole(0, 63 * 256), random.whole(0, 63 * 256)},
                     b = {random.whole(0, 63 * 256), random.whole(0, 63 * 256)};
        const Pixels drawn = pixels(segment(a, b), tile);
        const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x);
        std::map<int, int> other;
        for (const auto& [x, y] : drawn)
            ASSERT_TRUE(other.emplace(steep ? y : x, steep ? x : y).second) << i;
        for (auto it = other.begin(); it != other.end() && std::next(it) != other.end(); ++it) {
            ASSERT_EQ(std::next(it)->first, it->first + 1) << i;
            ASSERT_LE(std::abs(std::next(it)->second - it->second), 1) << i;
        }
    }
}

TEST(Segment, OfNoLengthIsOnePixel) {
    VisibilityTile tile;
    EXPECT_EQ(pixels(segment({1000, 2000}, {1000, 2000}), tile), (Pixels{{3, 7}}));
}

TEST(Segment, IsTheSameInEveryTile) {
    // The part of a line that a tile shows does not depend on where the tile begins.
    Random random(4);
    VisibilityTile whole, part;
    for (int i = 0; i < 2000; ++i) {
        const Segment s = segment(random_end(random, 4), random_end(random, i), 0.3, 0.7);
        whole.reset(kSegmentArea, 1);
        whole.draw_line(s);
        for (const image::Rect& area :
             {image::Rect{0, 0, 17, 40}, image::Rect{17, 0, 64, 40}, image::Rect{0, 40, 64, 64}}) {
            part.reset(area, 1);
            part.draw_line(s);
            for (int y = area.y0; y < area.y1; ++y)
                for (int x = area.x0; x < area.x1; ++x) {
                    ASSERT_EQ(part.id(x, y), whole.id(x, y)) << i;
                    ASSERT_EQ(part.depth(x, y), whole.depth(x, y)) << i;
                }
        }
    }
}

TEST(Point, IsASquareOfOnePixelByTheTriangleRules) {
    Random random(6);
    VisibilityTile tile;
    for (int i = 0; i < 20000; ++i) {
        const Corner at = i % 2 == 0
                              ? Corner{random.whole(-300, 64 * 256), random.whole(-300, 64 * 256)}
                              : Corner{random.whole(0, 128) * 128, random.whole(0, 128) * 128};
        const Corner corner[4] = {{at.x - 128, at.y - 128},
                                  {at.x + 128, at.y - 128},
                                  {at.x + 128, at.y + 128},
                                  {at.x - 128, at.y + 128}};
        const ExactTriangle upper({corner[0], corner[1], corner[2]}),
            lower({corner[0], corner[2], corner[3]});
        Pixels square;
        for (int y = 0; y < kSegmentSide; ++y)
            for (int x = 0; x < kSegmentSide; ++x)
                if (std::abs(x * 256 - at.x) < 600 && std::abs(y * 256 - at.y) < 600 &&
                    (upper.covers(x * 256 + 128, y * 256 + 128) ||
                     lower.covers(x * 256 + 128, y * 256 + 128)))
                    square.insert({x, y});
        ASSERT_EQ(pixels(Point{at.x, at.y, 0.5, 9}, tile), square) << at.x << ',' << at.y;
        ASSERT_LE(square.size(), 1U);
    }
}

// Its pixels are those of a line of one pixel that is moved across, pixel by pixel, about its
// middle.
TEST(Segment, OfAWidthIsAsManyPixelsAcrossAboutTheLine) {
    Random random(8);
    VisibilityTile tile;
    std::size_t drawn = 0;
    for (int i = 0; i < 4000; ++i) {
        Segment s = segment({random.whole(0, 64 * 256), random.whole(0, 64 * 256)},
                            {random.whole(0, 64 * 256), random.whole(0, 64 * 256)});
        const int width = random.whole(1, 7);
        s.width = width;
        const Pixels got = pixels(s, tile);
        const auto column = [&](const std::pair<int, int>& p) {
            return is_along_x(s) ? std::pair{p.first, p.second} : std::pair{p.second, p.first};
        };
        std::map<int, std::set<int>> by_column;
        for (const auto& p : got)
            by_column[column(p).first].insert(column(p).second);
        Segment thin = s;
        thin.width = 1;
        std::set<int> columns;
        for (const auto& p : pixels(thin, tile)) {
            const auto [along, across] = column(p);
            columns.insert(along);
            for (int other = across - (width - 1) / 2; other <= across + (width - 1) / 2; ++other)
                if (other >= 0 && other < kSegmentSide) {
                    ASSERT_TRUE(by_column[along].count(other)) << i;
                }
        }
        for (const auto& [along, across] : by_column) {
            ASSERT_TRUE(columns.count(along) != 0 || *across.begin() == 0 ||
                        *across.rbegin() == kSegmentSide - 1)
                << i;
            const bool whole = *across.begin() > 0 && *across.rbegin() < kSegmentSide - 1;
            if (whole) {
                ASSERT_EQ(across.size(), static_cast<std::size_t>(width)) << i;
            }
        }
        drawn += got.size();
    }
    EXPECT_GT(drawn, 100'000U);
}

TEST(Point, OfASizeIsASquareOfItAboutThePoint) {
    Random random(9);
    VisibilityTile tile;
    for (int i = 0; i < 4000; ++i) {
        Point p{random.whole(0, 64 * 256), random.whole(0, 64 * 256), 0.5, 9, random.whole(1, 6)};
        Pixels square;
        for (int y = 0; y < kSegmentSide; ++y)
            for (int x = 0; x < kSegmentSide; ++x) {
                const auto is_in = [&](int pixel, int at) {
                    const int off = 2 * (pixel * 256 + 128 - at);
                    return -p.size * 256 <= off && off < p.size * 256;
                };
                if (is_in(x, p.x) && is_in(y, p.y)) square.insert({x, y});
            }
        ASSERT_EQ(pixels(p, tile), square) << i;
    }
}

TEST(Bounds, OfSegmentsAndPointsHoldTheirPixelsAndStayInThePicture) {
    Random random(7);
    VisibilityTile tile;
    for (int i = 0; i < 20000; ++i) {
        const Segment s = segment(random_end(random, i), random_end(random, i));
        const image::Rect box = pixel_bounds(s, kSegmentSide, kSegmentSide);
        EXPECT_TRUE(box.x0 >= 0 && box.y0 >= 0 && box.x1 <= kSegmentSide && box.y1 <= kSegmentSide);
        for (const auto& [x, y] : exact_pixels({s.x[0], s.y[0]}, {s.x[1], s.y[1]})) {
            const bool in_picture = x >= 0 && y >= 0 && x < kSegmentSide && y < kSegmentSide;
            const bool in_box = x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1;
            EXPECT_TRUE(in_box || !in_picture) << i;
        }
    }
}

} // namespace
} // namespace scanout::raster::test
