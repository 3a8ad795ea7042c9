// Depth, ties and order: what a tile shows does not depend on who came first.
#include "oracle/plane.h"
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
    // Against exact coverage and depth in double-double: where the two nearest are further apart
    // than rounding, the nearer one's id stands.
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
                double best = 0, second = 0;
                std::uint32_t seen = kNoPrimitive;
                for (const Triangle& t : triangles) {
                    if (!ExactTriangle({{{t.x[0], t.y[0]}, {t.x[1], t.y[1]}, {t.x[2], t.y[2]}}})
                             .covers(sx, sy))
                        continue;
                    const Corners v = {{{t.x[0], t.y[0]}, {t.x[1], t.y[1]}, {t.x[2], t.y[2]}}};
                    const double depth = oracle::linear_at(v, t.depth, sx, sy).nearest();
                    if (depth > best) {
                        second = best;
                        best = depth;
                        seen = t.id;
                    } else {
                        second = std::max(second, depth);
                    }
                }
                if (seen != kNoPrimitive && best - second < 1e-6) continue;
                ASSERT_EQ(tile.id(x, y, static_cast<int>(s)), seen) << x << ' ' << y;
                ++checked;
            }
        }
    }
    EXPECT_GT(checked, 16000);
}

scene::View camera_at(double distance) {
    return eye_view(0.5, 0.5, distance);
}

geom::Mesh mesh_soup(Random& random, int triangles, double size) {
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
            const geom::Mesh mesh = mesh_soup(random, 40, size);
            const scene::View view = camera_at(round % 2 == 0 ? 1 : 0.01);
            const Planes first = draw_planes(jobs, mesh, view, 100, 70, 4);
            const Planes culled = draw_planes(jobs, mesh, view, 100, 70, 4, Facing::front);
            for (const auto& p : kPermutation) {
                geom::Mesh turned = mesh;
                for (std::size_t t = 0; t < mesh.index.size(); t += 3)
                    for (std::size_t k = 0; k < 3; ++k)
                        turned.index[t + k] = mesh.index[t + static_cast<std::size_t>(p[k])];
                ASSERT_EQ(first, draw_planes(jobs, turned, view, 100, 70, 4))
                    << size << ' ' << round;
                const bool even = &p < &kPermutation[2];
                const Facing keep = even ? Facing::front : Facing::back;
                ASSERT_EQ(culled, draw_planes(jobs, turned, view, 100, 70, 4, keep)) << size;
            }
        }
    }
}

// Triangles through the eye's plane and across the guard band among them: the pieces of a clipped
// triangle keep its id, whenever they are drawn.
TEST(Visibility, TheOrderOfTheFileOnlyRenumbersWhatIsSeen) {
    Random random(7);
    std::int64_t seen = 0;
    for (const double size : {0.3, 3.0, 1000.0}) {
        for (int round = 0; round < 12; ++round) {
            const geom::Mesh mesh = mesh_soup(random, 120, size);
            const scene::View view = camera_at(round % 2 == 0 ? 1 : 0.01);
            Jobs one(1), three(3);
            const Planes first = draw_planes(one, mesh, view, 90, 60, round % 3 == 0 ? 4 : 1);
            std::vector<std::uint32_t> number(mesh.triangles()); // old number -> new number
            for (std::uint32_t i = 0; i < number.size(); ++i)
                number[i] = i;
            for (std::size_t i = number.size() - 1; i > 0; --i)
                std::swap(number[i],
                          number[static_cast<std::size_t>(random.whole(0, static_cast<int>(i)))]);
            geom::Mesh shuffled = mesh;
            for (std::size_t t = 0; t < number.size(); ++t)
                for (std::size_t k = 0; k < 3; ++k)
                    shuffled.index[3 * std::size_t{number[t]} + k] = mesh.index[3 * t + k];
            const Planes again = draw_planes(three, shuffled, view, 90, 60, round % 3 == 0 ? 4 : 1);
            ASSERT_EQ(first.depths, again.depths) << size << ' ' << round;
            for (std::size_t i = 0; i < first.ids.size(); ++i) {
                if (first.ids[i] != kNoPrimitive) ++seen;
                ASSERT_EQ(again.ids[i],
                          first.ids[i] == kNoPrimitive ? kNoPrimitive : number[first.ids[i]])
                    << size << ' ' << round;
            }
        }
    }
    EXPECT_GT(seen, 50000);
    record("samples_compared", static_cast<double>(seen));
}

TEST(Visibility, CulledFrontAndCulledBackTogetherAreWhatIsDrawnWithoutCulling) {
    Jobs jobs(1);
    Random random(5);
    for (const double size : {0.5, 3.0, 100.0}) {
        const geom::Mesh mesh = mesh_soup(random, 60, size);
        const Planes all = draw_planes(jobs, mesh, camera_at(1), 100, 70);
        const Planes front = draw_planes(jobs, mesh, camera_at(1), 100, 70, 1, Facing::front);
        const Planes back = draw_planes(jobs, mesh, camera_at(1), 100, 70, 1, Facing::back);
        int both = 0;
        for (std::size_t i = 0; i < all.ids.size(); ++i) {
            EXPECT_EQ(all.depths[i], std::max(front.depths[i], back.depths[i]));
            EXPECT_EQ(all.ids[i], front.depths[i] >= back.depths[i] && front.ids[i] != kNoPrimitive
                                      ? front.ids[i]
                                      : back.ids[i]);
            both += front.ids[i] != kNoPrimitive && back.ids[i] != kNoPrimitive ? 1 : 0;
        }
        EXPECT_GT(both, 0);
    }
}

TEST(Visibility, ThreadsAndTilesChangeNoBit) {
    Random random(6);
    geom::Mesh mesh = mesh_soup(random, 20000, 1);
    for (std::size_t i = 0; i < mesh.position.size(); ++i) // smaller triangles, in several chunks
        mesh.position[i] =
            mesh.position[i - i % 3] + (mesh.position[i] - mesh.position[i - i % 3]) * 0.1F;
    std::optional<Planes> first;
    for (const int threads : {1, 2, 3, 7, 16}) {
        Jobs jobs(threads);
        for (const int tile_size : {8, 16, 32, 64}) {
            const Planes now =
                draw_planes(jobs, mesh, camera_at(1), 300, 200, 1, Facing::any, tile_size);
            if (!first) first = now;
            ASSERT_EQ(*first, now) << threads << " threads, tiles of " << tile_size;
        }
    }
}

} // namespace
} // namespace scanout::raster::test
