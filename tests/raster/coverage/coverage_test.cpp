// Every sample of a mesh's interior is covered exactly once: HARD-CASES 1-3, 7, P1.
#include "raster/coverage/coverage.h"
#include "raster/exactly_once.h"
#include "support/targets.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace scanout::raster::test {
namespace {

constexpr int kTargetSide = 64;

// Pictures begin at 0, so a tile is put where the mesh is; negative offsets are tested with meshes
// that reach in from there.
constexpr int kPlaces[][2] = {{0, 0},       {1000, 0},       {0, 1000},
                              {8192, 8192}, {30000 - 48, 8}, {29952, 29952}};

// Exactly once at every place, in a tile of 64x64 pixels, at every number of samples.
template <class F>
std::int64_t once_everywhere(F&& make) {
    std::int64_t samples_seen = 0;
    for (const auto& [x, y] : kPlaces) {
        for (const int samples : {1, 2, 4, 8, 16}) {
            SnappedMesh mesh = make();
            mesh.move(x, y);
            const Hits hits = hits_in_tile(mesh, x, y, samples);
            EXPECT_EQ(hits.none, 0) << x << ' ' << y << ' ' << samples;
            EXPECT_EQ(hits.more, 0) << x << ' ' << y << ' ' << samples;
            samples_seen += hits.once;
        }
    }
    return samples_seen;
}

// Of the triangle with its last vertex moved many times as far away from the first.
ClippedTriangles clipped_far_out(const SnappedTriangle& t, int times) {
    const auto &from = t.vertex[0], &to = t.vertex[2];
    const auto far = [&](double a, double b) { return (a + times * (b - a)) / kSubpixel * 3; };
    const ExactPoint points[] = {
        point_on_screen(from), point_on_screen(t.vertex[1]),
        point_off_screen({far(from.x, to.x), far(from.y, to.y), to.depth * 3, 3})};
    return split_polygon(points, t.id);
}

// A tile's planes, filled by the kernel alone.
struct Drawn {
    static constexpr std::size_t kPlane = std::size_t{kTileSize} * kTileSize;
    std::vector<float> depth, farthest = std::vector<float>(64, 0.0F);
    std::vector<std::uint32_t> id;
    int skipped = 0; // calls after which nothing had changed

