#include "raster/exact.h"
#include "raster/sample_pattern.h"
#include "raster/tile.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

namespace scanout::raster::test {
namespace {

constexpr int kSide = kTileSize;

// How often each sample of a tile is covered when the triangles are drawn one by one.
class HitCounter {
public:
    HitCounter(int x, int y, int samples)
        : area_{x, y, x + kSide, y + kSide}, samples_(samples),
          hits_(static_cast<std::size_t>(kSide * kSide * samples)) {}

    void draw(const Corners& v) {
        if (!has_area(v)) return;
        const Triangle t = set_up(v, 7);
        const image::Rect box = pixel_bounds(t, area_.x1, area_.y1);
        if (box.x0 >= area_.x1 || box.y0 >= area_.y1 || box.x1 <= area_.x0 || box.y1 <= area_.y0)
            return;
        tile_.reset(area_, samples_);
        tile_.draw(t);
        if (tile_.empty()) return;
        std::size_t i = 0;
        for (int y = area_.y0; y < area_.y1; ++y)
            for (int x = area_.x0; x < area_.x1; ++x)
                for (int sample = 0; sample < samples_; ++sample)
                    hits_[i++] += tile_.id(x, y, sample) == 7 ? 1 : 0;
    }
    // Samples that are covered any number of times but once.
    std::int64_t faults() const {
        return std::count_if(hits_.begin(), hits_.end(), [](int hits) { return hits != 1; });
    }

private:
    image::Rect area_;
    int samples_;
    std::vector<int> hits_;
    VisibilityTile tile_;
};

// A mesh over [-16, 80] pixels in both directions, moved by `origin`: vertices are shared.
struct SnappedMesh {
    std::vector<Corner> vertex;
    std::vector<std::array<std::size_t, 3>> triangle;
    void move(int x, int y) {
        for (Corner& v : vertex)
            v = {v.x + x * kSubpixel, v.y + y * kSubpixel};
    }
};

constexpr int kLow = -16 * kSubpixel, kHigh = 80 * kSubpixel;

// Eight pixels a cell; `place` maps the grid's pixels to where the vertex stands.
template <class F>
SnappedMesh grid(int cells, F&& place) {
    SnappedMesh mesh;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i)
            mesh.vertex.push_back(place(i, j));
    const auto at = [&](int i, int j) { return static_cast<std::size_t>(j * (cells + 1) + i); };
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            const std::size_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1),
                              d = at(i, j + 1);
            if ((i + j) % 2 == 0)
                mesh.triangle.insert(mesh.triangle.end(), {{a, b, c}, {c, d, a}});
            else
                mesh.triangle.insert(mesh.triangle.end(), {{a, d, b}, {b, d, c}});
        }
    }
    return mesh;
}

SnappedMesh jittered_grid(Random& random) {
    return grid(12, [&](int i, int j) {
        return Corner{(i * 8 - 16) * kSubpixel + random.whole(-300, 300),
                      (j * 8 - 16) * kSubpixel + random.whole(-300, 300)};
    });
}

SnappedMesh turned_grid(double degrees) {
    const double s = std::sin(degrees * std::numbers::pi / 180),
                 c = std::cos(degrees * std::numbers::pi / 180);
    return grid(14, [&](int i, int j) {
        const double x = (i - 7) * 8, y = (j - 7) * 8;
        return Corner{static_cast<std::int32_t>(std::lround((x * c - y * s + 32) * kSubpixel)),
                      static_cast<std::int32_t>(std::lround((x * s + y * c + 32) * kSubpixel))};
    });
}

// n triangles from a hub to the rim of the square.
SnappedMesh fan(const Corner& hub, int n) {
    SnappedMesh mesh;
    mesh.vertex.push_back(hub);
    const std::int64_t side = kHigh - kLow;
    for (int i = 0; i < n; ++i) {
        // The square's corners are among the rim's vertices, or the fan would cut them off.
        const std::int64_t along = 4 * side * i / n;
        const auto on = static_cast<std::int32_t>(along % side);
        const Corner rim[] = {
            {kLow + on, kLow}, {kHigh, kLow + on}, {kHigh - on, kHigh}, {kLow, kHigh - on}};
        mesh.vertex.push_back(rim[along / side]);
    }
    for (int i = 0; i < n; ++i)
        mesh.triangle.push_back(
            {0, static_cast<std::size_t>(1 + i), static_cast<std::size_t>(1 + (i + 1) % n)});
    return mesh;
}

