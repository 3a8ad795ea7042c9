// Keyframes by the formulas as books print them, in long double and on whole arrays, against ours;
// and spherical interpolation by the arc cosine, which gives no number where two keys are near to
// each other: rounding takes their cosine to 1 or above it.
#include "math/quaternion.h"
#include "math/transcendental.h"
#include "scene/motion/track.h"
#include "support/random.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::naive {
namespace {

using ::scanout::test::Random;
using scene::Interpolation;
using scene::Track;
using scene::TrackKeys;
using Long = long double;

struct Long4 {
    std::array<Long, 4> at{};
};

Long4 to_long(const DVec4& q) {
    return {{q.x, q.y, q.z, q.w}};
}
Long dot(const Long4& a, const Long4& b) {
    Long sum = 0;
    for (std::size_t i = 0; i < 4; ++i)
        sum += a.at[i] * b.at[i];
    return sum;
}
Long length(const Long4& a) {
    return std::sqrt(dot(a, a));
}
Long4 sum(Long s, const Long4& a, Long t, const Long4& b) {
    Long4 out;
    for (std::size_t i = 0; i < 4; ++i)
        out.at[i] = s * a.at[i] + t * b.at[i];
    return out;
}

// sin((1 - u) angle) / sin(angle) a + sin(u angle) / sin(angle) b, of exact unit length first.
Long4 exact_slerp(const DVec4& from, const DVec4& to, double u) {
    Long4 a = to_long(from), b = to_long(to);
    a = sum(1 / length(a), a, 0, a);
    b = sum((dot(a, b) < 0 ? -1 : 1) / length(b), b, 0, b);
    const Long angle = 2 * std::atan2(length(sum(1, b, -1, a)), length(sum(1, b, 1, a)));
    if (angle == 0) return a;
    return sum(std::sin((1 - Long(u)) * angle) / std::sin(angle), a,
               std::sin(Long(u) * angle) / std::sin(angle), b);
}

// The usual way.
DVec4 usual_slerp(const DVec4& a, DVec4 b, double u) {
    double cosine = dot4(a, b);
    if (cosine < 0) b = -b, cosine = -cosine;
    const double angle = std::acos(cosine);
    return a * (std::sin((1 - u) * angle) / std::sin(angle)) +
           b * (std::sin(u * angle) / std::sin(angle));
}

double error_of(const DVec4& got, const Long4& wanted) {
    double worst = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto error =
            static_cast<double>(std::abs(Long(got[static_cast<int>(i)]) - wanted.at[i]));
        if (!(error <= worst)) worst = error; // NaN as well
    }
    return worst;
}

DVec4 any_turn(Random& points) {
    DVec4 q;
    for (int i = 0; i < 4; ++i)
        q[i] = points.in(-1, 1);
    return unit_quaternion(q);
}

TEST(MotionOracle, RotationsGoTheShortWayHoweverNearTheyAre) {
    Random points(61);
    double worst = 0, off_length = 0;
    int usual_fails = 0;
    for (int i = 0; i < 200'000; ++i) {
        const DVec4 a = any_turn(points);
        DVec4 b = any_turn(points);
        if (i % 2 == 0) { // an angle from a degree down to nothing
            const double nearness = scanout::exp2(-points.in(5, 60));
            b = unit_quaternion(a + b * nearness);
            if (i % 4 == 0) b = -b;
        }
        const double u = points.unit();
        const Long4 wanted = exact_slerp(a, b, u);
        const DVec4 got = slerp(a, b, u);
        worst = std::max(worst, error_of(got, wanted));
        off_length = std::max(off_length, std::abs(std::sqrt(dot4(got, got)) - 1));
        usual_fails += error_of(usual_slerp(a, b, u), wanted) < 1e-9 ? 0 : 1; // NaN, mostly
    }
    RecordProperty("worst", testing::PrintToString(worst));
    EXPECT_LE(worst, 0x1p-50);
    EXPECT_LE(off_length, 0x1p-50);
    EXPECT_GT(usual_fails, 1000) << "the usual way is no worse";
}

