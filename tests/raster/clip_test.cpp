#include "raster/clip.h"
#include "raster/exact.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace scanout::raster::test {
namespace {

constexpr double kNear = 0x1p-10;

bool same_bits(const ClipVertex& a, const ClipVertex& b) {
    const auto bits = [](double d) { return std::bit_cast<std::uint64_t>(d); };
    return bits(a.x) == bits(b.x) && bits(a.y) == bits(b.y) && bits(a.z) == bits(b.z) &&
           bits(a.w) == bits(b.w);
}

// Pixels times w, about a picture of 640x480 or far outside; w > near or not.
ClipVertex random_vertex(Random& random, bool in_front, double pixels) {
    const double w = in_front ? kNear + std::exp2(random.in(-9, 6)) : -std::exp2(random.in(-9, 6));
    return {random.in(-pixels, pixels) * std::abs(w), random.in(-pixels, pixels) * std::abs(w),
            kNear, w};
}

std::vector<ClipVertex> clipped(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c) {
    ClipPolygon polygon;
    polygon.vertex[0] = a;
    polygon.vertex[1] = b;
    polygon.vertex[2] = c;
    polygon.count = 3;
    clip(polygon, {.near_w = kNear});
    return {polygon.vertex.begin(), polygon.vertex.begin() + polygon.count};
}

TEST(Clip, ASharedEdgeIsCutAtTheSameBitsFromBothSides) {
    Random random(1);
    int cuts = 0, naive_differs = 0;
    for (int i = 0; i < 200000; ++i) {
        const double pixels = i % 3 == 0 ? 1e6 : 500; // across the guard band, or only near
        const ClipVertex a = random_vertex(random, true, pixels),
                         b = random_vertex(random, i % 2 == 0, pixels);
        const ClipVertex c = random_vertex(random, random.bits() % 2 == 0, pixels),
                         d = random_vertex(random, random.bits() % 2 == 0, pixels);
        // Neighbours name the edge in opposite directions.
        const auto one = clipped(a, b, c), other = clipped(b, a, d);
        // What is left of the edge itself, from either end.
        ClipVertex a1 = a, b1 = b, a2 = a, b2 = b;
        const bool left = clip(a1, b1, {.near_w = kNear});
        ASSERT_EQ(left, clip(b2, a2, {.near_w = kNear}));
        if (!left) continue;
        ASSERT_TRUE(same_bits(a1, a2) && same_bits(b1, b2)) << i;
        for (const ClipVertex& end : {a1, b1}) {
            const auto holds = [&](const std::vector<ClipVertex>& polygon) {
                return std::any_of(polygon.begin(), polygon.end(),
                                   [&](const ClipVertex& v) { return same_bits(v, end); });
            };
            ASSERT_TRUE(holds(one)) << i;
            ASSERT_TRUE(holds(other)) << i;
        }
        cuts += same_bits(a1, a) && same_bits(b1, b) ? 0 : 1;
        if (b.w < kNear) { // the naive way: from whichever end the triangle names first
            const double da = a.w - kNear, db = b.w - kNear;
            const double t = da / (da - db), s = db / (db - da);
            naive_differs += a.x + t * (b.x - a.x) == b.x + s * (a.x - b.x) ? 0 : 1;
        }
    }
    EXPECT_GT(cuts, 50000);
    EXPECT_GT(naive_differs, 50000); // HARD-CASES 9
    RecordProperty("cuts", cuts);
    RecordProperty("naive_differs", naive_differs);
}

TEST(Clip, WhatIsLeftLiesInsideNearAndGuardBand) {
    Random random(2);
    int most = 0;
    for (int i = 0; i < 300000; ++i) {
        ClipVertex v[3];
        for (ClipVertex& corner : v) {
            corner = random_vertex(random, random.bits() % 2 == 0, std::exp2(random.in(0, 40)));
            if (i % 4 == 0) // sizes that have nothing in common
                for (double* c : {&corner.x, &corner.y, &corner.w})
                    *c *= std::exp2(random.in(-60, 60));
        }
        const auto polygon = clipped(v[0], v[1], v[2]);
        most = std::max(most, static_cast<int>(polygon.size()));
        for (const ClipVertex& p : polygon) {
            ASSERT_GE(p.w, kNear) << i;
            if (i % 4 == 0) continue; // rounding may leave the guard band there: snapping saturates
            ASSERT_LE(std::abs(p.x), kGuardPixels * p.w * (1 + 1e-9)) << i;
            ASSERT_LE(std::abs(p.y), kGuardPixels * p.w * (1 + 1e-9)) << i;
        }
    }
    EXPECT_LE(most, 8);
    EXPECT_GE(most, 6);
    RecordProperty("most_vertices", most);
}

TEST(Clip, WhatIsInsideIsLeftAlone) {
    Random random(3);
    for (int i = 0; i < 10000; ++i) {
        const ClipVertex a = random_vertex(random, true, 30000),
                         b = random_vertex(random, true, 30000),
                         c = random_vertex(random, true, 30000);
        const auto polygon = clipped(a, b, c);
        ASSERT_EQ(polygon.size(), 3U);
        EXPECT_TRUE(same_bits(polygon[0], a) && same_bits(polygon[1], b) &&
                    same_bits(polygon[2], c));
    }
    EXPECT_LT(clipped({0, 0, 1, -1}, {1, 0, 1, -2}, {0, 1, 1, 0}).size(), 3U);
}

// Whether a ray through a sample hits the triangle in front of near, in long double: the oracle of
// whole clipped triangles. Shifts the sample to see whether an edge passes close by.
class RayOracle {
    using Real = long double;

public:
    RayOracle(const Vec3& a, const Vec3& b, const Vec3& c, const scene::View& view, int width,
              int height)
        : view_(view), width_(width), height_(height) {
        const Vec3 corner[] = {a, b, c};
        for (int i = 0; i < 3; ++i)
            for (int r = 0; r < 3; ++r)
                p_[i][r] = static_cast<Real>(corner[i][r]) + view.translation[r];
    }
    bool hit(Real pixel_x, Real pixel_y, Real& w) const {
        const Real d[3] = {(2 * pixel_x / width_ - 1) * view_.half_width,
                           (1 - 2 * pixel_y / height_) * view_.half_height, -1};
        Real n[3], volume[3];
        for (int i = 0; i < 3; ++i) {
            const Real *u = p_[(i + 1) % 3], *v = p_[(i + 2) % 3];
            volume[i] = d[0] * (u[1] * v[2] - u[2] * v[1]) + d[1] * (u[2] * v[0] - u[0] * v[2]) +
                        d[2] * (u[0] * v[1] - u[1] * v[0]);
        }
        const bool inside = (volume[0] > 0 && volume[1] > 0 && volume[2] > 0) ||
                            (volume[0] < 0 && volume[1] < 0 && volume[2] < 0);
        if (!inside) return false;
        Real e[2][3];
        for (int i = 0; i < 3; ++i) {
            e[0][i] = p_[1][i] - p_[0][i];
            e[1][i] = p_[2][i] - p_[0][i];
        }
        n[0] = e[0][1] * e[1][2] - e[0][2] * e[1][1];
        n[1] = e[0][2] * e[1][0] - e[0][0] * e[1][2];
        n[2] = e[0][0] * e[1][1] - e[0][1] * e[1][0];
        w = (n[0] * p_[0][0] + n[1] * p_[0][1] + n[2] * p_[0][2]) /
            (n[0] * d[0] + n[1] * d[1] + n[2] * d[2]);
        return w >= view_.near_distance;
    }
    // -1 where an edge passes within 1/64 pixel, or near is that close.
    int covers(int x, int y, Real& w) const {
        Real ignored = 0;
        const bool middle = hit(x + 0.5L, y + 0.5L, w);
        for (const Real dx : {-0.015625L, 0.015625L})
            for (const Real dy : {-0.015625L, 0.015625L})
                if (hit(x + 0.5L + dx, y + 0.5L + dy, ignored) != middle) return -1;
        return middle ? 1 : 0;
    }

private:
    const scene::View& view_;
    int width_, height_;
    Real p_[3][3];
};

scene::View camera(double distance) {
    scene::View view;
    view.translation = {0, 0, -distance};
    view.half_width = 0.6;
    view.half_height = 0.4;
    view.near_distance = 0x1p-12;
    return view;
}

void add(geom::Mesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c) {
    for (const Vec3& p : {a, b, c}) {
        mesh.index.push_back(static_cast<std::uint32_t>(mesh.position.size()));
        mesh.position.push_back(p);
        mesh.normal.emplace_back(0, 0, 1);
    }
    mesh.material.push_back(-1);
}

TEST(Clip, TrianglesThroughTheEyesPlaneCoverWhatRaysHit) {
    constexpr int kWidth = 60, kHeight = 40;
    const scene::View view = camera(0);
    Jobs jobs(1);
    Random random(4);
    VisibilityTile tile;
    Geometry geometry;
    std::int64_t covered = 0, behind = 0, close = 0;
    for (int i = 0; i < 6000; ++i) {
        const double size = std::exp2(random.in(-3, 12));
        geom::Mesh mesh;
        Vec3 v[3];
        for (Vec3& p : v)
            p = Vec3(random.in_cube(size));
        add(mesh, v[0], v[1], v[2]);
        behind += v[0].z > 0 || v[1].z > 0 || v[2].z > 0 ? 1 : 0;
        geometry.run(jobs, mesh, ScreenTransform(view, kWidth, kHeight), {kWidth, kHeight});
        tile.reset(geometry.tile_area(0), 1);
        geometry.draw(0, tile);
        const RayOracle oracle(v[0], v[1], v[2], view, kWidth, kHeight);
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                long double w = 1;
                const int expected = oracle.covers(x, y, w);
                if (expected < 0) {
                    ++close;
                    continue;
                }
                ASSERT_EQ(tile.id(x, y) == 0, expected == 1) << i << ": " << x << ',' << y;
                covered += expected;
            }
        }
    }
    EXPECT_GT(covered, 500000);
    EXPECT_GT(behind, 4000);
    EXPECT_LT(close, 6000 * kWidth * kHeight / 20);
}

