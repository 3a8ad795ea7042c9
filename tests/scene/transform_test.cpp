#include "math/rotation.h"
#include "scene/transform.h"
#include "scene/view.h"
#include "support/meshes.h"
#include "support/random.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace scanout::scene {
namespace {

using test::Random;

// Of the documents: four rows of four, for columns x, y, z, 1.
using Rows = std::array<std::array<long double, 4>, 4>;
constexpr Rows kUnit = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
Rows times(const Rows& a, const Rows& b) {
    Rows out{};
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t k = 0; k < 4; ++k)
                out[r][c] += a[r][k] * b[k][c];
    return out;
}
DVec3 times(const Rows& a, const DVec3& p) {
    DVec3 out;
    for (std::size_t r = 0; r < 3; ++r)
        out[static_cast<int>(r)] =
            static_cast<double>(a[r][0] * p.x + a[r][1] * p.y + a[r][2] * p.z + a[r][3]);
    return out;
}
Rows moved_by(const DVec3& way) {
    return {{{1, 0, 0, way.x}, {0, 1, 0, way.y}, {0, 0, 1, way.z}, {0, 0, 0, 1}}};
}
Rows of(const DMat3& m) {
    Rows out = kUnit;
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
            out[r][c] = m[static_cast<int>(c)][static_cast<int>(r)];
    return out;
}
DMat3 any_matrix(Random& random) {
    return {random.in_cube(2), random.in_cube(2), random.in_cube(2)};
}
double farthest(const DMat3& a, const DMat3& b) {
    double most = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            most = std::max(most, std::abs(a[c][r] - b[c][r]));
    return most;
}

// [Primer 2.3]: shear-x(dy, dz) has the first row 1, dy, dz.
TEST(Transform, ShearsAreTheDocuments) {
    const DVec3 p(2, 3, 5);
    EXPECT_EQ(shear(0, 0.5, 0.25) * p, DVec3(2 + 0.5 * 3 + 0.25 * 5, 3, 5));
    EXPECT_EQ(shear(1, 0.5, 0.25) * p, DVec3(2, 3 + 0.5 * 2 + 0.25 * 5, 5));
    EXPECT_EQ(shear(2, 0.5, 0.25) * p, DVec3(2, 3, 5 + 0.5 * 2 + 0.25 * 3));
}

// [Primer 3.2]: the axis is turned onto z, there the turn is done, and the axis is turned back.
TEST(Transform, ATurnAboutAnyAxisIsATurnAboutZBetweenTwoOthers) {
    Random random(1);
    for (int i = 0; i < 500; ++i) {
        const DVec3 axis = normalized(random.in_cube(1));
        const double angle = random.in(-360, 360);
        const double azimuth = std::atan2(axis.x, axis.z) * 180 / std::numbers::pi,
                     tilt = std::atan2(axis.y, std::hypot(axis.x, axis.z)) * 180 / std::numbers::pi;
        const DMat3 to_axis = rotation_y(azimuth) * rotation_x(-tilt);
        EXPECT_LT(length(to_axis * DVec3(0, 0, 1) - axis), 1e-14);
        EXPECT_LT(
            farthest(rotation_about(axis, angle), to_axis * rotation_z(angle) * transpose(to_axis)),
            1e-14);
    }
    EXPECT_LT(farthest(rotation_about({1, 0, 0}, 30), rotation_x(30)), 1e-16);
    EXPECT_LT(farthest(rotation_about({0, 1, 0}, 30), rotation_y(30)), 1e-16);
}

