#include "support/random.h"
#include "trace/bvh.h"

#include <array>
#include <utility>

#include <gtest/gtest.h>

namespace scanout::trace {
namespace {

std::vector<Corners> soup(test::Random& random, int count, double size) {
    std::vector<Corners> triangles;
    for (int i = 0; i < count; ++i) {
        const DVec3 middle = random.in_cube(1);
        triangles.push_back({middle + random.in_cube(size), middle + random.in_cube(size),
                             middle + random.in_cube(size)});
    }
    // Twice the same: the lower number is met.
    triangles.insert(triangles.end(), triangles.begin(), triangles.begin() + count / 4);
    return triangles;
}

Hit by_trying_all(const std::vector<Corners>& triangles, const Ray& ray, const Hit& after) {
    const RayTest test(ray);
    Hit best;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const Hit hit = test.meets(triangles[i], i);
        if (hit.any() && after.before(hit) && hit.before(best)) best = hit;
    }
    return best;
}

// Whatever instruction set Embree takes, however far away a ray begins and however long its way is.
TEST(Bvh, FindsTheHitsThatTryingAllFindsToTheBit) {
    test::Random random(11);
    const std::vector<Corners> triangles = soup(random, 400, 0.3);
    for (const char* isa : {"isa=sse2", "isa=avx2", static_cast<const char*>(nullptr)}) {
        auto bvh = Bvh::create(triangles, isa);
        ASSERT_TRUE(bvh);
        int hits = 0;
        for (int i = 0; i < 2000; ++i) {
            const double far = i % 3 == 0 ? 1 : (i % 3 == 1 ? 100 : 1e9);
            Ray ray{random.in_cube(1) * far, {}};
            // At a corner, where a ray of single precision may pass by the triangle's box.
            const auto corner = static_cast<std::size_t>(random.whole(0, 2));
            const DVec3 at =
                i % 4 == 0 ? random.in_cube(0.7)
                           : triangles[static_cast<std::size_t>(random.whole(0, 399))][corner];
            ray.way = (at - ray.from) * (i % 2 == 0 ? 1.0 : 1e-6);
            // All of them in turn, front to back.
            for (Hit hit{0, kNothing, {}};;) {
                const Hit expected = by_trying_all(triangles, ray, hit);
                const Hit found = bvh->next(ray, hit);
                ASSERT_EQ(found.triangle, expected.triangle) << i;
                ASSERT_EQ(found.t, expected.t) << i;
                ASSERT_EQ(found.weight, expected.weight) << i;
                if (!found.any()) break;
                ++hits;
                hit = found;
            }
        }
        EXPECT_GT(hits, 5000);
    }
}

TEST(Bvh, IsBlockedWhereSomethingThatCountsStandsBetween) {
    test::Random random(12);
    const std::vector<Corners> triangles = soup(random, 200, 0.3);
    auto bvh = Bvh::create(triangles);
    ASSERT_TRUE(bvh);
    std::vector<std::uint8_t> counts(triangles.size());
    for (std::size_t i = 0; i < counts.size(); ++i)
        counts[i] = i % 3 == 0 ? 0 : 1;
    int blocked = 0;
    for (int i = 0; i < 4000; ++i) {
        Ray ray{random.in_cube(1), random.in_cube(1)};
        const double least = random.in(0, 0.2), most = random.in(0.2, 2);
        const auto except = static_cast<std::uint32_t>(random.whole(0, 199));
        for (const auto& list : {counts, std::vector<std::uint8_t>()}) {
            const RayTest test(ray);
            bool expected = false;
            for (std::uint32_t k = 0; k < triangles.size(); ++k) {
                const Hit hit = test.meets(triangles[k], k);
                expected = expected || (hit.t > least && hit.t < most && k != except &&
                                        (list.empty() || list[k] != 0));
            }
            ASSERT_EQ(bvh->blocked(ray, least, most, except, list), expected) << i;
            blocked += expected ? 1 : 0;
        }
    }
    EXPECT_GT(blocked, 1000);
    EXPECT_LT(blocked, 7000);
}

// No ray passes between two triangles that share an edge, nor beside a vertex that all share.
TEST(RayTest, IsWatertight) {
    test::Random random(13);
    for (int fan = 0; fan < 200; ++fan) {
        const DVec3 middle = random.in_cube(0.1);
        std::vector<DVec3> rim;
        for (int k = 0; k < 6; ++k)
            rim.push_back(DVec3(std::array{1.0, 0.5, -0.5, -1.0, -0.5, 0.5}[k],
                                std::array{0.0, 0.9, 0.9, 0.0, -0.9, -0.9}[k], 0) +
                          random.in_cube(0.05));
        for (int i = 0; i < 100; ++i) {
            // At an edge, a vertex, or close to one.
            const DVec3& end = rim[static_cast<std::size_t>(i % 6)];
            const double along = i % 4 == 0 ? 0 : random.in(0, 0.8);
            const DVec3 at = middle + (end - middle) * along;
            Ray ray{random.in_cube(1) + DVec3(0, 0, 5), {}};
            ray.way = at - ray.from;
            const RayTest test(ray);
            bool met = false;
            for (std::uint32_t k = 0; k < 6; ++k)
                met = met || test.meets({middle, rim[k], rim[(k + 1) % 6]}, k).any();
            ASSERT_TRUE(met) << fan << " " << i;
        }
    }
}

// Exactly on an edge or a vertex both triangles, or all, are met, whichever corner comes first.
TEST(RayTest, MeetsATriangleOnItsEdges) {
    const std::array<DVec3, 3> corner = {DVec3(0, 0, 0), DVec3(8, 0, 1), DVec3(2, 6, 2)};
    for (std::size_t first = 0; first < 3; ++first)
        for (const bool turned : {false, true}) {
            Corners c = {corner[first], corner[(first + 1) % 3], corner[(first + 2) % 3]};
            if (turned) std::swap(c[1], c[2]);
            const auto met = [&](double x, double y) {
                return RayTest({{x, y, 9}, {0, 0, -1}}).meets(c, 0).any();
            };
            for (const DVec2 at : {DVec2(0, 0), {8, 0}, {2, 6}, {4, 0}, {5, 3}, {1, 3}, {3, 2}})
                EXPECT_TRUE(met(at.x, at.y)) << first << " " << at.x << " " << at.y;
            for (const DVec2 at : {DVec2(4, -0.001), {5.001, 3}, {0.999, 3}, {9, 0}})
                EXPECT_FALSE(met(at.x, at.y)) << first << " " << at.x << " " << at.y;
        }
}

TEST(Bvh, HasNothingToMeetWithoutTriangles) {
    auto bvh = Bvh::create({});
    ASSERT_TRUE(bvh);
    EXPECT_FALSE(bvh->next({}, {0, kNothing, {}}).any());
}

} // namespace
} // namespace scanout::trace
