#include "math/rotation.h"
#include "math/transcendental.h"
#include "oracle.h"

#include <array>
#include <limits>

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

using Rotation = DMat3 (*)(double);
constexpr std::array<Rotation, 3> kAxes = {rotation_x, rotation_y, rotation_z};

DMat3 product(const DMat3& a, const DMat3& b) { // fixed order; only for the tests' own matrices
    DMat3 c(0);
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            for (int i = 0; i < 3; ++i)
                c[column][row] += a[i][row] * b[column][i];
    return c;
}

DVec3 apply(const DMat3& m, const DVec3& v) {
    return m[0] * v.x + m[1] * v.y + m[2] * v.z;
}

DMat3 scaling(const DVec3& s) {
    return DMat3(s.x, 0, 0, 0, s.y, 0, 0, 0, s.z);
}

DMat3 any_rotation(Points& p) {
    const auto angle = [&] { return p.uniform(-360, 360); };
    return product(rotation_z(angle()), product(rotation_y(angle()), rotation_x(angle())));
}

DVec3 any_direction(Points& p) {
    return normalized(DVec3(p.uniform(-1, 1), p.uniform(-1, 1), p.uniform(-1, 1)));
}

double degrees_between(const DVec3& a, const DVec3& b) {
    const DVec3 c = cross3(a, b);
    return degrees(atan2(sqrt(dot3(c, c)), dot3(a, b)));
}

TEST(Rotation, IsOrthonormalTo1e15) {
    Points p(1);
    for (int i = 0; i < 100000; ++i)
        for (const Rotation rotation : kAxes) {
            const DMat3 m = rotation(p.any_size(-30, 40));
            for (int j = 0; j < 3; ++j)
                for (int k = 0; k < 3; ++k)
                    ASSERT_NEAR(dot3(m[j], m[k]), j == k ? 1 : 0, 1e-15);
            ASSERT_NEAR(determinant(m), 1, 1e-15);
        }
}

TEST(Rotation, IsExactAtMultiplesOf90Degrees) {
    for (const Rotation rotation : kAxes) {
        const DMat3 quarter = rotation(90);
        DMat3 expected(1);
        for (int i = 0; i < 40; ++i, expected = product(quarter, expected)) {
            EXPECT_EQ(rotation(90.0 * i), expected) << i;
            EXPECT_EQ(product(rotation(-90.0 * i), expected), DMat3(1)) << i;
        }
    }
}

TEST(Rotation, TurnsCounterClockwiseSeenFromTheAxis) {
    EXPECT_EQ(apply(rotation_x(90), DVec3(0, 1, 0)), DVec3(0, 0, 1));
    EXPECT_EQ(apply(rotation_y(90), DVec3(0, 0, 1)), DVec3(1, 0, 0));
    EXPECT_EQ(apply(rotation_z(90), DVec3(1, 0, 0)), DVec3(0, 1, 0));
    for (int axis = 0; axis < 3; ++axis) {
        DVec3 fixed(0);
        fixed[axis] = 1;
        EXPECT_EQ(apply(kAxes[static_cast<std::size_t>(axis)](33), fixed), fixed);
    }
}

TEST(Rotation, TheOppositeAngleIsTheTranspose) {
    Points p(2);
    for (int i = 0; i < 10000; ++i)
        for (const Rotation rotation : kAxes) {
            const double angle = p.uniform(-720, 720);
            const DMat3 m = rotation(angle);
            const DMat3 back = rotation(-angle);
            for (int j = 0; j < 3; ++j)
                for (int k = 0; k < 3; ++k)
                    ASSERT_EQ(m[j][k], back[k][j]);
        }
}

TEST(Cofactor, TimesTheTransposeIsTheDeterminant) {
    Points p(3);
    for (int i = 0; i < 100000; ++i) {
        DMat3 m(0);
        double size = 0; // bounds the products whose rounding is the error
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                size = std::max(size, std::fabs(m[j][k] = p.uniform(-9, 9)));
        const DMat3 c = cofactor(m);
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                ASSERT_NEAR(dot3(m[j], c[k]), j == k ? determinant(m) : 0,
                            size * size * size * 4e-15);
    }
}

