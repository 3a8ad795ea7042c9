// Exact areas of triangles that the near plane cuts: against the polygon that is left of each,
// clipped to every pixel's box in plain double.
#include "support/scenes.h"

#include <cmath>
#include <vector>

namespace scanout::test {
namespace {

constexpr int kAreaSide = 48;
constexpr double kAreaNear = 0.25;
using Polygon = std::vector<DVec2>; // pixels, y down

double signed_area(const Polygon& p) {
    double twice = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const DVec2 &a = p[i], &b = p[(i + 1) % p.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return twice / 2;
}

// What lies on the inner side of a pixel's edge. Concave polygons keep their area: what is left of
// them may hang together by a seam without any.
Polygon cut_along(const Polygon& p, int axis, double limit, double sign) {
    Polygon kept;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const DVec2 &a = p[i], &b = p[(i + 1) % p.size()];
        const double at = sign * (a[axis] - limit), then = sign * (b[axis] - limit);
        if (at >= 0) kept.push_back(a);
        if ((at >= 0) != (then >= 0)) kept.push_back(a + (b - a) * (at / (at - then)));
    }
    return kept;
}
double coverage_of_pixel(const Polygon& p, int x, int y) {
    Polygon left = cut_along(p, 0, x, 1);
    left = cut_along(left, 0, x + 1, -1);
    left = cut_along(left, 1, y, 1);
    return std::abs(signed_area(cut_along(left, 1, y + 1, -1)));
}

DVec2 pixels_of(const DVec3& at) { // eye at the origin, looks down -z, 90 degrees wide
    return {(1 - at.x / at.z) * (kAreaSide / 2.0), (1 + at.y / at.z) * (kAreaSide / 2.0)};
}
DVec2 to_grid(const DVec2& p) {
    return {std::nearbyint(p.x * 256) / 256, std::nearbyint(p.y * 256) / 256};
}
// Of a triangle in view space what lies before the near plane. Vertices snap to the raster's grid,
// cuts stay where they are.
Polygon seen_of(const std::array<Vec3, 3>& corner) {
    Polygon seen;
    for (std::size_t i = 0; i < 3; ++i) {
        const DVec3 a(corner[i]), b(corner[(i + 1) % 3]);
        const bool here = -a.z >= kAreaNear, then = -b.z >= kAreaNear;
        if (here) seen.push_back(to_grid(pixels_of(a)));
        if (here == then) continue;
        const DVec3 &in = here ? a : b, &out = here ? b : a;
        const double t = (-in.z - kAreaNear) / (out.z - in.z);
        seen.push_back(pixels_of(in + (out - in) * t));
    }
    return seen;
}

struct AreaFrame {
    Shot s = shot("cut", kAreaSide, kAreaSide);
    shade::LinearPicture linear;

    AreaFrame() {
        s.options.aa = "area";
        s.scene.materials = {plain(Vec3(1))};
    }
    void add(const std::array<Vec3, 3>& corner) {
        std::uint32_t index[3];
        for (std::size_t k = 0; k < 3; ++k)
            index[k] = add_vertex(s.scene.mesh, corner[k], Vec3(0, 0, 1));
        add_triangle(s.scene.mesh, index[0], index[1], index[2], 0);
    }
    void draw() {
        scene::View view;
        view.near_distance = kAreaNear;
        scanout::test::draw(s, view, {.linear = &linear});
    }
    double coverage(int x, int y) { return double{linear.at(x, y)[3]}; }
};

// `behind` vertices are nearer than the near plane, or behind the eye.
std::array<Vec3, 3> near_triangle(Random& random, int behind) {
    std::array<Vec3, 3> corner;
    for (int k = 0; k < 3; ++k) {
        const double w =
            k < behind ? random.in(-3, 0.9 * kAreaNear) : random.in(1.1 * kAreaNear, 4);
        const double wide = 1.2 * std::abs(w);
        corner[static_cast<std::size_t>(k)] =
            Vec3(DVec3(random.in(-wide, wide), random.in(-wide, wide), -w));
    }
    return corner;
}

TEST(ClippedArea, IsThatOfTheLeftPolygonInEveryPixel) {
    for (const int behind : {1, 2}) {
        Random random(static_cast<std::uint64_t>(behind));
        double worst = 0;
        int partly = 0;
        for (int round = 0; round < 150; ++round) {
            AreaFrame drawn;
            const std::array<Vec3, 3> corner = near_triangle(random, behind);
            drawn.add(corner);
            drawn.draw();
            const Polygon seen = seen_of(corner);
            for (int y = 0; y < kAreaSide; ++y)
                for (int x = 0; x < kAreaSide; ++x) {
                    const double exact = coverage_of_pixel(seen, x, y);
                    worst = std::max(worst, std::abs(drawn.coverage(x, y) - exact));
                    partly += exact > 0 && exact < 1 ? 1 : 0;
                }
        }
        EXPECT_LT(worst, 1e-6) << behind << " behind"; // coverage is in floats
        EXPECT_GT(partly, 3000);
    }
}

// A floor in many triangles that runs under the eye and behind it: below its far edge there is
// nothing but floor.
TEST(ClippedArea, OfAFloorUnderTheEyeLeavesNoSeam) {
    AreaFrame drawn;
    Random random(3);
    constexpr int kCells = 9;
    const auto at = [&](int i, int k) {
        return Vec3(static_cast<float>(i - kCells / 2.0) * 1.7F, -0.4F,
                    static_cast<float>(k - kCells + 3) * 0.9F);
    };
    for (int k = 0; k < kCells; ++k)
        for (int i = 0; i < kCells; ++i) {
            const Vec3 a = at(i, k), b = at(i + 1, k), c = at(i + 1, k + 1), d = at(i, k + 1);
            if (random.whole(0, 1) == 0) {
                drawn.add({a, c, b});
                drawn.add({a, d, c});
            } else {
                drawn.add({a, d, b});
                drawn.add({b, d, c});
            }
        }
    drawn.draw();
    const double far = pixels_of(DVec3(at(0, 0))).y;
    ASSERT_LT(far, kAreaSide - 16);
    for (int y = 0; y < kAreaSide; ++y)
        for (int x = 0; x < kAreaSide; ++x) {
            const double below = std::clamp(y + 1 - to_grid({0, far}).y, 0.0, 1.0);
            ASSERT_NEAR(drawn.coverage(x, y), below, 1e-6) << x << ',' << y;
        }
}

} // namespace
} // namespace scanout::test
