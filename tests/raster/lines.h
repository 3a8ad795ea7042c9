// What the tests of lines share: the pixels of a segment, rings, long lines, and exact ends.
#pragma once

#include "raster/exact.h"
#include "raster/screen/clip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

namespace scanout::raster::test {

using Pixels = std::set<std::pair<int, int>>;

// In the first tile.
inline Pixels line_pixels(const Corner& a, const Corner& b, VisibilityTile& tile) {
    tile.reset({0, 0, kTileSize, kTileSize}, 1);
    tile.draw_line({{a.x, b.x}, {a.y, b.y}, {0.5, 0.5}, 9});
    Pixels out;
    for (int y = 0; y < kTileSize; ++y)
        for (int x = 0; x < kTileSize; ++x)
            if (tile.id(x, y) == 9) out.insert({x, y});
    return out;
}

// A regular polygon in the tile, its corners on a grid of so many steps of 1/256 px.
inline std::vector<Corner> ring_of(Random& random, int n, int grid) {
    const double radius = random.in(8, 26), turn = random.in(0, 1);
    std::vector<Corner> ring;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * (turn + double{1} * i / n);
        const auto at = [&](double unit) {
            return static_cast<int>(std::lround((32 + radius * unit) * 256 / grid)) * grid;
        };
        ring.push_back({at(std::cos(angle)), at(std::sin(angle))});
    }
    return ring;
}

// Do the pixels of the polygon's lines keep its middle from the outside? A flood from outside goes
// from pixel to pixel along sides.
template <class PixelsOfLine>
bool is_closed(const std::vector<Corner>& ring, const PixelsOfLine& pixels_of) {
    constexpr int kSide = kTileSize;
    std::vector<char> taken(kSide * kSide, 0);
    const auto at = [&](int x, int y) -> char& {
        return taken[static_cast<std::size_t>(y * kSide + x)];
    };
    for (std::size_t i = 0; i < ring.size(); ++i)
        for (const auto& [x, y] : pixels_of(ring[i], ring[(i + 1) % ring.size()]))
            at(x, y) = 1;
    std::vector<std::pair<int, int>> open{{0, 0}};
    at(0, 0) = 1;
    while (!open.empty()) {
        const auto [x, y] = open.back();
        open.pop_back();
        if (x == kSide / 2 && y == kSide / 2) return false;
        for (const auto& [to_x, to_y] : {std::pair{x + 1, y}, {x - 1, y}, {x, y + 1}, {x, y - 1}}) {
            if (to_x < 0 || to_y < 0 || to_x >= kSide || to_y >= kSide || at(to_x, to_y)) continue;
            at(to_x, to_y) = 1;
            open.emplace_back(to_x, to_y);
        }
    }
    return true;
}

// From one side of the guard band to the other, through the first tile.
inline std::pair<Corner, Corner> long_line(Random& random) {
    constexpr int kFar = 32767 * 256;
    const double through_x = random.in(0, 64 * 256), through_y = random.in(0, 64 * 256),
                 slope = random.in(-0.99, 0.99);
    const auto at = [&](int along) {
        return Corner{along,
                      static_cast<int>(std::lround(through_y + (along - through_x) * slope))};
    };
    Corner a = at(-kFar + random.whole(0, 512)), b = at(kFar - random.whole(0, 512));
    if (random.bits() % 2 == 0) std::swap(a.x, a.y), std::swap(b.x, b.y);
    if (random.bits() % 2 == 0) std::swap(a, b);
    return {a, b};
}