// HARD-CASES 26. The oracle: (S R)^-T = S^-1 R for a rotation R, in long double.
DVec3 inverse_transpose_normal(const DVec3& s, const DMat3& r, const DVec3& n) {
    std::array<long double, 3> out{};
    long double length = 0;
    for (int row = 0; row < 3; ++row) {
        for (int i = 0; i < 3; ++i)
            out[static_cast<std::size_t>(row)] += static_cast<long double>(r[i][row]) * n[i];
        out[static_cast<std::size_t>(row)] /= s[row];
        length = std::max(length, std::fabs(out[static_cast<std::size_t>(row)]));
    }
    return normalized(DVec3(static_cast<double>(out[0] / length),
                            static_cast<double>(out[1] / length),
                            static_cast<double>(out[2] / length)));
}

TEST(Cofactor, TurnsNormalsAsTheInverseTransposeDoesUnderAnyScale) {
    Points p(4);
    double worst = 0;
    double naive_worst = 0;
    for (const double scale : {0.1, 1e-3, 1e3, -1.0, -0.1, 1e-20, 1e20})
        for (int i = 0; i < 3000; ++i) {
            const DMat3 r = any_rotation(p);
            DVec3 s(1);
            for (int axis = 0; axis <= i % 3; ++axis)
                s[axis] = scale;
            const DMat3 m = product(scaling(s), r);
            const DVec3 n = any_direction(p);
            const DVec3 exact = inverse_transpose_normal(s, r, n);
            const double mirrored = determinant(m) < 0 ? -1 : 1;
            worst = std::max(worst,
                             degrees_between(normalized(apply(cofactor(m), n)) * mirrored, exact));
            naive_worst = std::max(naive_worst, degrees_between(normalized(apply(m, n)), exact));
        }
    EXPECT_LE(worst, 0.01);
    EXPECT_GT(naive_worst, 70); // M n alone is wrong by so much
}

TEST(Cofactor, StaysFiniteWhereTheInverseDoesNot) { // HARD-CASES 27
    Points p(5);
    for (const double scale : {0.0, -0.0, -1.0, 1e-20})
        for (int i = 0; i < 3000; ++i) {
            DVec3 s(1);
            s[i % 3] = scale;
            const DMat3 m = product(scaling(s), any_rotation(p));
            const DVec3 n = normalized(apply(cofactor(m), any_direction(p)));
            ASSERT_NEAR(sqrt(dot3(n, n)), 1, 1e-6);
            if (scale == 0) {
                ASSERT_NEAR(std::fabs(n[i % 3]), 1, 1e-6); // flat: all face the flat side
            }
        }
}

TEST(Determinant, IsTheVolume) {
    EXPECT_EQ(determinant(scaling(DVec3(2, 3, 4))), 24);
    EXPECT_EQ(determinant(scaling(DVec3(2, -3, 4))), -24);
    EXPECT_EQ(determinant(scaling(DVec3(2, 0, 4))), 0);
}

TEST(Normalized, HasLengthOneAtEverySize) {
    Points p(6);
    for (int i = 0; i < 100000; ++i) {
        const int size = static_cast<int>(p.bits() % 2000) - 1020;
        const DVec3 v(p.any_size(size, size + 2), p.any_size(size, size + 2),
                      p.any_size(size, size + 2));
        const DVec3 n = normalized(v);
        ASSERT_NEAR(dot3(n, n), 1, 1e-15) << v.x;
        const DVec3 half = normalized(v * 0.5);
        ASSERT_EQ(n, half);
    }
    EXPECT_EQ(normalized(DVec3(0x1p-1074, 0, 0)), DVec3(1, 0, 0));
    EXPECT_EQ(normalized(DVec3(0, -0x1.fffffffffffffp1023, 0)), DVec3(0, -1, 0));
}

TEST(Normalized, FallsBackWhereThereIsNoDirection) {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
    const DVec3 fallback(0, 1, 0);
    for (const double bad : {0.0, kInf, -kInf, kNoNumber})
        for (int axis = 0; axis < 3; ++axis) {
            DVec3 v(bad == 0 ? 0.0 : 1.0);
            v[axis] = bad;
            EXPECT_EQ(normalized(v, fallback), fallback);
        }
    EXPECT_EQ(normalized(DVec3(0)), DVec3(0, 0, 1));
}

} // namespace
} // namespace scanout::test
