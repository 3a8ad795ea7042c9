#include "geom/point_grid.h"
#include "math/predicates.h"

#include <random>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::geom {
namespace {

RC_GTEST_PROP(PointGrid, VisitsEveryPointOfATriangle, (std::uint32_t seed)) {
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
    PointGrid grid(points, members);
    std::set<std::uint32_t> forgotten;
    for (int repeat = 0; repeat < 5; ++repeat) {
        const double size = repeat < 3 ? 1 : 3;
        DVec2 a = point(size), b = point(size), c = point(size);
        if (repeat % 2 == 0) c = a + (b - a) * 0.5 + point(0.01); // thin
        if (orient2d(a, b, c) < 0) std::swap(b, c);
        std::set<std::uint32_t> visited;
        std::uint64_t work = 0;
        RC_ASSERT(grid.visit(a, b, c, work, [&](std::uint32_t i) {
            RC_ASSERT(visited.insert(i).second && !forgotten.contains(i));
            if (random() % 4 != 0) return PointGrid::Visit::go_on;
            forgotten.insert(i);
            return PointGrid::Visit::forget;
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

TEST(PointGrid, LooksAtAFewCellsForAThinTriangle) {
    std::vector<DVec2> points;
    std::vector<std::uint32_t> members;
    for (std::uint32_t i = 0; i < 90'000; ++i) {
        points.emplace_back(i % 300, i / 300);
        members.push_back(i);
    }
    PointGrid grid(points, members);
    std::uint64_t work = 0;
    EXPECT_TRUE(grid.visit({0, 0}, {299, 298}, {298, 299}, work,
                           [](std::uint32_t) { return PointGrid::Visit::go_on; }));
    EXPECT_LT(work, 8'000u);
    EXPECT_GE(work, 300u);
}

TEST(PointGrid, StopsWhenTold) {
    const std::vector<DVec2> points{{0, 0}, {1, 0}, {0, 1}};
    PointGrid grid(points, std::vector<std::uint32_t>{0, 1, 2});
    std::uint64_t work = 0;
    int visits = 0;
    EXPECT_FALSE(grid.visit(points[0], points[1], points[2], work, [&](std::uint32_t) {
        return ++visits == 2 ? PointGrid::Visit::stop : PointGrid::Visit::go_on;
    }));
    EXPECT_EQ(visits, 2);
}

} // namespace
} // namespace scanout::geom
