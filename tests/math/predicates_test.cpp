#include "math/predicates.h"
#include "oracle.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

__extension__ using Int128 = __int128;

int sign_of(Int128 x) {
    return (x > 0) - (x < 0);
}

// What one writes first; it must fail on the inputs below, or they would prove nothing.
int naive_orient2d(const DVec2& a, const DVec2& b, const DVec2& c) {
    const double det = (a.x - c.x) * (b.y - c.y) - (a.y - c.y) * (b.x - c.x);
    return (det > 0) - (det < 0);
}

// With 1000 bits every sum and product below is exact for exponents within +-200.
int exact_orient2d(const DVec2& a, const DVec2& b, const DVec2& c) {
    std::array<mpfr_t, 4> t;
    for (mpfr_t& x : t)
        mpfr_init2(x, 1000);
    const auto difference = [&](mpfr_t& out, double p, double q) {
        mpfr_set_d(out, p, MPFR_RNDN);
        mpfr_sub_d(out, out, q, MPFR_RNDN);
    };
    difference(t[0], a.x, c.x);
    difference(t[1], b.y, c.y);
    difference(t[2], a.y, c.y);
    difference(t[3], b.x, c.x);
    mpfr_mul(t[0], t[0], t[1], MPFR_RNDN);
    mpfr_mul(t[2], t[2], t[3], MPFR_RNDN);
    const int sign = mpfr_cmp(t[0], t[2]);
    for (mpfr_t& x : t)
        mpfr_clear(x);
    return (sign > 0) - (sign < 0);
}

using Triple = std::array<DVec2, 3>;

// c on the line through a and b, as well as doubles can say it, or a few ulps beside.
Triple nearly_collinear(Points& p, int exponents) {
    const auto coordinate = [&] { return p.any_size(-exponents, exponents); };
    const DVec2 a(coordinate(), coordinate());
    const DVec2 b(coordinate(), coordinate());
    const double t = p.uniform(-1, 2);
    DVec2 c(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y));
    for (std::uint64_t i = p.bits() % 3; i > 0; --i)
        c.x = std::nextafter(c.x, (p.bits() & 1) != 0 ? 1e300 : -1e300);
    return {a, b, c};
}

// HARD-CASES 54
TEST(Orient2d, HasTheExactSignOnNearlyCollinearPointsOfAGrid) {
    Points p(1);
    int naive_faults = 0;
    int zeros = 0;
    for (int i = 0; i < 1000000; ++i) {
        // Integers of up to 52 bits; c = (k a + (8 - k) b) / 8 is exact, then moved by at most 1.
        const auto integer = [&] { return static_cast<std::int64_t>(p.bits() >> 15) * 8; };
        const std::int64_t ax = integer(), ay = integer(), bx = integer(), by = integer();
        const std::int64_t k = static_cast<std::int64_t>(p.bits() % 9);
        const std::int64_t cx = ax / 8 * k + bx / 8 * (8 - k) + static_cast<int>(p.bits() % 3) - 1;
        const std::int64_t cy = ay / 8 * k + by / 8 * (8 - k) + static_cast<int>(p.bits() % 3) - 1;
        const Int128 det = Int128(ax - cx) * (by - cy) - Int128(ay - cy) * (bx - cx);
        const double unit = 0x1p-40; // the same on a finer grid
        const auto point = [&](std::int64_t x, std::int64_t y) {
            return DVec2(static_cast<double>(x) * unit, static_cast<double>(y) * unit);
        };
        const DVec2 a = point(ax, ay), b = point(bx, by), c = point(cx, cy);
        ASSERT_EQ(orient2d(a, b, c), sign_of(det)) << i;
        naive_faults += naive_orient2d(a, b, c) != sign_of(det) ? 1 : 0;
        zeros += det == 0 ? 1 : 0;
    }
    EXPECT_GT(zeros, 100000);
    EXPECT_GT(naive_faults, 1000);
}

TEST(Orient2d, HasTheExactSignOnNearlyCollinearPointsOfMixedSizes) {
    int naive_faults = 0;
    Points p(2);
    for (int i = 0; i < 1000000; ++i) {
        const auto [a, b, c] = nearly_collinear(p, i % 2 == 0 ? 2 : 60);
        const int exact = exact_orient2d(a, b, c);
        ASSERT_EQ(orient2d(a, b, c), exact) << i;
        naive_faults += naive_orient2d(a, b, c) != exact ? 1 : 0;
    }
    EXPECT_GT(naive_faults, 1000);
}

TEST(Orient2d, HasTheExactSignRoundTheClassicLine) {
    // Kettner et al. 2008
    int naive_faults = 0;
    for (int i = 0; i < 256; ++i)
        for (int j = 0; j < 256; ++j) {
            const DVec2 a(0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53);
            const int exact = exact_orient2d(a, DVec2(12, 12), DVec2(24, 24));
            ASSERT_EQ(orient2d(a, DVec2(12, 12), DVec2(24, 24)), exact);
            naive_faults += naive_orient2d(a, DVec2(12, 12), DVec2(24, 24)) != exact ? 1 : 0;
        }
    EXPECT_GT(naive_faults, 1000);
}

TEST(Orient2d, DoesNotDependOnTheOrderButForTheSign) {
    Points p(3);
    for (int i = 0; i < 200000; ++i) {
        const auto [a, b, c] = nearly_collinear(p, 10);
        const int sign = orient2d(a, b, c);
        ASSERT_EQ(orient2d(b, c, a), sign);
        ASSERT_EQ(orient2d(c, a, b), sign);
        ASSERT_EQ(orient2d(b, a, c), -sign);
        ASSERT_EQ(orient2d(a, c, b), -sign);
        ASSERT_EQ(orient2d(a, a, c), 0);
        ASSERT_EQ(orient2d(a, c, c), 0);
    }
}

