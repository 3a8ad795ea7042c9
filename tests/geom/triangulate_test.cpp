#include "geom/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::geom {
namespace {

__extension__ using Int128 = __int128;

struct Point {
    std::int64_t x, y;
    bool operator==(const Point&) const = default;
};
using Outline = std::vector<Point>; // counter-clockwise, coordinates below 2^40

// Twice the signed area, exactly.
Int128 area2(const Point& a, const Point& b, const Point& c) {
    return Int128{b.x - a.x} * (c.y - a.y) - Int128{b.y - a.y} * (c.x - a.x);
}
Int128 area2(const Outline& p) {
    Int128 sum = 0;
    for (std::size_t i = 2; i < p.size(); ++i)
        sum += area2(p[0], p[i - 1], p[i]);
    return sum;
}

std::vector<std::uint32_t> triangles_of(const Outline& p) {
    std::vector<DVec3> polygon;
    for (const Point& q : p)
        polygon.emplace_back(q.x, q.y, 0);
    std::vector<std::uint32_t> out;
    triangulate(polygon, out);
    return out;
}

// n - 2 triangles, and their directed edges cancel but for the outline's own: true of every
// outline.
std::string fault_of_topology(std::size_t n, const std::vector<std::uint32_t>& triangles) {
    if (triangles.size() != 3 * (n - 2)) return "not n - 2 triangles";
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t t = 0; t < triangles.size(); t += 3)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = triangles[t + i], b = triangles[t + (i + 1) % 3];
            if (a >= n) return "a corner that is not there";
            if (a == b) return "a triangle with a corner twice";
            ++edges[{a, b}];
            --edges[{b, a}];
        }
    for (std::uint32_t i = 0; i < n; ++i) {
        const auto next = static_cast<std::uint32_t>((i + 1) % n);
        --edges[{i, next}];
        ++edges[{next, i}];
    }
    for (const auto& [edge, count] : edges)
        if (count != 0) return "edges do not cancel";
    return "";
}

// For an outline that does not cross itself, triangles that all turn left cover it exactly once:
// their signed areas add up to its own whatever they are, and winding numbers add up likewise.
std::string fault_of(const Outline& p) {
    const std::vector<std::uint32_t> t = triangles_of(p);
    if (std::string fault = fault_of_topology(p.size(), t); !fault.empty()) return fault;
    Int128 sum = 0;
    for (std::size_t i = 0; i < t.size(); i += 3) {
        const Int128 a = area2(p[t[i]], p[t[i + 1]], p[t[i + 2]]);
        if (a < 0) return "a flipped triangle";
        sum += a;
    }
    return sum == area2(p) ? "" : "areas do not add up";
}

int flipped_in_fan(const Outline& p) {
    int flipped = 0;
    for (std::size_t i = 2; i < p.size(); ++i)
        flipped += area2(p[0], p[i - 1], p[i]) < 0;
    return flipped;
}

// Random directions sorted by exact angle, random distances: simple, and as concave as can be.
Outline star(std::uint32_t seed, std::size_t corners, int size) {
    std::mt19937 random(seed);
    const auto coordinate = [&] {
        return static_cast<std::int64_t>(random() % static_cast<unsigned>(2 * size + 1)) - size;
    };
    Outline p{{size, -size - 1}, {size + 1, size}, {-size, size + 1}, {-size - 1, -size}};
    while (p.size() < corners + 4) {
        const Point q{coordinate(), coordinate()};
        if (q.x != 0 || q.y != 0) p.push_back(q);
    }
    const auto upper = [](const Point& q) { return q.y > 0 || (q.y == 0 && q.x > 0); };
    const Point origin{0, 0};
    std::sort(p.begin(), p.end(), [&](const Point& a, const Point& b) {
        return upper(a) != upper(b) ? upper(a) : area2(origin, a, b) > 0;
    });
    const auto same_direction = [&](const Point& a, const Point& b) {
        return upper(a) == upper(b) && area2(origin, a, b) == 0;
    };
    p.erase(std::unique(p.begin(), p.end(), same_direction), p.end());
    return p;
}

