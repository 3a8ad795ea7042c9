#include "geom/outlines.h"
#include "math/predicates.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::geom {
namespace {

struct Drawing {
    std::vector<DVec2> points;
    std::vector<OutlineEdge> edges;

    void add(const std::vector<DVec2>& loop) {
        const auto first = static_cast<std::uint32_t>(points.size());
        const auto n = static_cast<std::uint32_t>(loop.size());
        points.insert(points.end(), loop.begin(), loop.end());
        for (std::uint32_t i = 0; i < n; ++i)
            edges.push_back({first + i, first + (i + 1) % n});
    }
};

double doubled_area(const DVec2& a, const DVec2& b, const DVec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// No triangle is turned, and all together have the area: so they cover it once.
void expect_covered(const Drawing& d, double doubled) {
    const Outlines found = find_outlines(d.points, d.edges);
    EXPECT_EQ(found.open_edges, 0U);
    std::vector<std::uint32_t> out;
    for (const Polygon& polygon : found.polygons)
        triangulate(d.points, polygon, out);
    double sum = 0;
    for (std::size_t i = 0; i < out.size(); i += 3) {
        const DVec2 &a = d.points[out[i]], &b = d.points[out[i + 1]], &c = d.points[out[i + 2]];
        EXPECT_GE(orient2d(a, b, c), 0);
        sum += doubled_area(a, b, c);
    }
    EXPECT_NEAR(sum, doubled, 1e-9 * doubled);
}

// A comb whose teeth and holes hide corners from each other: bridges have to go around them.
TEST(Outlines, HolesBetweenTeethAreBridgedToCornersThatTheySee) {
    std::mt19937 random(5);
    const auto below = [&](int n) {
        return static_cast<double>(random() % static_cast<unsigned>(n));
    };
    for (int round = 0; round < 200; ++round) {
        Drawing d;
        std::vector<DVec2> comb = {{0, 0}, {1000, 0}};
        double area = 0;
        for (int tooth = 9; tooth >= 0; --tooth) { // teeth hang down, as deep as chance has it
            const double x = tooth * 100, depth = 200 + below(700);
            comb.push_back({x + 100, 1000});
            comb.push_back({x + 60 + below(30), 1000 - depth});
            comb.push_back({x + 10 + below(30), 1000});
        }
        comb.push_back({0, 1000});
        for (std::size_t i = 2; i < comb.size(); ++i)
            area += doubled_area(comb[0], comb[i - 1], comb[i]);
        d.add(comb);
        for (int i = 0; i < 12; ++i) { // holes under the teeth, in a grid, clockwise
            const double x = 20 + i % 6 * 160 + below(40), y = 10 + i / 6 * 45 + below(8);
            const double w = 30 + below(60), h = 5 + below(20), lean = below(10);
            d.add({{x, y}, {x + lean, y + h}, {x + w + lean, y + h}, {x + w, y}});
            area -= 2 * w * h;
        }
        expect_covered(d, area);
    }
}

// The nearest corner of a hole stands behind a wall whose own corners are far away.
TEST(Outlines, NoBridgeGoesThroughAWall) {
    Drawing d;
    d.add({{0, 0}, {1000, 0}, {1000, 1000}, {505, 1000}, {500, 100}, {495, 1000}, {0, 1000}});
    d.add({{510, 500}, {510, 520}, {530, 520}, {530, 500}});
    d.add({{460, 505}, {460, 515}, {485, 515}, {485, 505}});
    expect_covered(d, 2 * (1e6 - 4500 - 400 - 250));
}

// Rings in rings, the holes of one beside corners that others hide.
TEST(Outlines, RingsInRingsAreFilledInTurn) {
    Drawing d;
    double area = 0;
    for (int ring = 0; ring < 8; ++ring) {
        const double r = 100 - 12.0 * ring;
        std::vector<DVec2> square = {{-r, -r}, {r, -r}, {r, r}, {-r, r}};
        if (ring % 2 == 1) std::reverse(square.begin(), square.end());
        d.add(square);
        area += (ring % 2 == 0 ? 8 : -8) * r * r;
    }
    EXPECT_EQ(find_outlines(d.points, d.edges).polygons.size(), 4U);
    expect_covered(d, area);
}

// Two squares that touch at a corner, one point of the drawing: each is a loop.
TEST(Outlines, LoopsThatTouchAtAPointAreToldApart) {
    Drawing d;
    d.points = {{0, 0}, {-2, 0}, {-2, -2}, {0, -2}, {2, 0}, {2, 2}, {0, 2}};
    d.edges = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {4, 5}, {5, 6}, {6, 0}};
    const Outlines found = find_outlines(d.points, d.edges);
    ASSERT_EQ(found.polygons.size(), 2U);
    for (const Polygon& polygon : found.polygons)
        EXPECT_EQ(polygon.outline.points.size(), 4U);
    expect_covered(d, 16);
}

TEST(Outlines, WhatDoesNotCloseIsCounted) {
    Drawing d;
    d.add({{0, 0}, {1, 0}, {0, 1}});
    d.points.insert(d.points.end(), {{5, 5}, {6, 5}, {7, 5}});
    d.edges.push_back({4, 3});
    d.edges.push_back({4, 5});
    const Outlines found = find_outlines(d.points, d.edges);
    EXPECT_EQ(found.open_edges, 2U);
    EXPECT_EQ(found.polygons.size(), 1U);
}

} // namespace
} // namespace scanout::geom
