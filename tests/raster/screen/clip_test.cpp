// What clip() makes of triangles and edges: HARD-CASES 6, 9, 11, 13, P6.
#include "raster/exactly_once.h"
#include "raster/screen/clip.h"
#include "support/targets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace scanout::raster::test {
namespace {

constexpr double kNear = 0x1p-10;

// A segment, by the near plane alone.
bool clip_near(ClipVertex& a, ClipVertex& b, double near_w) {
    return clip(a, b, ClipBox{near_w, -1e300, 1e300, -1e300, 1e300});
}

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
    const NearPolygon polygon = cut_near({a, b, c}, kNear);
    return {polygon.vertex.begin(), polygon.vertex.begin() + polygon.count};
}

// HARD-CASES 9, T7: a million edges, compared bit by bit. (The naive way: tests/naive.)
TEST(Clip, ASharedEdgeIsCutAtTheSameBitsFromBothSides) {
    Random random(1);
    int cuts = 0;
    for (int i = 0; i < 1000000; ++i) {
        const double pixels = i % 3 == 0 ? 1e6 : 500; // across the guard band, or only near
        const ClipVertex a = random_vertex(random, true, pixels),
                         b = random_vertex(random, i % 2 == 0, pixels);
        const ClipVertex c = random_vertex(random, random.bits() % 2 == 0, pixels),
                         d = random_vertex(random, random.bits() % 2 == 0, pixels);
        // Neighbours name the edge in opposite directions.
        const auto one = clipped(a, b, c), other = clipped(b, a, d);
        // What is left of the edge itself, from either end.
        ClipVertex a1 = a, b1 = b, a2 = a, b2 = b;
        const bool left = clip_near(a1, b1, kNear);
        ASSERT_EQ(left, clip_near(b2, a2, kNear));
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
    }
    EXPECT_GT(cuts, 250000);
    record("edges_cut", cuts);
    record("edges_that_differ", 0);
}

// HARD-CASES 11: one plane adds one vertex at most, whatever the sizes.
TEST(Clip, WhatIsLeftLiesBeforeTheNearPlane) {
    Random random(2);
    int of_each[5] = {};
    for (int i = 0; i < 300000; ++i) {
        std::array<ClipVertex, 3> v;
        for (ClipVertex& corner : v) {
            corner = random_vertex(random, random.bits() % 2 == 0, std::exp2(random.in(0, 40)));
            if (i % 4 == 0) // sizes that have nothing in common
                for (double* c : {&corner.x, &corner.y, &corner.w})
                    *c *= std::exp2(random.in(-60, 60));
        }
        const NearPolygon polygon = cut_near(v, kNear);
        ASSERT_TRUE(polygon.count == 0 || polygon.count == 3 || polygon.count == 4) << i;
        ++of_each[polygon.count];
        for (std::size_t k = 0; k < static_cast<std::size_t>(polygon.count); ++k) {
            const ClipVertex& p = polygon.vertex[k];
            ASSERT_GE(p.w, kNear) << i;
            const EdgePoint& at = polygon.edge_point[k];
            ASSERT_TRUE(at.cut() ? p.w == kNear : same_bits(p, v[at.from])) << i;
            if (!at.cut()) continue;
            ASSERT_TRUE(at.t >= 0 && at.t <= 1) << i;
            ASSERT_GE(v[at.from].w, kNear) << i; // from the inside, whichever way round it goes
            ASSERT_LT(v[at.to].w, kNear) << i;
        }
    }
    EXPECT_GT(of_each[3], 10000);
    EXPECT_GT(of_each[4], 10000);
}