// A comb: teeth of random lengths, collinear runs along its back.
Outline comb(std::uint32_t seed, int teeth) {
    std::mt19937 random(seed);
    Outline p;
    for (int i = 0; i <= 2 * teeth; ++i)
        p.push_back({i * 10, 0});
    for (int i = 2 * teeth; i >= 0; --i)
        p.push_back({i * 10, i % 2 == 0 ? 1 + static_cast<int>(random() % 9)
                                        : 20 + static_cast<int>(random() % 2000)});
    return p;
}

// A square with square holes, each joined to the outline by a cut that is walked twice: the way a
// face with holes is written in formats that have none. Holes may share the corner the cut ends at.
Outline keyhole(std::uint32_t seed, int holes, bool one_hub) {
    std::mt19937 random(seed);
    Outline p{{0, 0}};
    for (int i = 0; i < holes; ++i) {
        const std::int64_t x = i * 100 + 20, w = 1 + static_cast<int>(random() % 60);
        if (!one_hub) p.push_back({x, 0});
        p.insert(p.end(), {{x, 50}, {x, 50 + w}, {x + w, 50 + w}, {x + w, 50}, {x, 50}});
        p.push_back(one_hub ? Point{0, 0} : Point{x, 0});
        if (one_hub) break;
    }
    p.insert(p.end(), {{holes * 100, 0}, {holes * 100, 200}, {0, 200}});
    return p;
}

// A square with a tree of slits: the outline walks along every slit twice, and whatever lies on the
// grid is touched again and again. `size` x `size` grid points, all in the tree, sheared at random.
Outline slit_square(std::uint32_t seed, int size) {
    std::mt19937 random(seed);
    const auto at = [&](int x, int y) { return y * size + x; };
    std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(size * size)); // of the tree
    std::vector<int> reached{at(0, 0)};
    std::vector<bool> in_tree(neighbours.size());
    in_tree[0] = true;
    for (std::size_t left = neighbours.size() - 1; left > 0;) {
        const int from = reached[random() % reached.size()], x = from % size, y = from / size;
        const int dx = std::array{1, 0, -1, 0}[random() % 4],
                  dy = std::array{0, 1, 0, -1}[random() % 4];
        if ((dx != 0) == (dy != 0) || x + dx < 0 || x + dx >= size || y + dy < 0 || y + dy >= size)
            continue;
        const int to = at(x + dx, y + dy);
        if (in_tree[static_cast<std::size_t>(to)]) continue;
        in_tree[static_cast<std::size_t>(to)] = true;
        neighbours[static_cast<std::size_t>(from)].push_back(to);
        neighbours[static_cast<std::size_t>(to)].push_back(from);
        reached.push_back(to);
        --left;
    }
    const auto point = [&](int i) { return Point{1 + i % size, 1 + i / size}; };
    Outline p{{0, 0}, {1, 1}};
    // Along the tree with the inside on the left: the next slit is the first one clockwise from the
    // one that we came by.
    const auto quarter = [&](int from, int to) {
        const int d = to - from;
        return d == 1 ? 0 : d == size ? 1 : d == -1 ? 2 : 3;
    };
    int here = 0, back = 3; // the cut from the corner (0, 0) comes from below
    while (p.size() < 5 * neighbours.size() + 5) {
        int best = -1, best_turn = 5;
        for (const int to : neighbours[static_cast<std::size_t>(here)]) {
            const int turn = (back - quarter(here, to) + 3) % 4 + 1; // quarters clockwise, 1 to 4
            if (turn < best_turn) best_turn = turn, best = to;
        }
        if (here == 0 && best_turn > back % 4 + 1) break; // the cut comes first
        back = quarter(best, here);
        here = best;
        p.push_back(point(here));
    }
    p.insert(p.end(), {{0, 0}, {size + 1, 0}, {size + 1, size + 1}, {0, size + 1}});
    const std::int64_t a = 1 + random() % 4, b = random() % 4, c = random() % 2,
                       d = 1 + random() % 4;
    if (a * d - b * c <= 0) return p;
    for (Point& q : p)
        q = {a * q.x + b * q.y, c * q.x + d * q.y};
    return p;
}

Outline shuffled_start(Outline p, std::uint32_t seed) {
    std::rotate(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(seed % p.size()), p.end());
    return p;
}

