// Depth, ties and order: what a tile shows does not depend on who came first.
#include "raster/exact.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

namespace scanout::raster::test {
namespace {

constexpr image::Rect kArea{0, 0, kTileSize, kTileSize};

struct Snapshot {
    std::vector<std::uint32_t> id;
    std::vector<float> depth;
    friend bool operator==(const Snapshot&, const Snapshot&) = default;
};
void append(Snapshot& s, const VisibilityTile& tile) {
    for (int y = tile.area().y0; y < tile.area().y1; ++y) {
        for (int x = tile.area().x0; x < tile.area().x1; ++x) {
            for (int sample = 0; sample < tile.samples(); ++sample) {
                s.id.push_back(tile.id(x, y, sample));
                s.depth.push_back(tile.depth(x, y, sample));
            }
        }
    }
}

std::vector<Triangle> random_triangles(Random& random, int count) {
    std::vector<Triangle> triangles;
    while (triangles.size() < static_cast<std::size_t>(count)) {
        Corners v;
        for (Corner& c : v)
            c = {random.whole(-2000, 18000), random.whole(-2000, 18000)};
        if (!has_area(v)) continue;
        triangles.push_back(set_up(v, static_cast<std::uint32_t>(triangles.size()),
                                   {random.in(0.1, 1), random.in(0.1, 1), random.in(0.1, 1)}));
    }
    return triangles;
}

TEST(Visibility, TheOrderOfDrawingChangesNoBit) {
    Random random(1);
    for (const int samples : {1, 4}) {
        std::vector<Triangle> triangles = random_triangles(random, 200);
        // Some of them twice, with another id: ties at every sample.
        for (int i = 0; i < 50; ++i) {
            Triangle twin = triangles[static_cast<std::size_t>(i)];
            twin.id += 1000;
            triangles.push_back(twin);
        }
        VisibilityTile tile;
        tile.reset(kArea, samples);
        for (const Triangle& t : triangles)
            tile.draw(t);
        Snapshot first;
        append(first, tile);
        EXPECT_TRUE(std::none_of(first.id.begin(), first.id.end(), [](std::uint32_t id) {
            return id >= 1000 && id != kNoPrimitive; // the lower id won every tie
        }));
        for (int i = 0; i < 20; ++i) {
            for (std::size_t k = triangles.size() - 1; k > 0; --k)
                std::swap(
                    triangles[k],
                    triangles[static_cast<std::size_t>(random.whole(0, static_cast<int>(k)))]);
            tile.reset(kArea, samples);
            for (const Triangle& t : triangles)
                tile.draw(t);
            Snapshot again;
            append(again, tile);
            ASSERT_EQ(first, again);
        }
    }
}

TEST(Visibility, TheNearestTriangleIsSeenAtEverySample) {
    // Against exact coverage and depth in long double: where the two nearest are further apart than
    // rounding, the nearer one's id stands.
    Random random(2);
    const std::vector<Triangle> triangles = random_triangles(random, 40);
    VisibilityTile tile;
    tile.reset(kArea, 4);
    for (const Triangle& t : triangles)
        tile.draw(t);
    int checked = 0;
    for (int y = 0; y < kTileSize; ++y) {
        for (int x = 0; x < kTileSize; ++x) {
            for (std::size_t s = 0; s < 4; ++s) {
                const int sx = x * kSubpixel + tile.pattern()[s].x,
                          sy = y * kSubpixel + tile.pattern()[s].y;
                long double best = 0, second = 0;
                std::uint32_t seen = kNoPrimitive;
                for (const Triangle& t : triangles) {
                    if (!ExactTriangle({{{t.x[0], t.y[0]}, {t.x[1], t.y[1]}, {t.x[2], t.y[2]}}})
                             .covers(sx, sy))
                        continue;
                    const auto area = [&](std::size_t i, std::size_t j) {
                        return static_cast<long double>(
                            (Int128{t.x[j]} - t.x[i]) * (Int128{sy} - t.y[i]) -
                            (Int128{t.y[j]} - t.y[i]) * (Int128{sx} - t.x[i]));
                    };
                    const long double a0 = area(1, 2), a1 = area(2, 0), a2 = area(0, 1);
                    const long double depth =
                        (a0 * t.depth[0] + a1 * t.depth[1] + a2 * t.depth[2]) / (a0 + a1 + a2);
                    if (depth > best) {
                        second = best;
                        best = depth;
                        seen = t.id;
                    } else {
                        second = std::max(second, depth);
                    }
                }
                if (seen != kNoPrimitive && best - second < 1e-6L) continue;
                ASSERT_EQ(tile.id(x, y, static_cast<int>(s)), seen) << x << ' ' << y;
                ++checked;
            }
        }
    }
    EXPECT_GT(checked, 16000);
}

// The largest relative error of stored depths against the exact plane, in units of 2^-24.
double depth_error(double w_ratio, int count, std::uint64_t seed) {
    Random random(seed);
    double worst = 0;
    VisibilityTile tile;
    for (int i = 0; i < count; ++i) {
        Corners v;
        std::array<double, 3> depth{};
        for (std::size_t k = 0; k < 3; ++k) {
            v[k] = {random.whole(-3000, 20000), random.whole(-3000, 20000)};
            depth[k] = 0.9 / std::exp2(random.unit() * std::log2(w_ratio));
        }
        depth[static_cast<std::size_t>(random.whole(0, 1))] = 0.9; // the whole span, often
        depth[2] = 0.9 / w_ratio * (1 + random.unit());
        if (!has_area(v)) continue;
        tile.reset(kArea, 1);
        tile.draw(set_up(v, 0, depth));
        const Corner *a = &v[0], *b = &v[1], *c = &v[2];
        const auto area = [](const Corner& p, const Corner& q, int x, int y) {
            return (Int128{q.x} - p.x) * (Int128{y} - p.y) -
                   (Int128{q.y} - p.y) * (Int128{x} - p.x);
        };
        for (int y = 0; y < kTileSize; ++y) {
            for (int x = 0; x < kTileSize; ++x) {
                if (tile.id(x, y) != 0) continue;
                const int sx = x * 256 + 128, sy = y * 256 + 128;
                // Integer areas are exact in long double; the terms have one sign.
                const auto e0 = static_cast<long double>(area(*b, *c, sx, sy)),
                           e1 = static_cast<long double>(area(*c, *a, sx, sy)),
                           e2 = static_cast<long double>(area(*a, *b, sx, sy));
                const long double exact =
                    (e0 * depth[0] + e1 * depth[1] + e2 * depth[2]) / (e0 + e1 + e2);
                const long double relative =
                    std::abs(static_cast<long double>(tile.depth(x, y)) - exact) / exact;
                worst = std::max(worst, static_cast<double>(relative * 0x1p24L));
            }
        }
    }
    return worst;
}

TEST(Visibility, DepthKeepsItsRelativePrecisionAtEveryRatioOfDistances) {
    for (const double ratio : {1.0, 10.0, 1e3, 1e5, 1e7, 1e10}) {
        const double worst = depth_error(ratio, 400, 3);
        EXPECT_LE(worst, 2) << ratio; // 2^-23
        RecordProperty("worst_ratio_" + std::to_string(static_cast<long>(ratio)),
                       testing::PrintToString(worst));
    }
}

TEST(Visibility, AFloatPlaneWouldLoseIt) {
    // The naive method that must fail (HARD-CASES 15): the same triangle by a plane in float.
    const float area = 60.0F * 60;
    const float d0 = 0.9F, d = 0.9e-7F; // w ratio 1e7
    const float slope = (d - d0) / area;
    const float at_far_end = d0 + area * slope;
    EXPECT_GT(std::abs(at_far_end - d) / d, 0.01F);
}

// The whole geometry stage.
Snapshot draw(Jobs& jobs, const geom::Mesh& mesh, const scene::View& view, int width, int height,
              int samples = 1, Facing keep = Facing::any) {
    Geometry geometry;
    geometry.run(jobs, mesh, ScreenTransform(view, width, height),
                 {width, height, keep, view.mirrored, samples});
    Snapshot all;
    VisibilityTile tile;
    for (int i = 0; i < geometry.tiles(); ++i) {
        tile.reset(geometry.tile_area(i), samples);
        geometry.draw(i, tile);
        append(all, tile);
    }
    return all;
}

scene::View camera_at(double distance) {
    scene::View view;
    view.translation = {0, 0, -distance};
    view.half_width = view.half_height = 0.5;
    view.near_distance = 0x1p-12;
    return view;
}

geom::Mesh soup(Random& random, int triangles, double size) {
    geom::Mesh mesh;
    for (int i = 0; i < 3 * triangles; ++i) {
        mesh.position.emplace_back(random.in_cube(size));
        mesh.normal.emplace_back(0, 0, 1);
        mesh.index.push_back(static_cast<std::uint32_t>(i));
    }
    mesh.material.assign(static_cast<std::size_t>(triangles), -1);
    return mesh;
}

TEST(Visibility, TheOrderOfATrianglesVerticesChangesNoBit) {
    // Small, large, behind the eye, across the guard band: sizes from 0.1 to 1000 about an eye that
    // stands among them.
    Jobs jobs(1);
    Random random(4);
    constexpr int kPermutation[5][3] = {{1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (const double size : {0.1, 1.0, 3.0, 30.0, 1000.0}) {
        for (int round = 0; round < 8; ++round) {
            const geom::Mesh mesh = soup(random, 40, size);
            const scene::View view = camera_at(round % 2 == 0 ? 1 : 0.01);
            const Snapshot first = draw(jobs, mesh, view, 100, 70, 4);
            const Snapshot culled = draw(jobs, mesh, view, 100, 70, 4, Facing::front);
            for (const auto& p : kPermutation) {
                geom::Mesh turned = mesh;
                for (std::size_t t = 0; t < mesh.index.size(); t += 3)
                    for (std::size_t k = 0; k < 3; ++k)
                        turned.index[t + k] = mesh.index[t + static_cast<std::size_t>(p[k])];
                ASSERT_EQ(first, draw(jobs, turned, view, 100, 70, 4)) << size << ' ' << round;
                const bool even = &p < &kPermutation[2];
                const Facing keep = even ? Facing::front : Facing::back;
                ASSERT_EQ(culled, draw(jobs, turned, view, 100, 70, 4, keep)) << size;
            }
        }
    }
}

TEST(Visibility, CulledFrontAndCulledBackTogetherAreWhatIsDrawnWithoutCulling) {
    Jobs jobs(1);
    Random random(5);
    for (const double size : {0.5, 3.0, 100.0}) {
        const geom::Mesh mesh = soup(random, 60, size);
        const Snapshot all = draw(jobs, mesh, camera_at(1), 100, 70);
        const Snapshot front = draw(jobs, mesh, camera_at(1), 100, 70, 1, Facing::front);
        const Snapshot back = draw(jobs, mesh, camera_at(1), 100, 70, 1, Facing::back);
        int both = 0;
        for (std::size_t i = 0; i < all.id.size(); ++i) {
            EXPECT_EQ(all.depth[i], std::max(front.depth[i], back.depth[i]));
            EXPECT_EQ(all.id[i], front.depth[i] >= back.depth[i] && front.id[i] != kNoPrimitive
                                     ? front.id[i]
                                     : back.id[i]);
            both += front.id[i] != kNoPrimitive && back.id[i] != kNoPrimitive ? 1 : 0;
        }
        EXPECT_GT(both, 0);
    }
}

TEST(Visibility, ThreadsAndTilesChangeNoBit) {
    Random random(6);
    geom::Mesh mesh = soup(random, 20000, 1);
    for (std::size_t i = 0; i < mesh.position.size(); ++i) // smaller triangles, in several chunks
        mesh.position[i] =
            mesh.position[i - i % 3] + (mesh.position[i] - mesh.position[i - i % 3]) * 0.1F;
    std::optional<Snapshot> first;
    for (const int threads : {1, 2, 3, 7, 16}) {
        Jobs jobs(threads);
        const Snapshot now = draw(jobs, mesh, camera_at(1), 300, 200);
        if (!first) first = now;
        ASSERT_EQ(*first, now) << threads;
    }
}

} // namespace
} // namespace scanout::raster::test