// Segments: near and the guard band's four sides.
TEST(Clip, WhatIsLeftOfASegmentLiesInsideNearAndGuardBand) {
    Random random(7);
    int left = 0;
    for (int i = 0; i < 300000; ++i) {
        const auto any = [&] {
            return random_vertex(random, random.bits() % 2 == 0, std::exp2(random.in(0, 24)));
        };
        ClipVertex ends[] = {any(), any()};
        if (!clip(ends[0], ends[1], ClipBox{.near_w = kNear})) continue;
        ++left;
        for (const ClipVertex& p : ends) {
            ASSERT_GE(p.w, kNear) << i;
            ASSERT_LE(std::abs(p.x), kGuardPixels * p.w * (1 + 1e-9)) << i;
            ASSERT_LE(std::abs(p.y), kGuardPixels * p.w * (1 + 1e-9)) << i;
        }
    }
    EXPECT_GT(left, 100000);
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

// A mesh in perspective around a tile, and which side of a plane its vertices are on. The plane's
// distances and 1 - distance are exact in double, so that both halves start from the same numbers.
struct CutMesh {
    SnappedMesh mesh;
    std::vector<ClipVertex> vertex; // w here: the true w; pixels times w
    std::vector<double> distance;   // multiples of 2^-30 below 2^10

    explicit CutMesh(Random& random) {
        mesh = grid(3, [&](int i, int j) {
            return Corner{(i * 32 - 8) * 256 + random.whole(-2000, 2000),
                          (j * 32 - 8) * 256 + random.whole(-2000, 2000)};
        });
        // The rim stays outside the picture.
        const double angle = random.in(0, 6.3);
        const double a = std::cos(angle), b = std::sin(angle),
                     c = -(a + b) * 32 + random.in(-30, 30);
        for (const Corner& v : mesh.vertex) {
            const double w = std::exp2(random.in(-3, 3)), x = v.x / 256.0, y = v.y / 256.0;
            vertex.push_back({x * w, y * w, 0, w});
            // A plane in clip space, not only a line on the screen.
            const double d = (a * x + b * y + c) * w * random.in(0.9, 1.1);
            distance.push_back(std::nearbyint(d * 0x1p30) * 0x1p-30);
        }
    }
};

// One side of a triangle: the near plane stands for the plane, z carries w through the clipper.
// Vertices are snapped, cuts are not; sign +1 or -1 picks the half.
ClippedTriangles half_of(const CutMesh& cut, const std::array<std::size_t, 3>& triangle, int sign,
                         double depth) {
    constexpr double kPlane = 0x1p20; // any number
    std::array<ClipVertex, 3> v{};
    for (std::size_t i = 0; i < 3; ++i) {
        const ClipVertex& p = cut.vertex[triangle[i]];
        v[i] = {p.x, p.y, p.w, kPlane + sign * cut.distance[triangle[i]]};
    }
    const NearPolygon polygon = cut_near(v, kPlane);
    std::vector<ExactPoint> point;
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
        const ClipVertex& p = polygon.vertex[i];
        if (polygon.edge_point[i].cut()) {
            point.push_back(point_off_screen({p.x, p.y, depth * p.z, p.z}));
        } else {
            const Corner& at = cut.mesh.vertex[triangle[polygon.edge_point[i].from]];
            point.push_back(point_on_screen({at.x, at.y, depth}));
        }
    }
    if (point.empty()) return {};
    return split_polygon(point, 0);
}

// HARD-CASES 13, P6: plane d and -d over 10^4 random planes. Both halves of every triangle of a
// mesh, drawn together, cover every sample once: along the cut and along the mesh's edges, where
// vertices of one triangle must meet those of its neighbour (HARD-CASES 12).
TEST(Clip, TheTwoSidesOfAPlaneCoverEverySampleOnce) {
    Random random(8);
    Hits hits;
    std::int64_t clipped = 0;
    for (int i = 0; i < 10000; ++i) {
        const CutMesh cut(random);
        VisibilityTile tile[2];
        const std::size_t count = cut.mesh.triangle.size() * 2;
        for (const bool falling : {false, true}) {
            VisibilityTile& to = tile[falling ? 1 : 0];
            to.reset({8, 8, 56, 56}, 1);
            for (std::size_t t = 0; t < count; ++t) {
                for (ClippedTriangle half :
                     half_of(cut, cut.mesh.triangle[t / 2], t % 2 == 0 ? 1 : -1,
                             rising_depth(t, count, falling))) {
                    half.id = static_cast<std::uint32_t>(t);
                    to.draw_clipped(half);
                    ++clipped;
                }
            }
        }
        count_hits(tile[0], tile[1], hits);
        ASSERT_EQ(hits.none, 0) << i;
        ASSERT_EQ(hits.more, 0) << i;
    }
    EXPECT_GT(clipped, 10000 * 2 * 20);
    record("samples_covered_once", static_cast<double>(hits.once));
    record("clipped", static_cast<double>(clipped) / 2);
}