// Corners in the middle of edges, and corners twice in the same place.
Outline with_needless_corners(const Outline& p, std::uint32_t seed) {
    std::mt19937 random(seed);
    Outline out;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Point a{p[i].x * 4, p[i].y * 4};
        const Point b{p[(i + 1) % p.size()].x * 4, p[(i + 1) % p.size()].y * 4};
        out.insert(out.end(), 1 + (random() % 4 == 0) + (random() % 9 == 0), a);
        for (std::int64_t k = 1; k < 4; ++k)
            if (random() % 3 == 0)
                out.push_back({a.x + (b.x - a.x) / 4 * k, a.y + (b.y - a.y) / 4 * k});
    }
    return out;
}

// Spikes at some corners: the outline goes to a place and comes back, perhaps by a stop or two, or
// with a spike of the spike.
Outline with_spikes(const Outline& p, std::uint32_t seed) {
    std::mt19937 random(seed);
    Outline out;
    for (const Point& corner : p) {
        const Point a{corner.x * 4, corner.y * 4};
        out.push_back(a);
        if (random() % 3 != 0) continue;
        const Point step{static_cast<int>(random() % 801) - 400,
                         static_cast<int>(random() % 801) - 400};
        const auto along = [&](int steps) {
            return Point{a.x + step.x * steps, a.y + step.y * steps};
        };
        if (random() % 2 == 0) out.push_back(along(1));
        out.push_back(along(3));
        if (random() % 2 == 0) {
            const Point tip = along(3);
            out.insert(out.end(), {{tip.x + 7, tip.y - 9}, tip});
        }
        if (random() % 2 == 0) out.push_back(along(2));
        out.push_back(a);
    }
    return out;
}

RC_GTEST_PROP(Triangulate, SpikesEncloseNothing, (std::uint32_t seed, bool holes)) {
    const Outline p = holes ? keyhole(seed, 4, false) : star(seed, 12, 1000);
    RC_ASSERT(fault_of(shuffled_start(with_spikes(p, seed), seed)) == "");
}

RC_GTEST_PROP(Triangulate, StarsAreCoveredExactlyOnce, (std::uint32_t seed)) {
    const Outline p = shuffled_start(star(seed, *rc::gen::inRange<std::size_t>(0, 60), 1000), seed);
    RC_ASSERT(fault_of(p) == "");
}

RC_GTEST_PROP(Triangulate, StarsOnASmallGridWithManyCollinearCornersAreCovered,
              (std::uint32_t seed)) {
    RC_ASSERT(fault_of(shuffled_start(star(seed, 40, 4), seed)) == "");
}

RC_GTEST_PROP(Triangulate, NeedlessCornersDoNotHarm, (std::uint32_t seed)) {
    RC_ASSERT(fault_of(shuffled_start(with_needless_corners(star(seed, 12, 20), seed), seed)) ==
              "");
}

RC_GTEST_PROP(Triangulate, CombsAreCovered, (std::uint32_t seed)) {
    RC_ASSERT(fault_of(shuffled_start(comb(seed, *rc::gen::inRange(1, 60)), seed)) == "");
}

RC_GTEST_PROP(Triangulate, HolesJoinedByACutStayHoles, (std::uint32_t seed, bool one_hub)) {
    RC_ASSERT(fault_of(shuffled_start(keyhole(seed, *rc::gen::inRange(1, 12), one_hub), seed)) ==
              "");
}

RC_GTEST_PROP(Triangulate, ASquareFullOfSlitsIsCovered, (std::uint32_t seed)) {
    const int size = *rc::gen::inRange(1, 8);
    const Outline p = slit_square(seed, size);
    RC_ASSERT(p.size() == static_cast<std::size_t>(2 * size * size + 4));
    RC_ASSERT(fault_of(shuffled_start(p, seed)) == "");
}

RC_GTEST_PROP(Triangulate, AClockwiseOutlineGivesClockwiseTriangles, (std::uint32_t seed)) {
    Outline p = star(seed, 30, 1000);
    const Int128 area = area2(p);
    std::reverse(p.begin(), p.end());
    const std::vector<std::uint32_t> t = triangles_of(p);
    Int128 sum = 0;
    for (std::size_t i = 0; i < t.size(); i += 3) {
        const Int128 a = area2(p[t[i]], p[t[i + 1]], p[t[i + 2]]);
        RC_ASSERT(a <= Int128{0});
        sum -= a;
    }
    RC_ASSERT(sum == area);
}

