#include "geom/point_tree.h"
#include "math/predicates.h"

#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::geom {
namespace {

RC_GTEST_PROP(PointTree, VisitsEveryPointOfATriangle, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    double flat = random() % 3 == 0 ? 0 : 1; // points on a line, too
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto point = [&](double size) {
        return DVec2(size * uniform(random), size * flat * uniform(random));
    };
    std::vector<DVec2> points(*rc::gen::inRange<std::size_t>(0, 2000));
    std::vector<std::uint32_t> members;
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = point(1);
        if (random() % 2 == 0) members.push_back(static_cast<std::uint32_t>(i));
    }
    flat = 1; // triangles have area
    PointTree tree(points, members);
    std::set<std::uint32_t> forgotten;
    for (int repeat = 0; repeat < 5; ++repeat) {
        const double size = repeat < 3 ? 1 : 3;
        DVec2 a = point(size), b = point(size), c = point(size);
        if (repeat % 2 == 0) c = a + (b - a) * 0.5 + point(0.01); // thin
        if (orient2d(a, b, c) < 0) std::swap(b, c);
        std::set<std::uint32_t> visited;
        std::uint64_t work = 0;
        RC_ASSERT(tree.visit(a, b, c, work, [&](std::uint32_t i) {
            RC_ASSERT(visited.insert(i).second && !forgotten.contains(i));
            if (random() % 4 != 0) return PointTree::Visit::go_on;
            forgotten.insert(i);
            return PointTree::Visit::forget;
        }));
        RC_ASSERT(work >= visited.size());
        for (const std::uint32_t i : members) {
            const DVec2& p = points[i];
            const bool within =
                orient2d(a, b, p) >= 0 && orient2d(b, c, p) >= 0 && orient2d(c, a, p) >= 0;
            RC_ASSERT(!within || visited.contains(i) || forgotten.contains(i));
        }
    }
}

std::vector<std::uint32_t> all_of(const std::vector<DVec2>& points) {
    std::vector<std::uint32_t> members(points.size());
    std::iota(members.begin(), members.end(), 0u);
    return members;
}

std::uint64_t work_of(PointTree& tree, const DVec2& a, const DVec2& b, const DVec2& c) {
    std::uint64_t work = 0;
    EXPECT_TRUE(tree.visit(a, b, c, work, [](std::uint32_t) { return PointTree::Visit::go_on; }));
    return work;
}

TEST(PointTree, LooksAtAFewPointsOfAGridForAThinTriangle) {
    std::vector<DVec2> points;
    for (std::uint32_t i = 0; i < 90'000; ++i)
        points.emplace_back(i % 300, i / 300);
    PointTree tree(points, all_of(points));
    const std::uint64_t work = work_of(tree, {0, 0}, {299, 298}, {298, 299});
    EXPECT_LT(work, 8'000u);
    EXPECT_GE(work, 300u);
}

// Slivers between the two rows of a comb's feet: boxes of four points along the axes would reach
// from one row to the other.
TEST(PointTree, LooksAtAFewPointsForASliverBetweenTwoRows) {
    for (const DVec2 row : {DVec2(1, 0), DVec2(0, 1), DVec2(4, 3), DVec2(-5, 12)}) {
        std::vector<DVec2> points;
        const DVec2 up(-row.y, row.x);
        for (int i = 0; i < 20'000; ++i)
            for (const double height : {0., 1.})
                points.push_back(row * static_cast<double>(i) + up * height);
        PointTree tree(points, all_of(points));
        const DVec2 far = row * 19'999.0 + up * 0.9;
        EXPECT_LT(work_of(tree, up * 0.1, row + up * 0.1, far), 300u) << row.x << ' ' << row.y;
        EXPECT_LT(work_of(tree, row * 1e4, row * 10'001.0, far), 300u) << row.x << ' ' << row.y;
    }
}

TEST(PointTree, StopsWhenTold) {
    const std::vector<DVec2> points{{0, 0}, {1, 0}, {0, 1}};
    PointTree tree(points, std::vector<std::uint32_t>{0, 1, 2});
    std::uint64_t work = 0;
    int visits = 0;
    EXPECT_FALSE(tree.visit(points[0], points[1], points[2], work, [&](std::uint32_t) {
        return ++visits == 2 ? PointTree::Visit::stop : PointTree::Visit::go_on;
    }));
    EXPECT_EQ(visits, 2);
}

} // namespace
} // namespace scanout::geom
