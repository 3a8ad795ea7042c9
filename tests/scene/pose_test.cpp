#include "scene/pose.h"
#include "scene/view.h"
#include "support/meshes.h"
#include "support/random.h"

#include <cmath>

#include <gtest/gtest.h>
#include <mpfr.h>

namespace scanout::scene {
namespace {

TEST(Pose, AThousandFullTurnsAreTheIdentity) {
    const int start = 12345;
    // Steps that divide the turn, in both directions, small and large.
    for (const int step : {1, -1, 512, -512, kFullTurn / 16, -kFullTurn * 3}) {
        Pose pose;
        pose.pitch = pose.yaw = start;
        const std::int64_t steps =
            std::max<std::int64_t>(1000LL * kFullTurn / std::abs(step), 1000);
        for (std::int64_t i = 0; i < steps; ++i)
            pose.yaw = wrap_angle(std::int64_t{pose.yaw} + step);
        EXPECT_EQ(pose.yaw, start) << "step " << step;
        EXPECT_EQ(pose.pitch, start);
    }
}

TEST(Pose, AnglesWrapIntoOneTurn) {
    EXPECT_EQ(wrap_angle(0), 0);
    EXPECT_EQ(wrap_angle(-1), kFullTurn - 1);
    EXPECT_EQ(wrap_angle(kFullTurn), 0);
    EXPECT_EQ(wrap_angle(-kFullTurn), 0);
    test::Random random(1);
    for (int i = 0; i < 10000; ++i) {
        const auto units = static_cast<std::int64_t>(random.bits()) >> random.whole(0, 60);
        const int wrapped = wrap_angle(units);
        EXPECT_GE(wrapped, 0);
        EXPECT_LT(wrapped, kFullTurn);
        EXPECT_EQ((units % kFullTurn - wrapped) % kFullTurn, 0) << units;
    }
}

TEST(Pose, ElevationStopsAtThePoles) {
    EXPECT_EQ(clamp_elevation(90 * kAngleUnitsPerDegree + 1), 90 * kAngleUnitsPerDegree);
    EXPECT_EQ(clamp_elevation(INT64_MIN), -90 * kAngleUnitsPerDegree);
    EXPECT_EQ(clamp_elevation(-5), -5);
}

TEST(Pose, ZoomStopsAtItsLimits) {
    EXPECT_EQ(clamp_zoom(INT64_MAX), kMaxZoomLevel);
    EXPECT_EQ(clamp_zoom(INT64_MIN), -kMaxZoomLevel);
    EXPECT_EQ(clamp_zoom(17), 17);
    Pose pose;
    zoom_towards(pose, 100 * kMaxZoomLevel, 1, 1);
    EXPECT_EQ(pose.zoom, kMaxZoomLevel);
    zoom_towards(pose, -100 * kMaxZoomLevel, 1, 1);
    EXPECT_EQ(pose.zoom, -kMaxZoomLevel);
}

// |scale - 2^(level / 64)| in ulps of the exact value, which MPFR computes with 200 bits.
double scale_error(int level) {
    mpfr_t exact, got;
    mpfr_inits2(200, exact, got, nullptr);
    mpfr_set_d(exact, static_cast<double>(level) / 64, MPFR_RNDN); // 64 = a power of two: exact
    mpfr_exp2(exact, exact, MPFR_RNDN);
    mpfr_set_d(got, zoom_scale(level), MPFR_RNDN);
    const long exponent = mpfr_get_exp(exact) - 1;
    mpfr_sub(got, got, exact, MPFR_RNDN);
    mpfr_mul_2si(got, got, 52 - exponent, MPFR_RNDN);
    const double ulps = std::abs(mpfr_get_d(got, MPFR_RNDN));
    mpfr_clears(exact, got, nullptr);
    return ulps;
}

TEST(Pose, ZoomScaleIsWithinFourUlpOfTheClosedFormAfterAMillionSteps) {
    Pose pose;
    test::Random random(2);
    double worst = 0;
    for (int i = 0; i < 1000000; ++i) {
        zoom_towards(pose, random.whole(-40, 40), 0, 0);
        if (i % 100 == 0) worst = std::max(worst, scale_error(pose.zoom));
    }
    for (int level = -kMaxZoomLevel; level <= kMaxZoomLevel; ++level)
        worst = std::max(worst, scale_error(level));
    EXPECT_LE(worst, 4);
    RecordProperty("worst_ulp_times_1000", static_cast<int>(worst * 1000));
    for (int octave = -20; octave <= 20; ++octave)
        EXPECT_EQ(zoom_scale(octave * kZoomLevelsPerOctave), std::ldexp(1.0, octave));
}

TEST(Pose, ZoomForthAndBackEndsWhereItBegan) {
    test::Random random(3);
    for (int i = 0; i < 1000; ++i) {
        Pose pose;
        pose.zoom = random.whole(-600, 600);
        const Pose start = pose;
        const int levels = random.whole(1, 600);
        for (int step = 0; step < levels; ++step)
            zoom_towards(pose, 1, 0, 0);
        for (int step = 0; step < levels; ++step)
            zoom_towards(pose, -1, 0, 0);
        EXPECT_EQ(pose, start);
    }
}

TEST(Pose, ZoomTowardsThePointerKeepsWhatIsUnderIt) {
    test::Random random(4);
    double worst = 0;
    for (int i = 0; i < 100000; ++i) {
        Pose pose;
        pose.zoom = random.whole(-300, 300);
        pose.pan_x = random.whole(-(4 << 20), 4 << 20);
        pose.pan_y = random.whole(-(4 << 20), 4 << 20);
        const double x = random.in(-3, 3), y = random.in(-3, 3);
        // The point of the unscaled model under the pointer, in long double.
        const auto under = [&](const Pose& p, double pointer, std::int64_t pan) {
            return (static_cast<long double>(pointer) -
                    static_cast<long double>(pan) / kPanUnitsPerRadius) /
                   std::exp2(static_cast<long double>(p.zoom) / kZoomLevelsPerOctave);
        };
        const long double x0 = under(pose, x, pose.pan_x), y0 = under(pose, y, pose.pan_y);
        zoom_towards(pose, random.whole(-200, 200), x, y);
        // Where that point is now, against the pointer, in pan units.
        const long double scale =
            std::exp2(static_cast<long double>(pose.zoom) / kZoomLevelsPerOctave);
        const auto moved = [&](long double point, std::int64_t pan, double pointer) {
            return std::abs((point * scale - pointer) * kPanUnitsPerRadius + pan);
        };
        worst = std::max({worst, static_cast<double>(moved(x0, pose.pan_x, x)),
                          static_cast<double>(moved(y0, pose.pan_y, y))});
    }
    EXPECT_LE(worst, 1.0);
    RecordProperty("worst_pan_units_times_1000", static_cast<int>(worst * 1000));
}

TEST(Pose, AMillionRotationsLeaveAnOrthonormalBasis) {
    const geom::Mesh mesh = test::empty_mesh();
    Pose pose;
    test::Random random(5);
    for (int i = 0; i < 1000000; ++i) {
        pose.yaw = wrap_angle(std::int64_t{pose.yaw} + random.whole(-500, 500));
        pose.pitch = wrap_angle(std::int64_t{pose.pitch} + random.whole(-500, 500));
        pose.roll = wrap_angle(std::int64_t{pose.roll} + random.whole(-500, 500));
    }
    const auto view = make_view(mesh, {}, pose, {}, {}, 64, 64);
    ASSERT_TRUE(view);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            EXPECT_NEAR(dot3(view->linear[i], view->linear[j]), i == j ? 1 : 0, 1e-14);
}

} // namespace
} // namespace scanout::scene