// A square into which points are put one by one, each splitting the triangle that holds it; many
// slivers, and triangles of area 0 where a point falls on an edge.
SnappedMesh split_at_random(Random& random, int points, int grid_step) {
    SnappedMesh mesh;
    mesh.vertex = {{kLow, kLow}, {kHigh, kLow}, {kHigh, kHigh}, {kLow, kHigh}};
    mesh.triangle = {{0, 1, 2}, {0, 2, 3}};
    const auto cross = [&](std::size_t a, std::size_t b, const Corner& p) {
        const Corner &u = mesh.vertex[a], &v = mesh.vertex[b];
        return (Int128{v.x} - u.x) * (Int128{p.y} - u.y) -
               (Int128{v.y} - u.y) * (Int128{p.x} - u.x);
    };
    while (points > 0) {
        const Corner p{random.whole(kLow / grid_step, kHigh / grid_step) * grid_step,
                       random.whole(kLow / grid_step, kHigh / grid_step) * grid_step};
        for (auto& t : mesh.triangle) {
            const auto [a, b, c] = t;
            if (cross(a, b, p) < 0 || cross(b, c, p) < 0 || cross(c, a, p) < 0) continue;
            const std::size_t n = mesh.vertex.size();
            t = {a, b, n};
            mesh.triangle.push_back({b, c, n});
            mesh.triangle.push_back({c, a, n});
            mesh.vertex.push_back(p);
            break;
        }
        --points;
    }
    return mesh;
}

std::int64_t faults(const SnappedMesh& mesh, int x, int y, int samples) {
    HitCounter counter(x, y, samples);
    for (const auto& [a, b, c] : mesh.triangle)
        counter.draw({mesh.vertex[a], mesh.vertex[b], mesh.vertex[c]});
    return counter.faults();
}

// Pictures start at 0, so a tile is put where the mesh is; large negative places are tested below
// with triangles that reach in from there.
constexpr int kPlaces[][2] = {{0, 0},       {1000, 0},  {0, 1000},
                              {8192, 8192}, {30000, 1}, {30000, 30000}};

template <class F>
void everywhere_once(F&& make) {
    for (const auto& [x, y] : kPlaces) {
        for (const int samples : {1, 2, 4, 8, 16}) {
            SnappedMesh mesh = make();
            mesh.move(x, y);
            ASSERT_EQ(faults(mesh, x, y, samples), 0) << x << ' ' << y << ' ' << samples;
        }
    }
}

TEST(Coverage, AJitteredGridCoversEverySampleOnce) {
    Random random(1);
    for (int i = 0; i < 4; ++i)
        everywhere_once([&] { return jittered_grid(random); });
}

TEST(Coverage, ATurnedGridCoversEverySampleOnceAtSixtyFourAngles) {
    for (int i = 0; i <= 64; ++i) {
        SnappedMesh mesh = turned_grid(90.0 * i / 64);
        ASSERT_EQ(faults(mesh, 0, 0, 1), 0) << i;
        ASSERT_EQ(faults(mesh, 0, 0, 4), 0) << i;
        mesh.move(30000, 8192);
        ASSERT_EQ(faults(mesh, 30000, 8192, 1), 0) << i;
    }
}

TEST(Coverage, AFanOfTwentyThousandSliversCoversEverySampleOnce) {
    // Hubs on a pixel centre, on a corner of pixels, and on neither.
    for (const Corner& hub : {Corner{32 * 256 + 128, 32 * 256 + 128}, Corner{32 * 256, 32 * 256},
                              Corner{31 * 256 + 77, 40 * 256 + 201}}) {
        for (const auto& [x, y] : kPlaces) {
            SnappedMesh mesh = fan(hub, 20000);
            mesh.move(x, y);
            ASSERT_EQ(faults(mesh, x, y, 1), 0) << x << ' ' << y;
        }
    }
    EXPECT_EQ(faults(fan({31 * 256 + 77, 40 * 256 + 201}, 20000), 0, 0, 16), 0);
}

