// Clipping of textbooks: every method against the others.
#include "textbook/clip/clip.h"
#include "textbook/pixels.h"

#include <algorithm>
#include <cmath>

namespace scanout::textbook::test {
namespace {

const Box kBox{2, 3, 30, 20};

TEST(TextbookClip, ThreeLineClipsFindTheSamePart) {
    Random random(1);
    int inside = 0, outside = 0;
    for (int i = 0; i < 5000; ++i) {
        const Segment line{DVec2(random.in(-20, 50), random.in(-20, 50)),
                           DVec2(random.in(-20, 50), random.in(-20, 50))};
        const auto one = clip_liang_barsky(line, kBox), two = clip_cohen_sutherland(line, kBox),
                   three = clip_midpoint_subdivision(line, kBox);
        ASSERT_EQ(one.has_value(), two.has_value());
        if (one && three) {
            ++inside;
            for (const auto& other : {*two, *three}) {
                const double tolerance = 1.0 / 256;
                EXPECT_NEAR(one->first.x, other.first.x, tolerance);
                EXPECT_NEAR(one->first.y, other.first.y, tolerance);
                EXPECT_NEAR(one->second.x, other.second.x, tolerance);
                EXPECT_NEAR(one->second.y, other.second.y, tolerance);
            }
        } else {
            // Halving may miss a part that is shorter than its end: 1/1024 of a pixel.
            if (one)
                EXPECT_LT(std::abs(one->second.x - one->first.x), 1.0 / 256);
            else
                EXPECT_FALSE(three.has_value());
            ++outside;
        }
    }
    EXPECT_GT(inside, 1000);
    EXPECT_GT(outside, 1000);
}

TEST(TextbookClip, LinesAlongASideAndWithoutLengthAreKeptOrNot) {
    for (const LineClip clip :
         {clip_liang_barsky, clip_cohen_sutherland, clip_midpoint_subdivision}) {
        EXPECT_TRUE(clip({DVec2(2, 3), DVec2(30, 3)}, kBox).has_value()); // on the side
        EXPECT_FALSE(clip({DVec2(2, 2), DVec2(30, 2)}, kBox).has_value());
        EXPECT_TRUE(clip({DVec2(5, 5), DVec2(5, 5)}, kBox).has_value());
        EXPECT_FALSE(clip({DVec2(1, 1), DVec2(1, 1)}, kBox).has_value());
    }
}

std::vector<Plane> six_planes() {
    std::vector<Plane> planes;
    for (const double sign : {1.0, -1.0})
        for (const DVec4& axis : {DVec4(1, 0, 0, 0), DVec4(0, 1, 0, 0), DVec4(0, 0, 1, 0)})
            planes.push_back({axis * sign + DVec4(0, 0, 0, 1), 0});
    return planes;
}

// All corners hold -w <= x, y, z <= w, their values are those of their place, and of nine corners
// none is too many.
TEST(TextbookClip, SixPlanesLeaveThreeToNineCornersWithinThem) {
    Random random(2);
    std::map<std::size_t, int> corners;
    for (int i = 0; i < 20000; ++i) {
        Polygon t(3);
        for (Vertex& v : t) {
            v.clip = DVec4(random.in(-4, 4), random.in(-4, 4), random.in(-4, 4), random.in(-1, 3));
            v.values = {v.clip.x, v.clip.y, v.clip.z, v.clip.w};
        }
        const Polygon cut = clip_six_planes(t, six_planes());
        ++corners[cut.size()];
        for (const Vertex& v : cut) {
            for (int c = 0; c < 3; ++c)
                EXPECT_LE(std::abs(v.clip[c]), v.clip.w + 1e-12);
            EXPECT_NEAR(v.values[3], v.clip.w, 1e-12);
        }
    }
    for (std::size_t n = 3; n <= 8; ++n)
        EXPECT_GT(corners[n], 0) << n;
    EXPECT_GT(corners[0], 0);
    EXPECT_TRUE(corners.rbegin()->first <= 9);
    for (const auto& [n, count] : corners)
        record("corners_" + std::to_string(n), count);
}

// One that leaves all six planes has three corners of its own cut off, and three of the sides.
TEST(TextbookClip, ATriangleMayHaveNineCorners) {
    Random random(3);
    std::size_t most = 0;
    for (int i = 0; i < 400000 && most < 9; ++i) {
        Polygon t(3);
        for (Vertex& v : t)
            v.clip = DVec4(random.in(-2, 2), random.in(-2, 2), random.in(-2, 2), 1);
        most = std::max(most, clip_six_planes(t, six_planes()).size());
    }
    EXPECT_EQ(most, 9U);
}

DVec3 area_of(const std::array<Vertex, 3>& t) {
    const auto at = [&](std::size_t i) { return DVec3(t[i].clip); };
    return cross3(at(1) - at(0), at(2) - at(0));
}

// Against the one plane z >= 0: as many triangles as the four cases say, wound like the whole one,
// and together as large as what Sutherland and Hodgman's method leaves.
TEST(TextbookClip, TheFourCasesKeepWindingAndArea) {
    const Plane plane{DVec4(0, 0, 1, 0), 0};
    Random random(4);
    std::map<std::size_t, int> pieces;
    for (int i = 0; i < 5000; ++i) {
        std::array<Vertex, 3> t;
        int inside = 0;
        for (Vertex& v : t) {
            v.clip = DVec4(random.in_cube(4), 1);
            inside += v.clip.z >= 0 ? 1 : 0;
        }
        const auto cut = clip_four_cases(t, plane);
        ++pieces[cut.size()];
        EXPECT_EQ(cut.size(),
                  (std::array<std::size_t, 4>{0, 1, 2, 1}[static_cast<std::size_t>(inside)]));
        DVec3 four(0), fan(0);
        for (const auto& piece : cut) {
            EXPECT_GE(dot3(area_of(piece), area_of(t)), 0);
            four += area_of(piece);
        }
        for_each_of_fan(clip_by_plane({t.begin(), t.end()}, plane),
                        [&](const std::array<Vertex, 3>& piece) { fan += area_of(piece); });
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(four[c], fan[c], 1e-9);
    }
    EXPECT_EQ(pieces.size(), 3U);
}

double area_of(const std::vector<Corner>& polygon) {
    double area = 0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        area += twice_area(DVec2(polygon[0].x, polygon[0].y), DVec2(polygon[i].x, polygon[i].y),
                           DVec2(polygon[i + 1].x, polygon[i + 1].y));
    return area;
}

// Against a window of five sides: no corner lies outside, and what is cut away and what is left are
// as large as the whole.
TEST(TextbookClip, AnyConvexWindowCutsAPolygon) {
    const std::vector<DVec2> window = {{10, 0}, {20, 8}, {16, 20}, {4, 20}, {0, 8}};
    Random random(5);
    int cut_some = 0;
    for (int i = 0; i < 2000; ++i) {
        std::vector<Corner> t(3);
        for (Corner& c : t)
            c = {random.in(-10, 30), random.in(-10, 30), 0.5, random.in(1, 4), {}};
        const auto inside = clip_sutherland_hodgman(t, window);
        double covered = 0, samples = 0;
        for (const Corner& c : inside)
            for (std::size_t s = 0; s < window.size(); ++s)
                EXPECT_GE(twice_area(window[s], window[(s + 1) % window.size()], DVec2(c.x, c.y)),
                          -1e-9);
        // By points, for one triangle in ten.
        if (i % 10 != 0) continue;
        const Points p = {DVec2(t[0].x, t[0].y), DVec2(t[1].x, t[1].y), DVec2(t[2].x, t[2].y)};
        for (double y = 0.05; y < 20; y += 0.1)
            for (double x = 0.05; x < 20; x += 0.1) {
                bool in_window = true;
                for (std::size_t s = 0; s < window.size(); ++s)
                    in_window = in_window && twice_area(window[s], window[(s + 1) % window.size()],
                                                        DVec2(x, y)) > 0;
                samples += in_window && covers(p, x, y) ? 1 : 0;
            }
        covered = std::abs(area_of(inside)) / 2;
        EXPECT_NEAR(covered, samples * 0.01, 1.5);
        cut_some += covered > 0 ? 1 : 0;
    }
    EXPECT_GT(cut_some, 50);
}

} // namespace
} // namespace scanout::textbook::test