TEST(Clip, AFloorUnderTheCameraCoversEveryPixelBelowTheHorizonOnce) {
    // A grid of triangles that cross near, the eye's plane and the guard band, drawn one by one.
    constexpr int kWidth = 64, kHeight = 64;
    scene::View view = camera(0);
    view.half_width = view.half_height = 0.5;
    Jobs jobs(1);
    Random random(5);
    for (const double cell : {0.003, 0.1, 1.0, 300.0}) {
        constexpr int kCells = 16;
        std::vector<Vec3> vertex;
        for (int j = 0; j <= kCells; ++j)
            for (int i = 0; i <= kCells; ++i)
                vertex.emplace_back((i - kCells * 0.5 + random.in(-0.2, 0.2)) * cell, -0.01,
                                    -(j - 4 + random.in(-0.2, 0.2)) * cell);
        std::vector<int> hits(std::size_t{kWidth} * kHeight);
        Geometry geometry;
        VisibilityTile tile;
        for (std::size_t j = 0; j < kCells; ++j) {
            for (std::size_t i = 0; i < kCells; ++i) {
                const std::size_t a = j * (kCells + 1) + i, b = a + 1, c = b + kCells + 1,
                                  d = c - 1;
                for (const auto& [p, q, r] : {std::array{a, b, c}, std::array{c, d, a}}) {
                    geom::Mesh mesh;
                    add(mesh, vertex[p], vertex[q], vertex[r]);
                    geometry.run(jobs, mesh, ScreenTransform(view, kWidth, kHeight),
                                 {kWidth, kHeight});
                    tile.reset(geometry.tile_area(0), 1);
                    geometry.draw(0, tile);
                    for (int y = 0; y < kHeight; ++y)
                        for (int x = 0; x < kWidth; ++x)
                            hits[static_cast<std::size_t>(y) * kWidth +
                                 static_cast<std::size_t>(x)] += tile.id(x, y) == 0 ? 1 : 0;
                }
            }
        }
        int once = 0;
        for (int y = 0; y < kHeight; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                // Where the ray meets the floor, in cells; the rim is jittered.
                const double slope = 0.5 - (y + 0.5) / kHeight, side = (x + 0.5) / kWidth - 0.5;
                const double w = slope < 0 ? -0.01 / slope : 0;
                const bool inside = slope < 0 && w < 11.5 * cell && w > -3.5 * cell &&
                                    std::abs(side * w) < 7.5 * cell && w > 2 * view.near_distance;
                const bool outside = slope > 0 || w > 12.5 * cell || w < -4.5 * cell ||
                                     std::abs(side * w) > 8.5 * cell;
                const int count =
                    hits[static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)];
                ASSERT_TRUE(!inside || count == 1) << cell << ' ' << x << ' ' << y;
                ASSERT_TRUE(!outside || count == 0) << cell << ' ' << x << ' ' << y;
                ASSERT_LE(count, 1);
                once += count;
            }
        }
        EXPECT_GT(once, 100) << cell;
    }
}