// The pixels of the tile whose centre columns the line passes, in whole numbers; its ends lie
// outside.
inline Pixels exact_long_line(const Corner& a, const Corner& b) {
    Pixels out;
    const bool steep = std::abs(std::int64_t{b.y} - a.y) > std::abs(std::int64_t{b.x} - a.x);
    const Int128 from = steep ? a.y : a.x, run = (steep ? b.y : b.x) - from,
                 start = steep ? a.x : a.y, rise = (steep ? b.x : b.y) - start;
    for (int pixel = 0; pixel < kTileSize; ++pixel) {
        Int128 over = start * run + (Int128{pixel} * 256 + 128 - from) * rise, under = run * 256;
        if (under < 0) over = -over, under = -under;
        const Int128 other = over / under - (over % under < 0 ? 1 : 0);
        if (other < 0 || other >= kTileSize) continue;
        const auto across = static_cast<int>(other);
        out.insert(steep ? std::pair{across, pixel} : std::pair{pixel, across});
    }
    return out;
}

// Through the tile, with ends up to a million pixels away.
struct FarLine {
    struct End {
        double x, y;
    } a, b;
    bool steep;
    long double across(long double along) const {
        const long double from = steep ? a.y : a.x, to = steep ? b.y : b.x, low = steep ? a.x : a.y,
                          high = steep ? b.x : b.y;
        return low + (high - low) * ((along - from) / (to - from));
    }
};
inline FarLine far_line(Random& random) {
    const double through = random.in(0, 64), slope = random.in(-0.99, 0.99);
    const auto at = [&](double along) { return FarLine::End{along, through + along * slope}; };
    FarLine line{at(-random.in(40'000, 1e6)), at(random.in(40'000, 1e6)), random.bits() % 2 == 0};
    if (line.steep) std::swap(line.a.x, line.a.y), std::swap(line.b.x, line.b.y);
    return line;
}

// A segment in homogeneous coordinates, and its part within near plane and guard band.
inline constexpr double kNearOfSegments = 1;
struct FarSegment {
    ClipVertex a, b;
};
inline FarSegment far_segment(Random& random) {
    const auto any = [&] {
        const double w = random.bits() % 3 == 0 ? -random.in(0, 100) : random.in(0.5, 100),
                     far = std::exp2(random.in(0, 24));
        return ClipVertex{random.in(-far, far), random.in(-far, far), 1, w};
    };
    return {any(), any()};
}

struct ExactPart {
    long double x[2], y[2]; // pixels
    double length;
    double off(const ClipVertex& v, bool first) const {
        return static_cast<double>(std::max(std::abs(v.x / v.w - x[first ? 0 : 1]),
                                            std::abs(v.y / v.w - y[first ? 0 : 1])));
    }
};
inline double pixels_apart(const ClipVertex& a, const ClipVertex& b) {
    return std::max(std::abs(a.x / a.w - b.x / b.w), std::abs(a.y / a.w - b.y / b.w));
}

// By the shares of the way at which it enters and leaves each half-space: Liang and Barsky's way,
// in long double.
inline std::optional<ExactPart> exact_part(const FarSegment& s) {
    const long double guard = kGuardPixels;
    const auto distances = [&](const ClipVertex& v) {
        return std::array<long double, 5>{v.w - static_cast<long double>(kNearOfSegments),
                                          v.x + guard * v.w, guard * v.w - v.x, v.y + guard * v.w,
                                          guard * v.w - v.y};
    };
    const auto from = distances(s.a), to = distances(s.b);
    long double first = 0, last = 1;
    for (std::size_t i = 0; i < from.size(); ++i) {
        if (from[i] < 0 && to[i] < 0) return {};
        if (from[i] < 0) first = std::max(first, from[i] / (from[i] - to[i]));
        if (to[i] < 0) last = std::min(last, from[i] / (from[i] - to[i]));
    }
    if (first > last) return {};
    ExactPart part{};
    for (int i = 0; i < 2; ++i) {
        const long double t = i == 0 ? first : last;
        const auto at = [&](long double a, long double b) { return a * (1 - t) + b * t; };
        const long double w = at(s.a.w, s.b.w);
        part.x[i] = at(s.a.x, s.b.x) / w;
        part.y[i] = at(s.a.y, s.b.y) / w;
    }
    part.length = static_cast<double>(
        std::max(std::abs(part.x[0] - part.x[1]), std::abs(part.y[0] - part.y[1])));
    return part;
}

} // namespace scanout::raster::test