// [Compendium 10.5]: about c is T(c) M T(-c), and the first that is given stands on the right.
TEST(Transform, StepsAreDoneInTheOrderInWhichTheyAreGiven) {
    Random random(2);
    geom::Mesh mesh = test::empty_mesh();
    mesh.centre = {3, -1, 2};
    mesh.exponent = 0;
    mesh.radius = 1;
    CameraOptions camera;
    camera.distance = 4;
    const View plain = *make_view(mesh, {}, {}, camera, {}, 64, 64);
    for (int i = 0; i < 200; ++i) {
        ModelTransform model;
        model.scale = random.in_cube(2);
        model.rotate_degrees = random.in_cube(180);
        model.translate = random.in_cube(1);
        Rows all =
            times(moved_by(model.translate),
                  times(times(of(rotation_z(model.rotate_degrees.z)),
                              of(rotation_y(model.rotate_degrees.y))),
                        times(of(rotation_x(model.rotate_degrees.x)),
                              of(DMat3(DVec3(model.scale.x, 0, 0), DVec3(0, model.scale.y, 0),
                                       DVec3(0, 0, model.scale.z))))));
        for (int k = 0; k < 4; ++k) {
            TransformStep step{any_matrix(random), random.in_cube(1), {}};
            DVec3 c(0);
            if (k % 2 == 1) {
                step.about = mesh.centre + random.in_cube(2);
                c = *step.about - mesh.centre; // a bounding radius is one
            }
            model.steps.push_back(step);
            all =
                times(times(moved_by(c + step.offset), of(step.linear)), times(moved_by(-c), all));
        }
        const View view = *make_view(mesh, model, {}, camera, {}, 64, 64);
        const DVec3 p = random.in_cube(1);
        const DVec3 there = view.linear * p + view.translation,
                    wanted = plain.linear * times(all, p) + plain.translation;
        EXPECT_LT(length(there - wanted), 1e-10) << i;
    }
}

TEST(Transform, AMatrixIsARotationAfterASymmetricStretch) {
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        DMat3 m = any_matrix(random);
        if (!is_invertible(m)) continue;
        if (i % 4 == 0) m = rotation_xyz(random.in_cube(180)) * scaling(DVec3(random.in(0.1, 4)));
        if (i % 4 == 1) m = rotation_about(normalized(random.in_cube(1)), 180) * 3.0;
        if (i % 4 == 2) m = m * 1e-200;
        const Decomposition d = polar_decomposition(m);
        const double size =
            std::max({std::abs(d.factors.x), std::abs(d.factors.y), std::abs(d.factors.z)});
        const DMat3 stretch = d.axes * scaling(d.factors / size) * transpose(d.axes);
        EXPECT_LT(farthest(d.rotation * stretch, m / size), 1e-12) << i;
        EXPECT_LT(farthest(stretch, transpose(stretch)), 1e-12) << i;
        for (const DMat3& turn : {d.rotation, d.axes}) {
            EXPECT_LT(farthest(turn * transpose(turn), DMat3(1)), 1e-9) << i;
            EXPECT_GT(determinant(turn), 0) << i;
        }
        EXPECT_LT(farthest(rotation_about(d.turn_axis, d.turn_degrees), d.rotation), 1e-6) << i;
        EXPECT_EQ(d.factors.x < 0, determinant(m / size) < 0) << i;
    }
}

TEST(Transform, OnlyMatricesThatCanBeUndoneAreInvertible) {
    EXPECT_TRUE(is_invertible(DMat3(1)));
    EXPECT_TRUE(is_invertible(DMat3(1e-250)));
    EXPECT_TRUE(is_invertible(scaling({1e-30, 1, 1e30})));
    EXPECT_FALSE(is_invertible(DMat3(0)));
    EXPECT_FALSE(is_invertible(scaling({1, 0, 1})));
    EXPECT_FALSE(is_invertible(DMat3(1, 2, 3, 4, 5, 6, 7, 8, 9)));
    EXPECT_FALSE(is_invertible(DMat3(0.1, 0.2, 0.3, 0.2, 0.4, 0.6, 1, 0, 0)));
}

TEST(Transform, TheBoundsOfAStretchHoldForAllDirections) {
    Random random(4);
    double widest = 0;
    for (int i = 0; i < 300; ++i) {
        const bool plain = i % 2 == 0;
        const DVec3 factors(random.in(0.1, 3), random.in(0.1, 3), random.in(0.1, 3));
        const DMat3 m =
            plain ? rotation_xyz(random.in_cube(180)) * scaling(factors) : any_matrix(random);
        const Stretch s = stretch_of(m);
        double least = 1e300, most = 0;
        for (int k = 0; k < 200; ++k) {
            const double by = length(m * normalized(random.in_cube(1)));
            least = std::min(least, by);
            most = std::max(most, by);
        }
        EXPECT_LE(s.least, least * (1 + 1e-12));
        EXPECT_GE(s.most, most * (1 - 1e-12));
        if (plain) {
            EXPECT_NEAR(s.least, std::min({factors.x, factors.y, factors.z}), 1e-12);
            EXPECT_NEAR(s.most, std::max({factors.x, factors.y, factors.z}), 1e-12);
        } else {
            widest = std::max(widest, s.most / most);
        }
    }
    EXPECT_LT(widest, 1.8); // but not for nothing
}

} // namespace
} // namespace scanout::scene