TEST(MotionOracle, AQuarterTurnIsHalvedToAnEighth) {
    const DVec4 none = kNoTurn, quarter = quaternion_of_degrees({0, 90, 0});
    const DVec4 half = slerp(none, quarter, 0.5), eighth = quaternion_of_degrees({0, 45, 0});
    for (int i = 0; i < 4; ++i)
        EXPECT_NEAR(half[i], eighth[i], 0x1p-52);
    EXPECT_EQ(slerp(none, quarter, 0), none);
    EXPECT_EQ(slerp(quarter, quarter, 0.3), quarter);
    EXPECT_EQ(slerp(quarter, -quarter, 0.7), quarter) << "the same rotation";
}

// Keys of any track, and its value by the formulas: only what is between two keys.
struct Keys {
    std::vector<Long> time, value, in, out;
};
Long naive_hermite(const Keys& k, Long t) {
    std::size_t i = 0;
    while (k.time[i + 1] <= t)
        ++i;
    const Long d = k.time[i + 1] - k.time[i], s = (t - k.time[i]) / d, ss = s * s, sss = ss * s;
    return (2 * sss - 3 * ss + 1) * k.value[i] + d * (sss - 2 * ss + s) * k.out[i] +
           (-2 * sss + 3 * ss) * k.value[i + 1] + d * (sss - ss) * k.in[i + 1];
}
Long naive_linear(const Keys& k, Long t) {
    std::size_t i = 0;
    while (k.time[i + 1] <= t)
        ++i;
    const Long s = (t - k.time[i]) / (k.time[i + 1] - k.time[i]);
    return (1 - s) * k.value[i] + s * k.value[i + 1];
}
// Catmull and Rom's tangents, for keys at any times.
void put_tangents(Keys& k) {
    const std::size_t n = k.time.size();
    k.in.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = i > 0 ? i - 1 : 0, after = i + 1 < n ? i + 1 : i;
        k.in[i] = (k.value[after] - k.value[before]) / (k.time[after] - k.time[before]);
    }
    k.out = k.in;
}

TEST(MotionOracle, NumbersBetweenKeysAreThoseOfTheFormulas) {
    Random points(62);
    double worst = 0; // of the greatest number that stands in the formula
    for (int round = 0; round < 2000; ++round) {
        const auto count = static_cast<std::size_t>(2 + round % 7);
        for (const Interpolation by :
             {Interpolation::linear, Interpolation::hermite, Interpolation::spline}) {
            TrackKeys keys;
            keys.by = by;
            Keys naive;
            double time = points.unit(), greatest = 0;
            for (std::size_t i = 0; i < count; ++i, time += 0.01 + points.unit()) {
                keys.times.push_back(time);
                keys.values.push_back(points.in(-100, 100));
                keys.in.push_back(points.in(-100, 100));
                keys.out.push_back(points.in(-100, 100));
                naive.time.push_back(time);
                naive.value.push_back(keys.values.back());
                naive.in.push_back(keys.in.back());
                naive.out.push_back(keys.out.back());
            }
            if (by == Interpolation::spline) put_tangents(naive);
            for (std::size_t i = 0; i < count; ++i)
                for (const Long x : {naive.value[i], naive.in[i], naive.out[i]})
                    greatest = std::max(greatest, static_cast<double>(std::abs(x)));
            const Track track = *Track::create(keys);
            for (int i = 0; i < 50; ++i) {
                const double t = points.in(keys.times.front(), keys.times.back());
                double got = 0;
                track.at(t, {&got, 1});
                const Long wanted =
                    by == Interpolation::linear ? naive_linear(naive, t) : naive_hermite(naive, t);
                const auto error = static_cast<double>(std::abs(got - wanted));
                worst = std::max(worst, error / greatest);
            }
        }
    }
    RecordProperty("worst", testing::PrintToString(worst));
    EXPECT_LE(worst, 0x1p-50);
    EXPECT_GT(worst, 0);
}

} // namespace
} // namespace scanout::naive