TEST(Clip, NoCoordinateIsTooBadToDraw) {
    const float inf = std::numeric_limits<float>::infinity();
    const float bad[] = {0,
                         -0.0F,
                         1,
                         -1,
                         1e30F,
                         -1e30F,
                         std::numeric_limits<float>::max(),
                         inf,
                         -inf,
                         1e-40F,
                         1e-30F,
                         std::numeric_limits<float>::quiet_NaN(),
                         0.5F,
                         3e4F,
                         -7e18F};
    const auto any = [&](Random& random) {
        return random.bits() % 3 == 0 ? static_cast<float>(random.in(-1, 1))
                                      : bad[static_cast<std::size_t>(random.whole(0, 14))];
    };
    Jobs jobs(2);
    Random random(6);
    Geometry geometry;
    VisibilityTile tile;
    std::int64_t drawn = 0;
    for (int i = 0; i < 4000; ++i) {
        geom::Mesh mesh;
        for (int t = 0; t < 20; ++t)
            add(mesh, {any(random), any(random), any(random)},
                {any(random), any(random), any(random)}, {any(random), any(random), any(random)});
        for (std::uint32_t k = 0; k < 20; ++k) {
            mesh.line_index.insert(mesh.line_index.end(), {k, k + 7});
            mesh.point_index.push_back(k);
        }
        scene::View view = camera(i % 2 == 0 ? 0.5 : 1e12);
        if (i % 5 == 0) view = pixel_view(70, 50);
        if (i % 7 == 0) view.linear = DMat3(1e280);
        geometry.run(jobs, mesh, ScreenTransform(view, 70, 50), {70, 50});
        for (int k = 0; k < geometry.tiles(); ++k) {
            tile.reset(geometry.tile_area(k), 4);
            geometry.draw(k, tile);
            for (int y = tile.area().y0; y < tile.area().y1; ++y) {
                for (int x = tile.area().x0; x < tile.area().x1; ++x) {
                    for (int sample = 0; sample < tile.samples(); ++sample) {
                        ASSERT_FALSE(std::isnan(tile.depth(x, y, sample)));
                        const std::uint32_t id = tile.id(x, y, sample);
                        ASSERT_TRUE(id == kNoPrimitive || id < 60);
                        drawn += id != kNoPrimitive ? 1 : 0;
                    }
                }
            }
        }
    }
    EXPECT_GT(drawn, 1000000);
}

} // namespace
} // namespace scanout::raster::test