TEST(Coverage, TrianglesAboutAPixelCentreCoverItOnce) {
    for (int n = 4; n <= 1024; n += n < 64 ? 4 : 60)
        ASSERT_EQ(faults(fan({20 * 256 + 128, 30 * 256 + 128}, n), 0, 0, 1), 0) << n;
}

TEST(Coverage, RandomlySplitSquaresCoverEverySampleOnce) {
    Random random(2);
    for (const int step : {1, 16, 128}) {
        for (int i = 0; i < 2; ++i)
            everywhere_once([&] { return split_at_random(random, 200, step); });
    }
}

TEST(Coverage, TrianglesFromFarAwayCoverEverySampleOnce) {
    // The hub lies at the guard band's edge: the tile sees long slivers that reach in from there.
    Random random(3);
    for (const int reach : {1000, 8192, 30000}) {
        for (const auto& [sx, sy] :
             {std::pair{-1, -1}, {-1, 1}, {1, -1}, {-1, 0}, {0, -1}, {1, 1}}) {
            SnappedMesh mesh;
            mesh.vertex.push_back({sx * reach * kSubpixel + 11, sy * reach * kSubpixel + 3});
            const double middle = std::atan2(-sy, -sx);
            const int n = 2000;
            for (int i = 0; i <= n; ++i) {
                // A rim beyond the tile, seen from the hub
                const double angle = middle + (static_cast<double>(i) / n - 0.5) * 1.2;
                const double far = reach * 1.5 + 200;
                const auto snapped = [&](double v, double hub) {
                    return static_cast<std::int32_t>(std::clamp(std::lround((v + hub) * kSubpixel),
                                                                -32767L * 256, 32767L * 256));
                };
                mesh.vertex.push_back({snapped(std::cos(angle) * far, sx * reach),
                                       snapped(std::sin(angle) * far, sy * reach)});
                if (i > 0)
                    mesh.triangle.push_back({0, mesh.vertex.size() - 2, mesh.vertex.size() - 1});
            }
            ASSERT_EQ(faults(mesh, 0, 0, 1), 0) << reach << ' ' << sx << sy;
            ASSERT_EQ(faults(mesh, 0, 0, 4), 0) << reach << ' ' << sx << sy;
        }
    }
}

Corners random_corners(Random& random, int kind) {
    Corners v;
    for (Corner& c : v) {
        switch (kind % 8) {
        case 0: // anywhere
            c = {random.whole(-20 * 256, 84 * 256), random.whole(-20 * 256, 84 * 256)};
            break;
        case 1: // pixel corners
            c = {random.whole(-2, 66) * 256, random.whole(-2, 66) * 256};
            break;
        case 2: // pixel centres
            c = {random.whole(-2, 66) * 256 + 128, random.whole(-2, 66) * 256 + 128};
            break;
        case 3: // small
            c = {20 * 256 + random.whole(0, 700), 20 * 256 + random.whole(0, 700)};
            break;
        case 4: // the whole guard band
            c = {random.whole(-32767 * 256, 32767 * 256), random.whole(-32767 * 256, 32767 * 256)};
            break;
        case 5: // sixteenths, where the samples of the patterns lie
            c = {random.whole(-16, 1040) * 16, random.whole(-16, 1040) * 16};
            break;
        default:
            c = {random.whole(0, 64 * 256), random.whole(0, 64 * 256)};
        }
    }
    if (kind % 8 == 6) { // collinear, or off by one step of the grid
        v[2] = {v[0].x + 2 * (v[1].x - v[0].x), v[0].y + 2 * (v[1].y - v[0].y)};
        v[2].x += random.whole(-1, 1);
    }
    if (kind % 8 == 7 && random.bits() % 2 == 0)
        v[2] = v[static_cast<std::size_t>(random.whole(0, 1))];
    return v;
}

// Samples of a tile at (0, 0) in which the rasteriser and the oracle differ.
int mismatches(const Corners& v, int samples, VisibilityTile& tile) {
    tile.reset({0, 0, kSide, kSide}, samples);
    if (has_area(v)) tile.draw(set_up(v, 3));
    const ExactTriangle exact(v);
    int wrong = 0;
    for (std::size_t s = 0; s < tile.pattern().size(); ++s) {
        for (int y = 0; y < kSide; ++y) {
            auto e = exact.at(tile.pattern()[s].x, y * kSubpixel + tile.pattern()[s].y);
            for (int x = 0; x < kSide; ++x, exact.step_right(e))
                wrong += (tile.id(x, y, static_cast<int>(s)) == 3) != exact.inside(e);
        }
    }
    return wrong;
}