TEST(Orient2d, IsPositiveCounterClockwise) {
    EXPECT_EQ(orient2d({0, 0}, {1, 0}, {0, 1}), 1);
    EXPECT_EQ(orient2d({0, 0}, {0, 1}, {1, 0}), -1);
    EXPECT_EQ(orient2d({0, 0}, {1, 1}, {2, 2}), 0);
}

int exact_orient3d(const std::array<DVec3, 4>& p) {
    mpfr_t sum, term;
    mpfr_inits2(2000, sum, term, static_cast<mpfr_ptr>(nullptr));
    mpfr_set_zero(sum, 1);
    // The 4 x 4 determinant with a column of ones, as the sum over all orders of the rows.
    std::array<int, 4> order = {0, 1, 2, 3};
    do {
        int inversions = 0;
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t k = i + 1; k < 4; ++k)
                inversions += order[i] > order[k] ? 1 : 0;
        const auto row = [&](std::size_t i) { return p[static_cast<std::size_t>(order[i])]; };
        mpfr_set_d(term, row(0).x, MPFR_RNDN);
        mpfr_mul_d(term, term, row(1).y, MPFR_RNDN);
        mpfr_mul_d(term, term, row(2).z, MPFR_RNDN);
        if (inversions % 2 == 1) mpfr_neg(term, term, MPFR_RNDN);
        mpfr_add(sum, sum, term, MPFR_RNDN);
    } while (std::next_permutation(order.begin(), order.end()));
    const int sign = mpfr_sgn(sum);
    mpfr_clears(sum, term, static_cast<mpfr_ptr>(nullptr));
    return (sign > 0) - (sign < 0);
}

int naive_orient3d(const std::array<DVec3, 4>& p) {
    const double det = dot3(p[0] - p[3], cross3(p[1] - p[3], p[2] - p[3]));
    return (det > 0) - (det < 0);
}

TEST(Orient3d, HasTheExactSignOnNearlyCoplanarPoints) {
    Points points(3);
    int naive_faults = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto coordinate = [&] { return points.any_size(-20, 20); };
        std::array<DVec3, 4> p;
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = {coordinate(), coordinate(), coordinate()};
        const double s = points.uniform(-1, 2), t = points.uniform(-1, 2);
        p[3] = p[0] + s * (p[1] - p[0]) + t * (p[2] - p[0]);
        const int exact = exact_orient3d(p);
        ASSERT_EQ(orient3d(p[0], p[1], p[2], p[3]), exact) << i;
        ASSERT_EQ(orient3d(p[1], p[0], p[2], p[3]), -exact) << i;
        ASSERT_EQ(orient3d(p[3], p[0], p[2], p[1]), -exact_orient3d({p[3], p[0], p[1], p[2]}));
        naive_faults += naive_orient3d(p) != exact ? 1 : 0;
    }
    EXPECT_GT(naive_faults, 500);
}

TEST(Orient3d, IsZeroInAPlaneAndSeesWindingFromTheFourthPoint) {
    const DVec3 a(1, 0, 0), b(0, 1, 0), c(0, 0, 1);
    EXPECT_EQ(orient3d(a, b, c, DVec3(0)), 1);
    EXPECT_EQ(orient3d(a, b, c, DVec3(1)), -1);
    EXPECT_EQ(orient3d(a, b, c, DVec3(3, -1, -1)), 0);
    EXPECT_EQ(orient3d({0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {0.3, 7, 5}), 0);
}

// Whole numbers, so that 128 bits hold every sum: points on the plane, and beside it by one.
TEST(SideOfPlane, HasTheExactSignOnAndBesideThePlane) {
    Points points(27);
    const auto whole = [&] {
        return static_cast<std::int64_t>(points.bits() % (1U << 26)) - (1 << 25);
    };
    int naive_faults = 0;
    for (int i = 0; i < 100'000; ++i) {
        std::int64_t n[3], p[3];
        for (int k = 0; k < 3; ++k) {
            n[k] = whole() * 0x7ffffff + whole(); // 52 bits
            p[k] = whole() / 4;
        }
        Int128 exact = 0;
        double rounded = 0;
        for (int k = 0; k < 3; ++k) {
            exact += Int128{n[k]} * p[k];
            rounded += static_cast<double>(n[k]) * static_cast<double>(p[k]);
        }
        const auto offset = static_cast<double>(exact);
        const DVec3 normal(static_cast<double>(n[0]), static_cast<double>(n[1]),
                           static_cast<double>(n[2]));
        const DVec3 at(static_cast<double>(p[0]), static_cast<double>(p[1]),
                       static_cast<double>(p[2]));
        const int sign = sign_of(exact - static_cast<Int128>(offset));
        ASSERT_EQ(side_of_plane(normal, offset, at), sign) << i;
        ASSERT_EQ(side_of_plane(-normal, -offset, at), -sign) << i;
        naive_faults += (rounded > offset) - (rounded < offset) != sign ? 1 : 0;
    }
    EXPECT_GT(naive_faults, 1000);
    EXPECT_EQ(side_of_plane(DVec3(0, 0, 2), 1, DVec3(9, 9, 0.5)), 0);
}

} // namespace
} // namespace scanout::test
