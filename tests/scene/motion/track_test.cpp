#include "math/bits.h"
#include "math/oracle.h"
#include "math/quaternion.h"
#include "scene/motion/track.h"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::scene {
namespace {

using test::Points;
using testing::HasSubstr;

TrackKeys keys_of(std::vector<double> times, std::vector<double> values,
                  Interpolation by = Interpolation::linear) {
    TrackKeys keys;
    keys.by = by;
    keys.times = std::move(times);
    keys.values = std::move(values);
    return keys;
}

double at(const Track& track, double seconds) {
    double value = 0;
    track.at(seconds, {&value, 1});
    return value;
}
double at(const TrackKeys& keys, double seconds) {
    return at(*Track::create(keys), seconds);
}

TEST(Track, PassesThroughItsKeysAndStaysBeyondThem) {
    for (const Interpolation by :
         {Interpolation::step, Interpolation::linear, Interpolation::spline}) {
        const std::vector<double> times = {0.1, 0.7, 1.9, 2}, values = {0.1, -3, 1e9, 5};
        const TrackKeys keys = keys_of(times, values, by);
        for (std::size_t i = 0; i < times.size(); ++i)
            EXPECT_EQ(at(keys, times[i]), values[i]) << "to the bit";
        EXPECT_EQ(at(keys, 0), 0.1);
        EXPECT_EQ(at(keys, -1e300), 0.1);
        EXPECT_EQ(at(keys, 1e300), 5);
    }
}

TEST(Track, AConstantIsConstantToTheBit) {
    Points points(63);
    for (const Interpolation by : {Interpolation::linear, Interpolation::spline}) {
        const double value = points.uniform(-1, 1);
        const TrackKeys keys = keys_of({0, 0.3, 1}, {value, value, value}, by);
        for (int i = 0; i < 1000; ++i)
            ASSERT_EQ(at(keys, points.unit()), value);
    }
}

TEST(Track, AStepHoldsUntilTheNextKey) {
    const TrackKeys keys = keys_of({0, 1}, {4, 8}, Interpolation::step);
    EXPECT_EQ(at(keys, std::nextafter(1.0, 0.0)), 4);
    EXPECT_EQ(at(keys, 1), 8);
}

TEST(Track, OneKeyHoldsAlwaysAndKeysWithoutDurationJump) {
    for (const bool loops : {false, true})
        for (const Interpolation by :
             {Interpolation::step, Interpolation::linear, Interpolation::spline}) {
            TrackKeys one = keys_of({2}, {7}, by);
            one.loops = loops;
            TrackKeys at_once = keys_of({0, 0, 0}, {1, 2, 3}, by);
            at_once.loops = loops;
            TrackKeys jump = keys_of({0, 1, 1, 2}, {0, 0, 5, 5}, by);
            jump.loops = loops;
            for (const double t : {-3.0, 0.0, 1.0, 2.0, 3.0}) {
                EXPECT_EQ(at(one, t), 7) << t;
                EXPECT_EQ(at(at_once, t), t < 0 ? 1 : 3) << t;
            }
            EXPECT_EQ(at(jump, std::nextafter(1.0, 0.0)), 0);
            EXPECT_EQ(at(jump, 1), 5);
            EXPECT_EQ(at(jump, 1.5), 5) << "no curve reaches over the jump";
        }
}

TEST(Track, ALoopBeginsAgain) {
    TrackKeys keys = keys_of({0, 2}, {0, 8});
    keys.loops = true;
    for (const double t : {0.0, 2.0, 4.0, -2.0, 2e15})
        EXPECT_EQ(at(keys, t), 0) << t;
    for (const double t : {0.5, 2.5, -1.5, 1000000.5})
        EXPECT_EQ(at(keys, t), 2) << t;
    for (const double t : {1e300, -1e300, 1e-300})
        EXPECT_LT(at(keys, t), 8) << t;
}

TEST(Track, AWrappedTimeIsTheRemainder) {
    Points points(64);
    for (int i = 0; i < 100'000; ++i) {
        const double period = points.any_size(-10, 10), t = points.any_size(-30, 30);
        const double got = wrapped_time(t, std::abs(period));
        EXPECT_GE(got, 0);
        EXPECT_LT(got, std::abs(period));
        double wanted = std::fmod(t, std::abs(period));
        if (wanted < 0) wanted += std::abs(period);
        // Right below the period and at 0 are one place.
        const double off = std::abs(got - wanted);
        EXPECT_LE(std::min(off, std::abs(period) - off), std::abs(period) * 0x1p-52) << t;
    }
    EXPECT_EQ(wrapped_time(5, 0), 0);
    EXPECT_EQ(wrapped_time(-1e-300, 1), 0) << "what rounds to the period is its beginning";
    EXPECT_EQ(wrapped_time(3, 1.5), 0);
    EXPECT_EQ(wrapped_time(kInfinity, 1), 0);
    EXPECT_EQ(wrapped_time(kNaN, 1), 0);
}

TEST(Track, EasingBeginsAndEndsWhereItShouldAndNeverTurnsBack) {
    for (const Easing easing : {Easing::none, Easing::in, Easing::out, Easing::in_out}) {
        EXPECT_EQ(eased(easing, 0), 0);
        EXPECT_EQ(eased(easing, 1), 1);
        double last = 0;
        for (int i = 1; i <= 1000; ++i) {
            const double now = eased(easing, i / 1000.0);
            EXPECT_GT(now, last);
            last = now;
        }
    }
    EXPECT_EQ(eased(Easing::in, 0.5), 0.25);
    EXPECT_EQ(eased(Easing::out, 0.5), 0.75);
    EXPECT_EQ(eased(Easing::in_out, 0.25), 0.15625);
    TrackKeys keys = keys_of({0, 1, 2}, {0, 1, 2});
    keys.easings = {Easing::in, Easing::none, Easing::none};
    EXPECT_EQ(at(keys, 0.5), 0.25);
    EXPECT_EQ(at(keys, 1.5), 1.5) << "of the first way alone";
}

// The slopes on both sides of a key are equal.
TEST(Track, ASplineIsSmoothAlsoWhereALoopCloses) {
    TrackKeys keys = keys_of({0, 0.4, 1, 2}, {1, -2, 3, 1}, Interpolation::spline);
    keys.loops = true;
    const Track track = *Track::create(keys);
    constexpr double kStep = 0x1p-20;
    for (const double t : {0.4, 1.0, 2.0, 4.0}) {
        const double before = (at(track, t) - at(track, t - kStep)) / kStep;
        const double after = (at(track, t + kStep) - at(track, t)) / kStep;
        EXPECT_NEAR(before, after, 1e-3) << t;
    }
    EXPECT_NEAR((at(track, kStep) - 1) / kStep, (1 - at(track, 2 - kStep)) / kStep, 1e-3);
}

TEST(Track, ASplineThroughALineIsTheLine) {
    const TrackKeys keys = keys_of({0, 0.5, 3, 4}, {0, 1, 6, 8}, Interpolation::spline);
    for (double t = 0; t < 4; t += 0.01)
        EXPECT_NEAR(at(keys, t), 2 * t, 1e-14);
}

TrackKeys turns(const std::vector<DVec4>& quaternions, Interpolation by) {
    TrackKeys keys;
    keys.width = 4;
    keys.quaternions = true;
    keys.by = by;
    for (const DVec4& q : quaternions) {
        keys.times.push_back(static_cast<double>(keys.times.size()));
        for (int i = 0; i < 4; ++i)
            keys.values.push_back(q[i]);
    }
    return keys;
}
DVec4 turn_at(const TrackKeys& keys, double seconds) {
    double q[4];
    Track::create(keys)->at(seconds, q);
    return {q[0], q[1], q[2], q[3]};
}

TEST(Track, RotationsStayOfUnitLengthWhateverTheFileSays) {
    Points points(65);
    for (const Interpolation by : {Interpolation::step, Interpolation::linear, Interpolation::slerp,
                                   Interpolation::spline, Interpolation::hermite}) {
        std::vector<DVec4> all = {{0, 0, 0, 0}, {0, 0, 0, 1e-310}, {1e200, 0, 0, 1e200}};
        for (int i = 0; i < 20; ++i)
            all.emplace_back(points.uniform(-1, 1), points.uniform(-1, 1), points.uniform(-1, 1),
                             points.uniform(-1, 1));
        TrackKeys keys = turns(all, by);
        keys.loops = true;
        keys.in.assign(keys.values.size(), 0.3);
        keys.out.assign(keys.values.size(), -0.3);
        for (double t = 0; t < 23; t += 0.0625)
            EXPECT_NEAR(dot4(turn_at(keys, t), turn_at(keys, t)), 1, 1e-15) << t;
        EXPECT_EQ(turn_at(keys, 0), kNoTurn) << "length 0 turns nothing";
    }
}

// -q is the rotation q: no detour.
TEST(Track, ASignOfAQuaternionChangesNoRotation) {
    const DVec4 a = kNoTurn, b = quaternion_of_degrees({0, 30, 0}),
                c = quaternion_of_degrees({0, 80, 10});
    for (const Interpolation by : {Interpolation::slerp, Interpolation::spline})
        for (double t = 0; t < 3; t += 0.125) {
            TrackKeys one = turns({a, b, c, a}, by), other = turns({a, -b, c, -a}, by);
            one.loops = other.loops = true;
            EXPECT_NEAR(std::abs(dot4(turn_at(one, t), turn_at(other, t))), 1, 1e-15) << t;
        }
}

TEST(Track, WhatCannotBeRightIsRefusedWithTheKey) {
    const auto error_of = [](const TrackKeys& keys) {
        const Result<Track> track = Track::create(keys);
        return track ? std::string() : track.error().what;
    };
    EXPECT_THAT(error_of(keys_of({}, {})), HasSubstr("no keys"));
    EXPECT_THAT(error_of(keys_of({0, 2, 1}, {0, 0, 0})), HasSubstr("key 2 is at 1 s, after 2 s"));
    EXPECT_THAT(error_of(keys_of({-1}, {0})), HasSubstr("begin at 0"));
    EXPECT_THAT(error_of(keys_of({kNaN}, {0})), HasSubstr("key 0"));
    EXPECT_THAT(error_of(keys_of({0, kInfinity}, {0, 0})), HasSubstr("key 1"));
    EXPECT_THAT(error_of(keys_of({0, 1}, {0})), HasSubstr("1 numbers for 2 keys"));
    EXPECT_THAT(error_of(keys_of({0}, {kNaN})), HasSubstr("not finite"));
    EXPECT_THAT(error_of(keys_of({0}, {0}, Interpolation::hermite)), HasSubstr("tangents"));
}

// Kept values: g++ and clang++, x86-64 and Arm. Where one must change, say in the commit which
// pictures change with it.
TEST(Track, SamplesKeepTheirBits) {
    std::uint64_t hash = 0xcbf29ce484222325;
    const auto add = [&](double x) {
        hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x100000001b3;
        hash ^= hash >> 32;
    };
    Points points(66);
    for (const Interpolation by : {Interpolation::step, Interpolation::linear, Interpolation::slerp,
                                   Interpolation::spline, Interpolation::hermite})
        for (int round = 0; round < 200; ++round) {
            TrackKeys keys;
            keys.by = by;
            keys.loops = round % 2 == 0;
            keys.quaternions = by == Interpolation::slerp || round % 3 == 0;
            keys.width = keys.quaternions ? 4 : 3;
            double time = 0;
            for (int i = 0; i < 2 + round % 5; ++i) {
                keys.times.push_back(time);
                time += points.unit();
                keys.easings.push_back(static_cast<Easing>(i % 4));
                for (std::size_t k = 0; k < keys.width; ++k) {
                    keys.values.push_back(points.uniform(-2, 2));
                    keys.in.push_back(points.uniform(-2, 2));
                    keys.out.push_back(points.uniform(-2, 2));
                }
            }
            const Track track = *Track::create(keys);
            double out[4];
            for (int i = 0; i < 50; ++i) {
                track.at(points.uniform(-1, 2 * time), std::span(out).first(keys.width));
                for (std::size_t k = 0; k < keys.width; ++k)
                    add(out[k]);
            }
        }
    EXPECT_EQ(hash, 2612830475600419798U);
}

} // namespace
} // namespace scanout::scene