// Numbers of every kind that a broken file may hold.
float any_number(Random& random) {
    constexpr float inf = std::numeric_limits<float>::infinity();
    constexpr float bad[] = {0,
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
    return random.bits() % 3 == 0 ? static_cast<float>(random.in(-1, 1))
                                  : bad[static_cast<std::size_t>(random.whole(0, 14))];
}
std::array<Vec3, 3> any_triangle(Random& random) {
    std::array<Vec3, 3> v;
    for (Vec3& p : v)
        p = {any_number(random), any_number(random), any_number(random)};
    return v;
}

// HARD-CASES 6: a million triangles; depth stays a number in [0, 1], ids stay those of the mesh.
TEST(Clip, NoCoordinateIsTooBadToDraw) {
    constexpr int kWidth = 24, kHeight = 18;
    Jobs jobs(2);
    Random random(6);
    std::int64_t drawn = 0;
    for (int i = 0; i < 10000; ++i) {
        geom::Mesh mesh;
        for (int t = 0; t < 100; ++t)
            add_triangle(mesh, any_triangle(random));
        for (std::uint32_t k = 0; k < 100; ++k) {
            mesh.line_index.insert(mesh.line_index.end(), {k, k + 7});
            mesh.point_index.push_back(k);
        }
        scene::View view = eye_view(0.6, 0.4, i % 2 == 0 ? 0.5 : 1e12);
        if (i % 5 == 0) view = pixel_view(kWidth, kHeight);
        if (i % 7 == 0) view.linear = DMat3(1e280);
        const Planes planes = draw_planes(jobs, mesh, view, kWidth, kHeight, 4);
        for (std::size_t k = 0; k < planes.ids.size(); ++k) {
            ASSERT_FALSE(std::isnan(planes.depths[k]));
            ASSERT_TRUE(planes.ids[k] == kNoPrimitive || planes.ids[k] < 300);
            drawn += planes.ids[k] != kNoPrimitive ? 1 : 0;
        }
    }
    EXPECT_GT(drawn, 5000000);
    record("triangles", 1e6);
    record("samples_drawn", static_cast<double>(drawn));
}

// HARD-CASES 6: vertices that are not finite take their own triangles away, no others.
TEST(Clip, TrianglesThatAreNotFiniteLeaveTheOthersAlone) {
    Jobs jobs(1);
    Random random(9);
    constexpr float inf = std::numeric_limits<float>::infinity(),
                    nan = std::numeric_limits<float>::quiet_NaN();
    std::int64_t drawn = 0;
    for (int i = 0; i < 3000; ++i) {
        geom::Mesh good, mixed;
        std::vector<std::uint32_t> number; // of the good triangles among all
        for (int t = 0; t < 12; ++t) {
            std::array<Vec3, 3> v;
            for (Vec3& p : v)
                p = Vec3(random.in_cube(i % 2 == 0 ? 1 : 30));
            if (t % 2 == 0) {
                add_triangle(good, v);
                number.push_back(static_cast<std::uint32_t>(t));
            } else {
                const float bad[] = {inf, -inf, nan};
                v[static_cast<std::size_t>(random.whole(0, 2))][random.whole(0, 2)] =
                    bad[random.whole(0, 2)];
            }
            add_triangle(mixed, v);
        }
        const scene::View view = eye_view(0.6, 0.4, 1);
        const Planes a = draw_planes(jobs, good, view, 40, 30),
                     b = draw_planes(jobs, mixed, view, 40, 30);
        ASSERT_EQ(a.depths, b.depths) << i;
        for (std::size_t k = 0; k < a.ids.size(); ++k) {
            const bool empty = a.ids[k] == kNoPrimitive;
            ASSERT_EQ(b.ids[k], empty ? kNoPrimitive : number[a.ids[k]]) << i;
            drawn += empty ? 0 : 1;
        }
    }
    EXPECT_GT(drawn, 300000);
}

// HARD-CASES 67, 68, R2: to the grid, saturating, nearest with ties to even.
TEST(Snap, IsDefinedForEveryNumber) {
    const ScreenTransform transform(pixel_view(64, 64), 64, 64);
    constexpr double inf = std::numeric_limits<double>::infinity(),
                     nan = std::numeric_limits<double>::quiet_NaN();
    constexpr std::int32_t kMax = 32767 * 256;
    const std::pair<double, std::int32_t> table[] = {{0, 0},
                                                     {-0.0, 0},
                                                     {1, 256},
                                                     {-1, -256},
                                                     {1 / 512.0, 0},
                                                     {3 / 512.0, 2},
                                                     {5 / 512.0, 2},
                                                     {-1 / 512.0, 0},
                                                     {-3 / 512.0, -2},
                                                     {std::nextafter(1 / 512.0, 1), 1},
                                                     {std::nextafter(1 / 512.0, 0), 0},
                                                     {32767, kMax},
                                                     {32767.001, kMax},
                                                     {-32768, -kMax},
                                                     {2147483648.0, kMax},
                                                     {-2147483649.0, -kMax},
                                                     {1e30, kMax},
                                                     {-1e300, -kMax},
                                                     {inf, kMax},
                                                     {-inf, -kMax}};
    for (const auto& [pixels, expected] : table) {
        EXPECT_EQ(transform.to_screen({pixels, 0, 0.5, 1}).x, expected) << pixels;
        EXPECT_EQ(transform.to_screen({0, pixels, 0.5, 1}).y, expected) << pixels;
    }
    const ScreenVertex none = transform.to_screen({nan, -nan, 0.5, 1});
    EXPECT_LE(std::abs(none.x), kMax);
    EXPECT_LE(std::abs(none.y), kMax);
}

// Rows 67 and 68 where frames snap: in lanes, on every target. What is not finite has no place.
TEST(Snap, InLanesIsToTheNearestWithTiesToEvenOnEveryTarget) {
    const ScreenTransform transform(pixel_view(64, 64), 64, 64);
    std::vector<Vec3> position;
    for (int k = -64 * 512; k <= 2 * 64 * 512; k += 7)
        position.emplace_back(static_cast<float>(k) / 512, static_cast<float>(-k) / 512, 0.5F);
    const std::size_t ties = position.size();
    Random random(11);
    const float inf = std::numeric_limits<float>::infinity();
    const float odd[] = {inf, -inf, NAN, 0.0F, -0.0F, 1e30F, -3e38F, 1e-40F, 32767, -32768, 32800};
    for (int i = 0; i < 5000; ++i) {
        Vec3 p(random.in_cube(std::exp2(random.in(-20, 20))));
        if (i % 3 == 0) p[random.whole(0, 2)] = odd[random.whole(0, 10)];
        position.push_back(p);
    }
    const ScreenTransform views[] = {transform, ScreenTransform(eye_view(0.6, 0.4, 0.01), 64, 48)};
    scanout::test::on_every_target([&](const std::string&) {
        for (const ScreenTransform& view : views) {
            std::vector<ScreenVertex> got(position.size());
            transform_vertices(view, position, got);
            int on_screen = 0;
            for (std::size_t i = 0; i < got.size(); ++i) {
                const ScreenVertex expected = view.transform(position[i]);
                ASSERT_EQ(got[i].x, expected.x) << i;
                ASSERT_EQ(got[i].y, expected.y) << i;
                ASSERT_EQ(std::bit_cast<std::uint64_t>(got[i].depth),
                          std::bit_cast<std::uint64_t>(expected.depth))
                    << i;
                on_screen += got[i].on_screen() ? 1 : 0;
            }
            EXPECT_GT(on_screen, 1000);
        }
        std::vector<ScreenVertex> got(ties);
        transform_vertices(transform, std::span(position).first(ties), got);
        int halves = 0;
        for (std::size_t i = 0; i < ties; ++i) {
            const int k = static_cast<int>(i) * 7 - 64 * 512; // x is k / 2 steps of the grid
            const int down = k >= 0 ? k / 2 : -((1 - k) / 2);
            const int even = down % 2 == 0 ? down : down + 1;
            ASSERT_EQ(got[i].x, k % 2 == 0 ? k / 2 : even) << k;
            const int y = 64 * 512 + k; // counted from the top, it is never below 0
            ASSERT_EQ(got[i].y, y % 2 == 0 ? y / 2 : (y / 2) % 2 == 0 ? y / 2 : y / 2 + 1) << k;
            halves += k % 2 == 0 ? 0 : 1;
        }
        EXPECT_GT(halves, 1000);
    });
}

// Lanes find places on the screen without a quotient of their own, but for those next to the middle
// between two: there one that is off by its last bit would snap to the other side. Here x / w is
// such a middle, or next to it, for every w, whatever 1 / w is rounded to.
TEST(Snap, InLanesIsThatOfTheQuotientNextToTheMiddleOfAStep) {
    scene::View view = eye_view(0, 0, 0.01);
    view.linear = DMat3(1); // what is ahead lies at -z
    view.translation = DVec3(0);
    view.half_width = view.half_height = 1; // of 64 pixels: x is 32 (p.x + w), all of it exact
    const ScreenTransform transform(view, 64, 64);
    ASSERT_TRUE(transform.perspective);
    std::vector<Vec3> position;
    Random random(12);
    int middles = 0;
    for (int i = 0; i < 200000; ++i) {
        const float w = static_cast<float>(random.whole(3, 4095)) / 1024;
        const int half_steps =
            random.whole(0, 64 * 256 - 1) * 2 + 1; // from the left, in 1/512 pixel
        const double x = w * (half_steps / 512.0 - 32) / 32;
        position.emplace_back(static_cast<float>(x), static_cast<float>(-x), -w);
        const ClipVertex clip = transform.to_clip(position.back());
        middles += std::abs(clip.x / clip.w * 512 - half_steps) < 1e-9 ? 1 : 0;
    }
    EXPECT_GT(middles, 20000);
    scanout::test::on_every_target([&](const std::string&) {
        std::vector<ScreenVertex> got(position.size());
        transform_vertices(transform, position, got);
        int differ = 0;
        for (std::size_t i = 0; i < got.size(); ++i) {
            const ScreenVertex expected = transform.transform(position[i]);
            differ +=
                got[i].x != expected.x || got[i].y != expected.y || got[i].depth != expected.depth
                    ? 1
                    : 0;
        }
        EXPECT_EQ(differ, 0);
    });
}

} // namespace
} // namespace scanout::raster::test