RC_GTEST_PROP(Triangulate, AnyOutlineGivesAllTrianglesOfARing, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    Outline p(*rc::gen::inRange<std::size_t>(3, 80));
    const int size =
        1 + static_cast<int>(random() % 12); // many corners on the same place, many crossings
    const auto below = [&] { return static_cast<int>(random() % 12) % size; };
    for (Point& q : p)
        q = {below(), below()};
    RC_ASSERT(fault_of_topology(p.size(), triangles_of(p)) == "");
}

// HARD-CASES 52
RC_GTEST_PROP(Triangulate, TheAreaOfASimplePolygonIsKept, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> distance(0.1, 1), offset(-1e3, 1e3);
    const int n = *rc::gen::inRange(3, 300);
    const DVec3 centre(offset(random), offset(random), 0);
    std::vector<DVec3> p;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * 3.14159265358979 * i / n, r = distance(random);
        p.push_back(centre + r * DVec3(std::cos(angle), std::sin(angle), 0));
    }
    std::vector<std::uint32_t> t;
    triangulate(p, t);
    const auto area = [&](std::size_t a, std::size_t b, std::size_t c) {
        const auto x = [&](std::size_t i) { return static_cast<long double>(p[i].x); };
        const auto y = [&](std::size_t i) { return static_cast<long double>(p[i].y); };
        return ((x(b) - x(a)) * (y(c) - y(a)) - (y(b) - y(a)) * (x(c) - x(a))) / 2;
    };
    long double polygon = 0, sum = 0;
    for (std::size_t i = 2; i < p.size(); ++i)
        polygon += area(0, i - 1, i);
    for (std::size_t i = 0; i < t.size(); i += 3)
        sum += std::abs(area(t[i], t[i + 1], t[i + 2]));
    RC_ASSERT(std::abs(sum - polygon) <= 1e-12L * polygon);
}

RC_GTEST_PROP(Triangulate, NoTriangleOfAConvexPolygonInSpaceIsFlipped, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto vector = [&] { return DVec3(uniform(random), uniform(random), uniform(random)); };
    const DVec3 u = vector(), v = vector(), normal = cross3(u, v);
    RC_PRE(dot3(normal, normal) > 1e-4);
    const int n = *rc::gen::inRange(3, 40);
    std::vector<DVec3> p;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * 3.14159265358979 * i / n;
        p.push_back(u * std::cos(angle) + v * std::sin(angle) +
                    normal * (0.01 / n / n * uniform(random)));
    }
    std::vector<std::uint32_t> t;
    triangulate(p, t);
    RC_ASSERT(fault_of_topology(p.size(), t) == "");
    for (std::size_t i = 0; i < t.size(); i += 3)
        RC_ASSERT(dot3(cross3(p[t[i + 1]] - p[t[i]], p[t[i + 2]] - p[t[i]]), normal) > 0);
}

RC_GTEST_PROP(Triangulate, NewellsNormalIsTwiceTheAreaVectorWhereverThePolygonIs,
              (std::uint32_t seed)) {
    const Outline p = star(seed, 20, 1000);
    std::vector<DVec3> polygon;
    for (const Point& q : p)
        polygon.emplace_back(5e9, static_cast<double>(q.x) + 4e9, static_cast<double>(q.y));
    RC_ASSERT(newell_normal(polygon) == DVec3(static_cast<double>(area2(p)), 0, 0));
}