TEST(Coverage, AHundredThousandTrianglesAgreeWithExactArithmetic) {
    Random random(4);
    VisibilityTile tile;
    for (int i = 0; i < 100000; ++i) {
        const Corners v = random_corners(random, i);
        ASSERT_EQ(mismatches(v, 1, tile), 0)
            << i << ": " << v[0].x << ',' << v[0].y << ' ' << v[1].x << ',' << v[1].y << ' '
            << v[2].x << ',' << v[2].y;
    }
}

TEST(Coverage, EverySampleOfEveryPatternAgreesWithExactArithmetic) {
    Random random(5);
    VisibilityTile tile;
    for (const int samples : {2, 4, 8, 16})
        for (int i = 0; i < 1500; ++i)
            ASSERT_EQ(mismatches(random_corners(random, i), samples, tile), 0)
                << samples << ' ' << i;
}

TEST(Coverage, WholePixelShiftsMoveTheMaskAlong) {
    Random random(6);
    VisibilityTile tile, moved;
    for (int i = 0; i < 3000; ++i) {
        Corners v = random_corners(random, 3);
        for (Corner& c : v)
            c = {c.x + random.whole(0, 9) * 256, c.y + random.whole(0, 9) * 256};
        if (!has_area(v)) continue;
        tile.reset({0, 0, kSide, kSide}, 1);
        tile.draw(set_up(v, 1));
        const int dx = random.whole(-16, 16), dy = random.whole(-16, 16);
        for (Corner& c : v)
            c = {c.x + dx * 256, c.y + dy * 256};
        moved.reset({0, 0, kSide, kSide}, 1);
        moved.draw(set_up(v, 1));
        for (int y = 16; y < kSide - 16; ++y)
            for (int x = 16; x < kSide - 16; ++x)
                ASSERT_EQ(tile.id(x, y), moved.id(x + dx, y + dy)) << i;
    }
}

TEST(Coverage, BoundsNeverLoseACoveredSample) {
    Random random(7);
    for (int i = 0; i < 4000; ++i) {
        const Corners v = random_corners(random, i);
        if (!has_area(v)) continue;
        const int width = random.whole(1, 64), height = random.whole(1, 64);
        const auto pattern = sample_pattern(1 << i % 5);
        const image::Rect box = pixel_bounds(set_up(v, 0), width, height, extent_of(pattern));
        EXPECT_GE(box.x0, 0);
        EXPECT_GE(box.y0, 0);
        EXPECT_LE(box.x1, width);
        EXPECT_LE(box.y1, height);
        const ExactTriangle exact(v);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (const SampleOffset& at : pattern) {
                    if (x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1) continue;
                    ASSERT_FALSE(exact.covers(x * kSubpixel + at.x, y * kSubpixel + at.y)) << i;
                }
    }
}

TEST(SamplePattern, LiesOnTheSixteenthGridWithOneSampleARowAndColumn) {
    for (const int samples : {1, 2, 4, 8, 16}) {
        const auto pattern = sample_pattern(samples);
        ASSERT_EQ(pattern.size(), static_cast<std::size_t>(samples));
        std::set<int> rows, columns;
        for (const SampleOffset& at : pattern) {
            EXPECT_EQ(at.x % 16, 0);
            EXPECT_EQ(at.y % 16, 0);
            EXPECT_TRUE(at.x >= 0 && at.x < kSubpixel && at.y >= 0 && at.y < kSubpixel);
            rows.insert(at.y);
            columns.insert(at.x);
        }
        EXPECT_EQ(rows.size(), pattern.size());
        EXPECT_EQ(columns.size(), pattern.size());
    }
    EXPECT_EQ(sample_pattern(1)[0].x, kSubpixel / 2);
    EXPECT_EQ(sample_pattern(1)[0].y, kSubpixel / 2);
    for (const int none : {-1, 0, 3, 5, 6, 7, 9, 32})
        EXPECT_TRUE(sample_pattern(none).empty());
}

} // namespace
} // namespace scanout::raster::test
