// Vectors of lane values against plain numbers, bit by bit: each result is the sequence of
// roundings that vec3-inl.h states, written out here once more.
#include "simd/vec3_operations.h"
#include "support/targets.h"

#include <cmath>
#include <cstring>
#include <random>

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

constexpr int kAxes = 3;

template <class Number>
const Number* component(const Vectors<Number>& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
template <class Number>
Number* component(Vectors<Number>& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

template <class Number>
Vec3Operands<Number> random_operands(std::mt19937& random) {
    Vec3Operands<Number> in{};
    std::uniform_real_distribution<float> unit(-1, 1);
    std::uniform_int_distribution<int> exponent(-6, 6);
    const auto number = [&] { return std::ldexp(unit(random), exponent(random)); };
    for (int n = 0; n < kMaxLanes; ++n) {
        for (int axis = 0; axis < kAxes; ++axis) {
            component(in.a, axis)[n] = Number{number()} + Number{number()} / 3;
            component(in.b, axis)[n] = Number{number()} + Number{number()} / 3;
        }
        in.s[n] = Number{number()};
    }
    for (int r = 0; r < kAxes; ++r) {
        in.row[r] = number();
        for (float& term : in.matrix[r])
            term = number();
    }
    in.plain = {number(), number(), number()};
    return in;
}

template <class Number>
void expect_same(Number got, Number want, const char* what, int lane) {
    EXPECT_EQ(std::memcmp(&got, &want, sizeof got), 0)
        << what << " in lane " << lane << ": " << got << " instead of " << want;
}

// want(axis): of a lane.
template <class Number, class Want>
void expect_vector(const Vectors<Number>& got, int lane, const char* what, Want want) {
    for (int axis = 0; axis < kAxes; ++axis)
        expect_same(component(got, axis)[lane], Number{want(axis)}, what, lane);
}

template <class Number>
void expect_lane(const Vec3Operands<Number>& in, const Vec3Results<Number>& got, int n) {
    const Number a[] = {in.a.x[n], in.a.y[n], in.a.z[n]}, b[] = {in.b.x[n], in.b.y[n], in.b.z[n]};
    const Number s = in.s[n];
    const auto sum_of_products = [](const auto(&p)[kAxes], const Number(&q)[kAxes]) {
        const Number first = Number{p[0]} * q[0], second = Number{p[1]} * q[1],
                     third = Number{p[2]} * q[2];
        const Number both = first + second;
        return both + third;
    };
    expect_vector(got.sum, n, "a + b", [&](int k) { return a[k] + b[k]; });
    expect_vector(got.difference, n, "a - b", [&](int k) { return a[k] - b[k]; });
    expect_vector(got.product, n, "a * b", [&](int k) { return a[k] * b[k]; });
    expect_vector(got.scaled, n, "a * s", [&](int k) { return a[k] * s; });
    expect_vector(got.sizes, n, "abs(a)", [&](int k) { return a[k] < 0 ? -a[k] : a[k]; });
    expect_vector(got.crossed, n, "cross(a, b)", [&](int k) {
        const int next = (k + 1) % kAxes, last = (k + 2) % kAxes;
        const Number gain = a[next] * b[last], loss = a[last] * b[next];
        return gain - loss;
    });
    expect_vector(got.selected, n, "select", [&](int k) { return a[0] < b[0] ? a[k] : b[k]; });
    expect_vector(got.normalised, n, "normalised", [&](int k) {
        const Number inverse = 1 / s;
        return s > 0 ? a[k] * inverse : b[k];
    });
    expect_vector(got.turned, n, "transformed",
                  [&](int k) { return sum_of_products(in.matrix[k], a); });
    expect_vector(got.of_row, n, "everywhere(row)", [&](int k) { return in.row[k]; });
    expect_vector(got.of_plain, n, "everywhere(plain)", [&](int k) {
        return k == 0 ? in.plain.x : k == 1 ? in.plain.y : in.plain.z;
    });
    expect_vector(got.splat, n, "splat(s)", [&](int) { return s; });
    expect_same(got.dot[n], sum_of_products(a, b), "dot(a, b)", n);
    expect_same(got.squared[n], sum_of_products(a, a), "length_squared(a)", n);
    expect_same(got.length[n], std::sqrt(sum_of_products(a, a)), "length(a)", n);
    const Number two = a[0] > a[1] ? a[0] : a[1];
    expect_same(got.greatest[n], two > a[2] ? two : a[2], "greatest(a)", n);
}

template <class Number, class Run>
void expect_all(Run run) {
    on_every_target([&](const std::string&) {
        std::mt19937 random(1);
        for (int round = 0; round < 1000 && !testing::Test::HasFailure(); ++round) {
            const auto in = random_operands<Number>(random);
            Vec3Results<Number> got{};
            run(in, got);
            ASSERT_GE(got.lanes, 4);
            for (int n = 0; n < got.lanes; ++n)
                expect_lane(in, got, n);
        }
    });
}

TEST(Vec3Lanes, OfFloatsGiveWhatPlainCodeGives) {
    expect_all<float>([](const auto& in, auto& out) { run_vec3(false, in, out); });
}

TEST(Vec3Lanes, OfAtMostEightFloatsGiveWhatPlainCodeGives) {
    expect_all<float>([](const auto& in, auto& out) { run_vec3(true, in, out); });
}

TEST(Vec3Lanes, OfDoublesGiveWhatPlainCodeGives) {
    expect_all<double>([](const auto& in, auto& out) { run_vec3(in, out); });
}

TEST(Vec3Lanes, MoveToAndFromArraysFromAnyLaneOn) {
    on_every_target([](const std::string&) {
        float from[3][kCopied];
        for (int axis = 0; axis < kAxes; ++axis)
            for (int i = 0; i < kCopied; ++i)
                from[axis][i] = static_cast<float>(100 * axis + i + 1);
        for (const int first : {0, 1, 13}) {
            float to[3][kCopied] = {};
            const int lanes = copy_vec3(from, first, to);
            for (int axis = 0; axis < kAxes; ++axis)
                for (int i = 0; i < kCopied; ++i) {
                    const bool copied = i >= first && i < first + lanes;
                    EXPECT_EQ(to[axis][i], copied ? from[axis][i] : 0.0F) << axis << " " << i;
                }
        }
    });
}

} // namespace
} // namespace scanout::test