// As many as a saw blade or a heat sink has, at any angle: the feet of all teeth lie on one line.
TEST(Triangulate, CombsOfAHundredThousandCornersAreCovered) {
    Outline p{{0, 0}, {60'000, 0}};
    for (std::int64_t i = 30'000; i > 0; --i)
        p.insert(p.end(), {{2 * i, 1}, {2 * i, 50}, {2 * i - 1, 50}, {2 * i - 1, 1}});
    p.push_back({0, 1});
    EXPECT_EQ(fault_of(p), "");
    for (Point& q : p)
        q = {4 * q.x - 3 * q.y, 3 * q.x + 4 * q.y};
    EXPECT_EQ(fault_of(p), "");
}

TEST(Triangulate, AFanWouldFlipTrianglesOfTheseOutlines) {
    EXPECT_GT(flipped_in_fan(star(1, 60, 1000)), 0);
    EXPECT_GT(flipped_in_fan(comb(1, 20)), 0);
    EXPECT_GT(flipped_in_fan(shuffled_start(keyhole(1, 5, false), 3)), 0);
}

TEST(Triangulate, ConvexPolygonsAreAFanAboutTheFirstCorner) {
    const std::vector<std::uint32_t> fan{0, 1, 2, 0, 2, 3, 0, 3, 4};
    EXPECT_EQ(triangles_of({{0, 0}, {4, 0}, {6, 3}, {3, 5}, {-1, 3}}), fan);
}

TEST(Triangulate, AConcaveQuadrilateralIsCutFromItsConcaveCorner) {
    const Outline dart{{0, 0}, {4, -3}, {1, 0}, {4, 3}};
    for (std::uint32_t start = 0; start < 4; ++start) {
        const Outline p = shuffled_start(dart, start);
        EXPECT_EQ(fault_of(p), "") << start;
        const std::vector<std::uint32_t> t = triangles_of(p);
        const auto concave = static_cast<std::uint32_t>((2 + 4 - start) % 4);
        EXPECT_EQ(std::count(t.begin(), t.end(), concave), 2) << start;
    }
}

// A triangle with any number of further corners on its edges: none of its triangles need be without
// area, but for those that a corner on top of another one makes.
RC_GTEST_PROP(Triangulate, CornersOnStraightEdgesBecomeCornersOfRealTriangles,
              (std::uint32_t seed)) {
    std::mt19937 random(seed);
    const Outline corners{{0, 0}, {400, 10}, {30, 300}};
    Outline p;
    int doubled = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point &a = corners[i], &b = corners[(i + 1) % 3];
        p.push_back(a);
        for (std::int64_t k = 1; k < 10; ++k) {
            const bool some = random() % (2 + i) == 0 && i != seed % 4, twice = random() % 8 == 0;
            if (some)
                p.insert(p.end(), 1 + twice,
                         {a.x + (b.x - a.x) / 10 * k, a.y + (b.y - a.y) / 10 * k});
            doubled += some && twice;
        }
    }
    const Outline q = shuffled_start(p, seed / 7);
    RC_ASSERT(fault_of(q) == "");
    const std::vector<std::uint32_t> t = triangles_of(q);
    int without_area = 0;
    for (std::size_t i = 0; i < t.size(); i += 3)
        without_area += area2(q[t[i]], q[t[i + 1]], q[t[i + 2]]) == Int128{0};
    RC_ASSERT(without_area == doubled);
}

TEST(Triangulate, AHoleThatTouchesTheOutlineTwiceStaysAHole) {
    // At a corner, through which the outline goes twice, and in the middle of an edge: the ear at
    // (10, 0) has no corner inside, but the hole's edges go through it.
    const Outline p{{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}, {5, 8}, {10, 5}};
    for (std::uint32_t start = 0; start < p.size(); ++start)
        EXPECT_EQ(fault_of(shuffled_start(p, start)), "") << start;
}

TEST(Triangulate, PolygonsWithoutAreaGiveTheirTriangles) {
    EXPECT_EQ(fault_of_topology(6, triangles_of({{1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}})),
              "");
    EXPECT_EQ(fault_of_topology(6, triangles_of({{0, 0}, {1, 1}, {2, 2}, {3, 3}, {2, 2}, {1, 1}})),
              "");
    EXPECT_EQ(fault_of_topology(3, triangles_of({{0, 0}, {0, 0}, {0, 0}})), "");
    EXPECT_TRUE(triangles_of({{0, 0}, {1, 0}}).empty());
    EXPECT_TRUE(triangles_of({}).empty());
}

TEST(Triangulate, PolygonsOfTwentyThousandCornersAreCovered) {
    EXPECT_EQ(fault_of(star(7, 20000, 1 << 20)), "");
    EXPECT_EQ(fault_of(comb(7, 5000)), "");
    // Ears whose boxes all lie over the whole polygon: the grid is of no help.
    Outline zigzag;
    for (std::int64_t i = 0; i < 10000; ++i)
        zigzag.push_back({2 * i, i % 2 == 0 ? 0 : 100'000 + 2 * i});
    for (std::int64_t i = 10000; i-- > 0;)
        zigzag.push_back({2 * i, i % 2 == 0 ? 3 : 100'003 + 2 * i});
    if (area2(zigzag) < 0) std::reverse(zigzag.begin(), zigzag.end());
    EXPECT_EQ(fault_of(zigzag), "");
}

} // namespace
} // namespace scanout::geom
