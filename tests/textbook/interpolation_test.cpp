// Interpolation: stepped values are the direct ones, and each naive way is wrong where it should
// be.
#include "textbook/interpolation/interpolation.h"
#include "textbook/pixels.h"
#include "textbook/projection.h"

#include <algorithm>
#include <cmath>

namespace scanout::textbook::test {
namespace {

Triangle any_triangle(Random& random, double largest_w) {
    Triangle t;
    for (Corner& c : t.corner) {
        c = {random.in(0, 40), random.in(0, 40), 0, random.in(1, largest_w), {}};
        for (double& v : c.values)
            v = random.in(-1, 1);
    }
    return t;
}

double largest_difference(const Triangle& t, InterpolationMethod a, InterpolationMethod b) {
    std::map<Pixel, Values> direct;
    const Interpolator one = a(t), two = b(t);
    double most = 0;
    fill_box_edge_functions(points_of(t), [&](int y, int x0, int x1) {
        one(y, x0, x1, [&](int x, int line, const Values& v) { direct[{x, line}] = v; });
    });
    fill_x_scanline(points_of(t), [&](int y, int x0, int x1) {
        two(y, x0, x1, [&](int x, int line, const Values& v) {
            const auto found = direct.find({x, line});
            if (found == direct.end()) return;
            for (std::size_t i = 0; i < kValues; ++i)
                most = std::max(most, std::abs(v[i] - found->second[i]));
        });
    });
    return most;
}

TEST(TextbookInterpolation, SteppedValuesAreTheDirectOnes) {
    Random random(1);
    double affine = 0, perspective = 0;
    for (int i = 0; i < 500; ++i) {
        const Triangle t = any_triangle(random, 8);
        if (std::abs(twice_area(points_of(t)[0], points_of(t)[1], points_of(t)[2])) < 1) continue;
        affine =
            std::max(affine, largest_difference(t, interpolate_affine, interpolate_spans_affine));
        perspective = std::max(perspective, largest_difference(t, interpolate_perspective,
                                                               interpolate_spans_perspective));
    }
    EXPECT_LT(affine, 1e-9);
    EXPECT_LT(perspective, 1e-9);
}

TEST(TextbookInterpolation, WithOneDistanceAffineIsRight) {
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        Triangle t = any_triangle(random, 8);
        for (Corner& c : t.corner)
            c.w = 3;
        EXPECT_LT(largest_difference(t, interpolate_affine, interpolate_perspective), 1e-9);
    }
}

Values at(InterpolationMethod method, const Triangle& t, int x, int y) {
    Values found{};
    method(t)(y, x, x + 1, [&](int, int, const Values& v) { found = v; });
    return found;
}

// The document's picture: on the edge between V1 and V3 the third corner is the nearest, and takes
// most of the weight, although barycentric weights give it none.
TEST(TextbookInterpolation, InverseDistanceGivesTheNearThirdVertexTheMost) {
    Triangle t;
    t.corner[0] = {0.5, 20.5, 0, 1, {}};
    t.corner[1] = {20.5, 22.5, 0, 1, {1}};
    t.corner[2] = {40.5, 20.5, 0, 1, {}};
    EXPECT_GT(at(interpolate_inverse_distance, t, 20, 20)[0], 0.8);
    EXPECT_EQ(at(interpolate_perspective, t, 20, 20)[0], 0);
    EXPECT_EQ(at(interpolate_nearest_vertex, t, 20, 20)[0], 1);
    EXPECT_EQ(at(interpolate_inverse_distance, t, 20, 22)[0], 1); // at the corner itself
}

// The middle of an edge from u = 0 at w = 1 to u = 1 at w = 9 shows u = 0.1.
TEST(TextbookInterpolation, PerspectiveIsTheDocumentsFormula) {
    Triangle t;
    t.corner[0] = {0.5, 0.5, 0, 1, {0}};
    t.corner[1] = {20.5, 0.5, 0, 9, {1}};
    t.corner[2] = {0.5, 20.5, 0, 1, {0}};
    EXPECT_NEAR(at(interpolate_perspective, t, 10, 0)[0], 0.1, 1e-15);
    EXPECT_NEAR(at(interpolate_affine, t, 10, 0)[0], 0.5, 1e-15);
    EXPECT_NEAR(at(interpolate_spans_perspective, t, 10, 0)[0], 0.1, 1e-15);
}

// [Compendium 8.4] names another way: take the projection back for every pixel. The place where the
// pixel's ray meets the plane of the corners is the one that is interpolated.
TEST(TextbookInterpolation, TakingTheProjectionBackFindsTheInterpolatedPlace) {
    scene::View view;
    view.half_width = 0.8;
    view.half_height = 0.6;
    const Projection projection(view, {}, 0.1, 100);
    Random random(5);
    double worst = 0;
    int pixels = 0;
    for (int i = 0; i < 300; ++i) {
        Triangle t;
        std::array<DVec3, 3> place;
        for (std::size_t k = 0; k < 3; ++k) {
            place[k] = DVec3(random.in(-1, 1), random.in(-1, 1), random.in(-6, -2));
            t.corner[k] = projection.on_screen(
                {projection.clip_of(place[k]), {place[k].x, place[k].y, place[k].z}}, 80, 60);
        }
        const DVec3 normal = cross3(place[1] - place[0], place[2] - place[0]);
        const Interpolator values = interpolate_perspective(t);
        fill_box_edge_functions(points_of(t), [&](int y, int x0, int x1) {
            values(y, x0, x1, [&](int x, int line, const Values& v) {
                const DVec3 ray((2 * (x + 0.5) / 80 - 1) * view.half_width,
                                (1 - 2 * (line + 0.5) / 60) * view.half_height, -1);
                if (std::abs(dot3(normal, ray)) < 0.01) return; // seen from its side
                const DVec3 met = ray * (dot3(normal, place[0]) / dot3(normal, ray));
                for (int c = 0; c < 3; ++c)
                    worst = std::max(worst, std::abs(met[c] - v[static_cast<std::size_t>(c)]));
                ++pixels;
            });
        });
    }
    EXPECT_GT(pixels, 10000);
    EXPECT_LT(worst, 1e-10);
}

} // namespace
} // namespace scanout::textbook::test