    // With a number above 1 it is drawn as the clipped triangles of one so many times as large.
    Drawn(const std::vector<std::pair<SnappedTriangle, int>>& all, const image::Rect& area,
          int samples, bool skip)
        : depth(kPlane * static_cast<std::size_t>(samples), 0.0F),
          id(kPlane * static_cast<std::size_t>(samples) + 16, kNoPrimitive) {
        const TilePlanes planes{area, sample_pattern(samples),         depth.data(), id.data(),
                                {},   skip ? farthest.data() : nullptr};
        const std::uint32_t corner[3] = {0, 1, 2}, first = 0;
        for (const auto& [t, times] : all) {
            bool shows = false;
            if (times == 1)
                shows = draw_triangles(planes, {t.vertex, corner, {&first, 1}, {&t.id, 1}});
            else
                for (const ClippedTriangle& clipped : clipped_far_out(t, times))
                    shows |= draw_clipped(planes, {clipped, extent_of(planes.pattern)});
            skipped += shows ? 0 : 1;
        }
    }
};

// Tiles anywhere, some cut by the picture's edge.
image::Rect any_tile(Random& random) {
    const int x = random.whole(0, 400) * kTileSize, y = random.whole(0, 400) * kTileSize;
    const auto side = [&] { return random.whole(0, 3) > 0 ? kTileSize : random.whole(1, 64); };
    return {x, y, x + side(), y + side()};
}

// Planes that nearly touch and planes that cross, from far smaller than a block to far larger than
// the tile, at depths of all sizes that views allow; ids in no order, a quarter of them clipped.
std::vector<std::pair<SnappedTriangle, int>> layers_over(const image::Rect& tile, Random& random) {
    const double slope = std::ldexp(1.0, -random.whole(1, 30)),
                 scale = std::ldexp(1.0, -random.whole(0, random.whole(0, 3) > 0 ? 10 : 118));
    std::vector<std::pair<SnappedTriangle, int>> all;
    for (std::uint32_t i = 0; i < 60; ++i) {
        const int size = 256 << random.whole(1, 14), reach = (1 << 23) - 1;
        const double middle = 0.5 + random.whole(-3, 3) * slope / 4;
        const auto about = [&](int corner) {
            const int at = (corner + 32) * 256 + random.whole(-size, size);
            return std::clamp(at, -reach, reach);
        };
        SnappedTriangle t{{}, i * 7919 % 60};
        for (ScreenVertex& v : t.vertex) {
            const double steps = random.whole(-8, 8) * (random.whole(0, 1) > 0 ? 1 : 30);
            const double depth = std::clamp(middle + steps * slope / 64, 1e-3, 1.0) * scale;
            v = {about(tile.x0), about(tile.y0), depth};
        }
        all.emplace_back(t, random.whole(0, 3) > 0 ? 1 : random.whole(2, 4000));
    }
    return all;
}

// What lies behind all that is seen in a block is not looked at: nothing may come of it but time.
TEST(Coverage, WhatIsSkippedBehindOthersWouldNotHaveBeenSeen) {
    Random random(77);
    int rejected = 0, known = 0;
    for (int round = 0; round < 600; ++round) {
        const image::Rect area = any_tile(random);
        const auto all = layers_over(area, random);
        const int samples = 1 << round % 5;
        const Drawn with(all, area, samples, true), without(all, area, samples, false);
        ASSERT_EQ(with.skipped, without.skipped) << round;
        rejected += with.skipped;
        const std::size_t pixels = with.depth.size();
        for (std::size_t i = 0; i < pixels; ++i) {
            const std::size_t x = i % kTileSize, y = i % Drawn::kPlane / kTileSize;
            ASSERT_GE(with.depth[i], with.farthest[y / 8 * 8 + x / 8]) << round;
            if (static_cast<int>(x) >= area.width() || static_cast<int>(y) >= area.height())
                continue;
            ASSERT_EQ(with.depth[i], without.depth[i]) << round << ' ' << x << ' ' << y;
            ASSERT_EQ(with.id[i], without.id[i]) << round << ' ' << x << ' ' << y;
        }
        for (const float farthest : with.farthest)
            known += farthest > 0 ? 1 : 0;
    }
    EXPECT_GT(rejected, 10000);
    EXPECT_GT(known, 600 * 20);
    record("rejected", rejected);
}

// Beyond the picture's edge, too, and in whether something shows.
TEST(Coverage, IsTheSameOnEveryTarget) {
    Random random(78);
    for (int round = 0; round < 60; ++round) {
        const image::Rect area = any_tile(random);
        const auto all = layers_over(area, random);
        const int samples = 1 << round % 5;
        std::unique_ptr<Drawn> first;
        scanout::test::on_every_target([&](const std::string& target) {
            const Drawn drawn(all, area, samples, round % 2 == 0);
            if (first == nullptr) first = std::make_unique<Drawn>(drawn);
            EXPECT_EQ(drawn.skipped, first->skipped) << target << ' ' << round;
            EXPECT_TRUE(drawn.depth == first->depth) << target << ' ' << round;
            EXPECT_TRUE(drawn.id == first->id) << target << ' ' << round;
        });
    }
}

// Triangles of all kinds, clipped ones included.
TEST(Coverage, ATileThatKeepsDepthAloneHasTheDepthsOfOneThatHasIds) {
    Random random(79);
    int double_depth = 0, rejected = 0;
    for (int round = 0; round < 60; ++round) {
        const image::Rect area = any_tile(random);
        const auto all = layers_over(area, random);
        const int samples = 1 << round % 5;
        scanout::test::on_every_target([&](const std::string& target) {
            VisibilityTile full, alone;
            full.reset(area, samples);
            alone.reset(area, samples, {}, TileFormat::depth_only);
            for (const auto& [t, times] : all) {
                bool shows = false, shows_alone = false;
                if (times == 1) {
                    shows = full.draw(std::span(&t, 1));
                    shows_alone = alone.draw(std::span(&t, 1));
                } else {
                    for (const ClippedTriangle& clipped : clipped_far_out(t, times)) {
                        shows |= full.draw_clipped(clipped);
                        shows_alone |= alone.draw_clipped(clipped);
                    }
                }
                EXPECT_LE(shows_alone, shows) << target; // not at a tie
                double_depth += has_float_depth(t) ? 0 : 1;
                rejected += shows ? 0 : 1;
            }
            for (int s = 0; s < samples; ++s)
                EXPECT_TRUE(std::ranges::equal(alone.depths(s), full.depths(s)))
                    << target << ' ' << round;
        });
    }
    EXPECT_GT(double_depth, 500);
    EXPECT_GT(rejected, 1000);
}

TEST(Coverage, ATileThatKeepsDepthAloneIsNotAskedForIds) {
    VisibilityTile tile, other;
    other.reset({0, 0, 8, 8}, 1);
    tile.reset({0, 0, 8, 8}, 1, {}, TileFormat::depth_only);
    EXPECT_FALSE(tile.has_ids());
    EXPECT_DEATH((void)tile.id(0, 0), "has_ids");
    EXPECT_DEATH((void)tile.ids(0), "has_ids");
    EXPECT_DEATH(other.take(tile, {0, 0, 8, 8}), "has_ids");
    EXPECT_DEATH(other.keep_support(tile), "has_ids");
    tile.reset({0, 0, 8, 8}, 1, {.test = DepthTest::greater}, TileFormat::depth_only);
    EXPECT_TRUE(tile.has_ids()); // that rule goes by them
}

// HARD-CASES 1, 7, P1
TEST(Coverage, AJitteredGridCoversEverySampleOnce) {
    Random random(1);
    std::int64_t once = 0;
    for (int i = 0; i < 12; ++i)
        once += once_everywhere([&] { return jittered_grid(random); });
    EXPECT_EQ(once, std::int64_t{12} * 6 * 64 * 64 * 31);
    record("samples_covered_once", static_cast<double>(once));
}

// HARD-CASES 1, P1
TEST(Coverage, ATurnedGridCoversEverySampleOnceAtSixtyFourAngles) {
    std::int64_t once = 0;
    for (int i = 0; i <= 64; ++i) {
        once += once_everywhere([&] { return turned_grid(90.0 * i / 64); });
        ASSERT_FALSE(HasFailure()) << i;
    }
    EXPECT_EQ(once, std::int64_t{65} * 6 * 64 * 64 * 31);
    record("samples_covered_once", static_cast<double>(once));
}

// HARD-CASES 3, P1: slivers thinner than 1/256 pixel. Hubs on a pixel centre, on a corner of
// pixels, and on neither.
TEST(Coverage, AFanOfTwentyThousandSliversCoversEverySampleOnce) {
    std::int64_t once = 0;
    for (const Corner& hub : {Corner{32 * 256 + 128, 32 * 256 + 128}, Corner{32 * 256, 32 * 256},
                              Corner{31 * 256 + 77, 40 * 256 + 201}}) {
        for (const auto& [x, y] : kPlaces) {
            SnappedMesh mesh = fan(hub, 20000, around(kTargetSide));
            mesh.move(x, y);
            const Hits hits = hits_in_tile(mesh, x, y, 1);
            ASSERT_EQ(hits.faults(), 0) << x << ' ' << y;
            once += hits.once;
        }
    }
    const Hits many =
        hits_in_tile(fan({31 * 256 + 77, 40 * 256 + 201}, 20000, around(kTargetSide)), 0, 0, 16);
    EXPECT_EQ(many.faults(), 0);
    record("samples_covered_once", static_cast<double>(once + many.once));
}

// HARD-CASES 2, P1: n = 3...1024, the shared vertex on a pixel centre.
TEST(Coverage, TrianglesAboutAPixelCentreCoverItOnce) {
    std::int64_t once = 0;
    for (int n = 3; n <= 1024; ++n) {
        const SnappedMesh mesh = centre_fan({20 * 256 + 128, 30 * 256 + 128}, n, 140);
        const Hits hits = hits_in_tile(mesh, 16, 24, 1, 16);
        ASSERT_EQ(hits.faults(), 0) << n;
        once += hits.once;
    }
    EXPECT_EQ(once, 1022 * 16 * 16);
    record("samples_covered_once", static_cast<double>(once));
}

// HARD-CASES P1
TEST(Coverage, ADelaunayTriangulationCoversEverySampleOnce) {
    Random random(8);
    std::int64_t once = 0;
    for (const int points : {3, 20, 100, 400})
        once += once_everywhere([&] { return delaunay(random, points, around(kTargetSide)); });
    EXPECT_EQ(once, std::int64_t{4} * 6 * 64 * 64 * 31);
    record("samples_covered_once", static_cast<double>(once));
}

TEST(Coverage, RandomlySplitSquaresCoverEverySampleOnce) {
    Random random(2);
    for (const int step : {1, 16, 128})
        for (int i = 0; i < 2; ++i)
            once_everywhere(
                [&] { return split_at_random(random, 200, step, around(kTargetSide)); });
}

// HARD-CASES P1; negative offsets: the hub lies up to the guard band's edge away, and the tile sees
// long slivers that reach in from there.
TEST(Coverage, TrianglesFromFarAwayCoverEverySampleOnce) {
    std::int64_t once = 0;
    for (const int reach : {1000, 8192, 30000, 32700}) {
        for (const auto& [sx, sy] :
             {std::pair{-1, -1}, {-1, 1}, {1, -1}, {-1, 0}, {0, -1}, {1, 1}}) {
            SnappedMesh mesh;
            mesh.vertex.push_back({sx * reach * 256 + 11, sy * reach * 256 + 3});
            const double middle = std::atan2(-sy, -sx);
            const int n = 2000;
            for (int i = 0; i <= n; ++i) {
                // A rim beyond the tile, seen from the hub
                const double angle = middle + (static_cast<double>(i) / n - 0.5) * 1.2;
                const double far = reach * 1.5 + 200;
                const auto snapped = [&](double v, double hub) {
                    return static_cast<std::int32_t>(
                        std::clamp(std::lround((v + hub) * 256), -32767L * 256, 32767L * 256));
                };
                mesh.vertex.push_back({snapped(std::cos(angle) * far, sx * reach),
                                       snapped(std::sin(angle) * far, sy * reach)});
                if (i > 0)
                    mesh.triangle.push_back({0, mesh.vertex.size() - 2, mesh.vertex.size() - 1});
            }
            for (const int samples : {1, 4}) {
                const Hits hits = hits_in_tile(mesh, 0, 0, samples);
                ASSERT_EQ(hits.faults(), 0) << reach << ' ' << sx << sy;
                once += hits.once;
            }
        }
    }
    record("samples_covered_once", static_cast<double>(once));
}

// HARD-CASES P1: whole pictures, through the geometry stage, its bins and tiles.
struct Frame {
    int width, height;
    int fan;  // slivers
    int step; // every step-th tile is looked at
    friend void PrintTo(const Frame& f, std::ostream* out) { *out << f.width << 'x' << f.height; }
};

class Frames : public testing::TestWithParam<Frame> {};

TEST_P(Frames, AreCoveredOnceByEveryMesh) {
    const Frame& f = GetParam();
    const int size = std::max(f.width, f.height);
    Random random(static_cast<std::uint64_t>(size));
    Hits all;
    const auto look = [&](const char* name, const SnappedMesh& mesh, int samples, int step = 1) {
        const Hits hits = hits_in_picture(mesh, f.width, f.height, samples, step);
        EXPECT_EQ(hits.none, 0) << name << ' ' << samples;
        EXPECT_EQ(hits.more, 0) << name << ' ' << samples;
        all += hits;
    };
    const int most = size <= 258 ? 16 : 1;
    for (int samples = 1; samples <= most; samples *= 2) {
        look("jittered grid", jittered_grid(random, size), samples);
        look("turned grid", turned_grid(random.in(0, 90), size), samples);
        look("Delaunay", delaunay(random, std::clamp(size, 10, 2000), around(size)), samples);
    }
    const int middle = size / 2 * 256 + 128; // a pixel centre
    look("centre fan", fan({middle, middle}, 64, around(size)), most, f.step);
    look("sliver fan", fan({size * 120 + 77, size * 141 + 3}, f.fan, around(size)), 1, f.step);
    record("samples_covered_once", static_cast<double>(all.once));
    EXPECT_GE(all.once, std::int64_t{3} * f.width * f.height);
}
INSTANTIATE_TEST_SUITE_P(P1, Frames,
                         testing::Values(Frame{1, 1, 20000, 1}, Frame{64, 64, 20000, 1},
                                         Frame{256, 256, 20000, 1}, Frame{258, 258, 20000, 1},
                                         Frame{1920, 1080, 20000, 17},
                                         Frame{4096, 4096, 20000, 97}),
                         [](const auto& frame) { return testing::PrintToString(frame.param); });

// HARD-CASES P1: 0 hits outside. A square with corners that are no pixel corners: by the top-left
// rule it holds the samples with low <= x, y < high.
TEST(Coverage, NothingIsDrawnOutsideAMesh) {
    Random random(9);
    for (const int samples : {1, 4, 16}) {
        for (int i = 0; i < 12; ++i) {
            const Square square{random.whole(20 * 256, 60 * 256),
                                random.whole(150 * 256, 240 * 256)};
            const SnappedMesh mesh = i % 3 == 0
                                         ? fan({100 * 256 + 128, 90 * 256 + 128}, 2000, square)
                                     : i % 3 == 1 ? delaunay(random, 200, square)
                                                  : split_at_random(random, 100, 1, square);
            std::int64_t inside = 0;
            for (int y = 0; y < 256; ++y)
                for (int x = 0; x < 256; ++x)
                    for (const SampleOffset& at : sample_pattern(samples)) {
                        const int sx = x * 256 + at.x, sy = y * 256 + at.y;
                        inside += sx >= square.low && sx < square.high && sy >= square.low &&
                                  sy < square.high;
                    }
            const Hits hits = hits_in_picture(mesh, 256, 256, samples);
            ASSERT_EQ(hits.once, inside) << samples << ' ' << i;
            ASSERT_EQ(hits.more, 0) << samples << ' ' << i;
            ASSERT_EQ(hits.none, std::int64_t{256} * 256 * samples - inside) << samples << ' ' << i;
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
