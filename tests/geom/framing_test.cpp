#include "geom/framing.h"
#include "geom/meshes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::geom {
namespace {

using testing::jobs;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMax = std::numeric_limits<double>::max();
constexpr double kDenormal = std::numeric_limits<double>::denorm_min();

std::vector<DVec3> cloud(std::uint32_t seed, std::size_t count) {
    std::mt19937 random(seed);
    std::vector<DVec3> points(count);
    for (DVec3& p : points)
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = static_cast<int>(random() % 4001) - 2000;
    return points;
}

Framing framing_of_all(const std::vector<DVec3>& points) {
    return framing_of(jobs(), points, std::vector<std::uint8_t>(points.size(), 1));
}

// What every framing must keep: normalised positions are finite, none is further than the radius,
// one is as far, and the radius is of unit size.
void expect_sound(const std::vector<DVec3>& points) {
    const Framing f = framing_of_all(points);
    double largest = 0;
    for (const DVec3& p : points) {
        const DVec3 q = f.normalise(p);
        ASSERT_TRUE(is_finite(q));
        largest = std::max(largest, std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z));
    }
    EXPECT_GE(f.radius, 0.5);
    EXPECT_LE(f.radius, 1.0);
    EXPECT_NEAR(f.radius, largest, 1e-15);
}

RC_GTEST_PROP(Framing, TheOrderOfVerticesDoesNotMoveIt, (std::uint32_t seed)) {
    std::vector<DVec3> points = cloud(seed, 20);
    const Framing f = framing_of_all(points);
    std::shuffle(points.begin(), points.end(), std::mt19937(seed));
    const Framing g = framing_of_all(points);
    RC_ASSERT(f.centre == g.centre && f.exponent == g.exponent && f.radius == g.radius);
}

RC_GTEST_PROP(Framing, AnExactTranslationChangesTheCentreAlone, (std::uint32_t seed)) {
    const std::vector<DVec3> points = cloud(seed, 20);
    const Framing f = framing_of_all(points);
    const DVec3 shift(4.6e6, -5e5 - seed % 1000, 1 << 20);
    std::vector<DVec3> moved = points;
    for (DVec3& p : moved)
        p += shift;
    const Framing g = framing_of_all(moved);
    RC_ASSERT(g.centre == f.centre + shift && g.exponent == f.exponent && g.radius == f.radius);
    for (std::size_t i = 0; i < points.size(); ++i)
        RC_ASSERT(f.normalise(points[i]) == g.normalise(moved[i]));
}

RC_GTEST_PROP(Framing, APowerOfTwoChangesTheExponentAlone, (std::uint32_t seed)) {
    const std::vector<DVec3> points = cloud(seed, 20);
    const Framing f = framing_of_all(points);
    const int k = *rc::gen::inRange(-1030, 1010);
    std::vector<DVec3> scaled = points;
    for (DVec3& p : scaled)
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = std::ldexp(p[axis], k);
    const Framing g = framing_of_all(scaled);
    RC_ASSERT(g.exponent == f.exponent + k && g.radius == f.radius);
    for (std::size_t i = 0; i < points.size(); ++i)
        RC_ASSERT(f.normalise(points[i]) == g.normalise(scaled[i]));
}

RC_GTEST_PROP(Framing, AnyFinitePointsAreOfUnitSize, (std::uint32_t seed)) {
    std::mt19937_64 random(seed);
    std::vector<DVec3> points(1 + random() % 5, DVec3(0));
    const bool one_scale = random() % 2 == 0;
    const int scale = static_cast<int>(random() % 2090) - 1070;
    for (DVec3& p : points)
        for (int axis = 0; axis < 3; ++axis) {
            const int e = one_scale ? scale : static_cast<int>(random() % 2090) - 1070;
            p[axis] = std::ldexp(static_cast<double>(random() % 1025) - 512, e - 10);
        }
    if (std::all_of(points.begin(), points.end(), [&](const DVec3& p) { return p == points[0]; }))
        return;
    expect_sound(points);
    RC_ASSERT(!::testing::Test::HasFailure());
}

TEST(Framing, HoldsFromTheSmallestToTheLargestDoubles) {
    expect_sound({DVec3(0), DVec3(kDenormal, 0, 0)});
    expect_sound({DVec3(-kDenormal, 0, 0), DVec3(kDenormal, 2 * kDenormal, 0)});
    expect_sound({DVec3(kDenormal), DVec3(3 * kDenormal)});
    expect_sound({DVec3(-kMax), DVec3(kMax)});
    expect_sound({DVec3(kMax, 0, 0), DVec3(kMax / 2, 0, 0)});
    expect_sound({DVec3(-kMax, kDenormal, 0), DVec3(kMax, 0, 1)});
}

TEST(Framing, OnlyUsedVerticesCount) {
    const std::vector<DVec3> points{{0, 0, 0}, {1e9, 0, 0}, {2, 0, 0}, {kInfinity, NAN, 0}};
    const Framing f = framing_of(jobs(), points, {1, 0, 1, 0});
    EXPECT_EQ(f.centre, DVec3(1, 0, 0));
    EXPECT_EQ(f.box_max, DVec3(2, 0, 0));
    EXPECT_EQ(f.radius, 0.5);
    EXPECT_EQ(f.exponent, 1);
}

TEST(Framing, WithoutUsedVerticesAllFiniteOnesCount) {
    const std::vector<DVec3> points{{0, 0, 0}, {NAN, 0, 0}, {2, 4, 6}, {0, -kInfinity, 0}};
    const Framing f = framing_of(jobs(), points, std::vector<std::uint8_t>(4, 0));
    EXPECT_EQ(f.box_min, DVec3(0));
    EXPECT_EQ(f.box_max, DVec3(2, 4, 6));
}

TEST(Framing, NothingAndASinglePointHaveADefaultSize) {
    EXPECT_EQ(framing_of(jobs(), {}, {}).radius, 0.5);
    EXPECT_EQ(framing_of(jobs(), {DVec3(NAN)}, {0}).radius, 0.5);
    const Framing f = framing_of(jobs(), {DVec3(7, 8, 9), DVec3(7, 8, 9)}, {1, 1});
    EXPECT_EQ(f.centre, DVec3(7, 8, 9));
    EXPECT_EQ(f.radius, 0.5);
    EXPECT_EQ(f.exponent, 0);
    EXPECT_EQ(f.normalise(DVec3(7, 8, 9)), DVec3(0));
    EXPECT_EQ(framing_of(jobs(), {DVec3(kDenormal)}, {1}).centre, DVec3(kDenormal));
}

} // namespace
} // namespace scanout::geom
