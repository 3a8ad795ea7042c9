// The level of detail against planes in long double (HARD-CASES 38, 39, P14).
#include "raster/screen/clip.h"
#include "shade/interpolate/footprint_levels.h"
#include "support/random.h"
#include "support/targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

namespace scanout::shade::test {
namespace {

using scanout::test::on_every_target;
using scanout::test::Random;

constexpr float kWidth = 512, kHeight = 2048; // texels
constexpr float kLimit = 32;

struct Vec {
    long double x, y, z;
};
Vec cross(const Vec& a, const Vec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
long double dot(const Vec& a, const Vec& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// value + dx x + dy y on the screen, about one sample; per pixel.
struct Linear {
    long double value, dx, dy;
};
// The level at that sample, of u = nu / d, v = nv / d.
double exact_level(const Linear& nu, const Linear& nv, const Linear& d) {
    const auto slope = [&](const Linear& n, long double n_slope, long double d_slope) {
        return (n_slope * d.value - n.value * d_slope) / (d.value * d.value);
    };
    const long double along_x =
        std::hypot(kWidth * slope(nu, nu.dx, d.dx), kHeight * slope(nv, nv.dx, d.dx));
    const long double along_y =
        std::hypot(kWidth * slope(nu, nu.dy, d.dy), kHeight * slope(nv, nv.dy, d.dy));
    const auto level = static_cast<double>(std::log2(std::max(along_x, along_y)));
    return std::clamp<double>(level, -kLimit, kLimit);
}

bool inside(const Primitive& t, const Sample& s) {
    bool all = true;
    for (int k = 0; k < 3; ++k)
        all = all && t.a[k] * s.x + t.b[k] * s.y + t.c[k] >= 0;
    return all;
}

// The worst error, on every target and in both widths, which give the same bits.
double worst_error(const Primitive& triangle, const std::vector<Sample>& samples,
                   const std::vector<double>& exact) {
    const std::vector<float> got = levels(false, triangle, kWidth, kHeight, samples);
    on_every_target([&](const std::string&) {
        for (const bool narrow : {false, true}) {
            const auto again = levels(narrow, triangle, kWidth, kHeight, samples);
            EXPECT_EQ(std::memcmp(again.data(), got.data(), got.size() * sizeof(float)), 0);
        }
    });
    double worst = 0;
    for (std::size_t i = 0; i < samples.size(); ++i)
        worst = std::max(worst, std::abs(double{got[i]} - exact[i]));
    return worst;
}

// --- triangles on the screen, as they are set up without clipping

struct OnScreen {
    std::array<std::int64_t, 3> x, y;
    Primitive primitive = {};

    std::int64_t area() const {
        return (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    }
    void set_weights() {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
            primitive.a[k] = static_cast<double>(y[i] - y[j]);
            primitive.b[k] = static_cast<double>(x[j] - x[i]);
            primitive.c[k] = static_cast<double>(x[i] * y[j] - x[j] * y[i]);
        }
    }
    // Of the plane through three values at the vertices.
    Linear plane(const std::array<long double, 3>& f, const Sample& s) const {
        const auto difference = [&](const auto& of, std::size_t k) {
            return static_cast<long double>(of[k] - of[0]);
        };
        const long double f1 = f[1] - f[0], f2 = f[2] - f[0];
        const auto twice = static_cast<long double>(area());
        const long double dx = (f1 * difference(y, 2) - f2 * difference(y, 1)) / twice;
        const long double dy = (f2 * difference(x, 1) - f1 * difference(x, 2)) / twice;
        return {f[0] + dx * static_cast<long double>(s.x - x[0]) +
                    dy * static_cast<long double>(s.y - y[0]),
                dx * 256, dy * 256};
    }
    double exact(const Sample& s) const {
        std::array<long double, 3> u{}, v{}, w{};
        for (std::size_t k = 0; k < 3; ++k) {
            w[k] = primitive.inverse_w[k];
            u[k] = w[k] * primitive.uv[0][k];
            v[k] = w[k] * primitive.uv[1][k];
        }
        return exact_level(plane(u, s), plane(v, s), plane(w, s));
    }
};

OnScreen random_triangle(Random& random, double w_ratio) {
    OnScreen t;
    const double size = std::exp2(random.in(9, 22));
    do {
        for (std::size_t k = 0; k < 3; ++k) {
            t.x[k] = static_cast<std::int64_t>(random.in(-size, size));
            t.y[k] = static_cast<std::int64_t>(random.in(-size, size));
        }
    } while (std::abs(t.area()) < 1000);
    if (t.area() < 0) {
        std::swap(t.x[1], t.x[2]);
        std::swap(t.y[1], t.y[2]);
    }
    t.set_weights();
    for (std::size_t k = 0; k < 3; ++k) {
        t.primitive.inverse_w[k] =
            static_cast<float>(std::exp2(-random.unit() * std::log2(w_ratio)));
        t.primitive.uv[0][k] = static_cast<float>(random.in(-4, 4));
        t.primitive.uv[1][k] = static_cast<float>(random.in(-4, 4));
    }
    return t;
}

TEST(Footprint, IsThatOfThePlaneInTrianglesOnTheScreen) {
    Random random(1);
    double worst = 0;
    int count = 0;
    for (int round = 0; round < 4000; ++round) {
        const OnScreen t = random_triangle(random, std::pow(10.0, random.in(0, 7)));
        std::vector<Sample> samples;
        std::vector<double> exact;
        for (int i = 0; i < 40; ++i) {
            double share[3];
            double sum = 0;
            for (double& s : share)
                sum += s = std::exp2(random.in(-20, 0)); // near vertices and edges too
            double x = 0, y = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                x += share[k] / sum * static_cast<double>(t.x[k]);
                y += share[k] / sum * static_cast<double>(t.y[k]);
            }
            const Sample s = {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
            if (!inside(t.primitive, s)) continue;
            samples.push_back(s);
            exact.push_back(t.exact(s));
        }
        count += static_cast<int>(samples.size());
        worst = std::max(worst, worst_error(t.primitive, samples, exact));
        ASSERT_LE(worst, 0x1p-8) << round;
    }
    EXPECT_GT(count, 100000);
    RecordProperty("worst", testing::PrintToString(worst));
}

// --- planes in space, clipped, up to the horizon

// A plane point + s u_axis + t v_axis before an eye at the origin that looks along -z; u = s, v =
// t.
struct InSpace {
    Vec point, u_axis, v_axis;
    long double focal = 900, centre_x = 960, centre_y = 540; // pixels

    Vec at(long double s, long double t) const {
        return {point.x + s * u_axis.x + t * v_axis.x, point.y + s * u_axis.y + t * v_axis.y,
                point.z + s * u_axis.z + t * v_axis.z};
    }
    raster::ClipVertex clip_vertex(const Vec& p) const {
        return {static_cast<double>(focal * p.x - centre_x * p.z),
                static_cast<double>(-focal * p.y - centre_y * p.z), 0, static_cast<double>(-p.z)};
    }
    // Where the ray of a sample meets the plane, by Cramer's rule.
    double exact(const Sample& sample) const {
        const Vec ray = {(static_cast<long double>(sample.x) / 256 - centre_x) / focal,
                         (centre_y - static_cast<long double>(sample.y) / 256) / focal, -1};
        const auto linear = [&](const Vec& normal) -> Linear { // normal . ray
            return {dot(normal, ray), normal.x / focal, -normal.y / focal};
        };
        return exact_level(linear(cross(v_axis, point)), linear(cross(point, u_axis)),
                           linear(cross(u_axis, v_axis)));
    }
};

InSpace random_plane(Random& random) {
    const auto vector = [&](double size) -> Vec {
        const DVec3 v = random.in_cube(size);
        return {v.x, v.y, v.z};
    };
    return {vector(3), vector(1), vector(1)};
}

// A triangle of the plane whose corners lie far away, some of them behind the eye.
Primitive far_triangle(const InSpace& plane, Random& random, std::array<Vec2, 3>& corner) {
    std::array<raster::ClipVertex, 3> vertex{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double angle = (static_cast<double>(k) + random.in(-0.4, 0.4)) * 2.0943951;
        const double far = std::exp2(random.in(2, 24));
        corner[k] = {static_cast<float>(far * std::cos(angle)),
                     static_cast<float>(far * std::sin(angle))};
        vertex[k] = plane.clip_vertex(plane.at(corner[k].x, corner[k].y));
    }
    // Not cut: the weights of the whole triangle, positive inside.
    const auto place = [&](std::size_t k) { return DVec3(vertex[k].x, vertex[k].y, vertex[k].w); };
    const double sign = dot3(place(0), cross3(place(1), place(2))) < 0 ? -1 : 1;
    Primitive t = {};
    t.clipped = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const DVec3 row = cross3(place((k + 1) % 3), place((k + 2) % 3)) * sign;
        t.a[k] = row.x / 256;
        t.b[k] = row.y / 256;
        t.c[k] = row.z;
        t.inverse_w[k] = 1;
        t.uv[0][k] = corner[k].x;
        t.uv[1][k] = corner[k].y;
    }
    return t;
}

TEST(Footprint, IsThatOfThePlaneUpToTheHorizonInClippedTriangles) {
    Random random(2);
    double worst = 0, highest = -kLimit;
    int count = 0;
    for (int round = 0; round < 20000; ++round) {
        const InSpace plane = random_plane(random);
        std::array<Vec2, 3> corner;
        const Primitive t = far_triangle(plane, random, corner);
        std::vector<Sample> samples;
        std::vector<double> exact;
        for (int i = 0; i < 40; ++i) {
            // Any distance along any direction in the plane.
            const double far = std::exp2(random.in(-3, 24)), angle = random.in(0, 6.2831853);
            const raster::ClipVertex p =
                plane.clip_vertex(plane.at(far * std::cos(angle), far * std::sin(angle)));
            if (p.w <= 0) continue;
            const double x = p.x / p.w * 256, y = p.y / p.w * 256;
            if (std::abs(x) > 0x1p23 || std::abs(y) > 0x1p23) continue;
            const Sample s = {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
            if (!inside(t, s)) continue;
            samples.push_back(s);
            exact.push_back(plane.exact(s));
            highest = std::max(highest, exact.back());
        }
        if (samples.empty()) continue;
        count += static_cast<int>(samples.size());
        worst = std::max(worst, worst_error(t, samples, exact));
        ASSERT_LE(worst, 0x1p-8) << round;
    }
    EXPECT_GT(count, 20000);
    EXPECT_EQ(highest, kLimit); // the horizon was reached
    RecordProperty("worst", testing::PrintToString(worst));
    RecordProperty("samples", count);
}

// --- examples and what has no footprint

// A square seen straight on: u and v run through 1 in `pixels` pixels.
Primitive straight_on(int pixels) {
    OnScreen t;
    t.x = {0, pixels * 256, 0};
    t.y = {0, 0, pixels * 256};
    t.set_weights();
    for (int k = 0; k < 3; ++k) {
        t.primitive.inverse_w[k] = 0.25F;
        t.primitive.uv[0][k] = k == 1 ? 1 : 0;
        t.primitive.uv[1][k] = k == 2 ? 1 : 0;
    }
    return t.primitive;
}

TEST(Footprint, OfOneTexelAPixelIsLevel0AndEveryDoublingIsOneMore) {
    const std::vector<Sample> samples = {{128, 128}, {1000, 3000}};
    for (int level = -8; level <= 8; ++level)
        for (const float got :
             levels(false, straight_on(256), std::ldexp(256.0F, level), 64, samples))
            EXPECT_NEAR(got, std::max(level, -2), 0x1p-20); // 64 texels in 256 pixels along v
}

TEST(Footprint, WithoutEndOrWithoutSizeIsTheLimit) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInf = std::numeric_limits<float>::infinity();
    const std::vector<Sample> samples = {{128, 128}, {-5, 7}, {1 << 23, -(1 << 23)}};
    const auto all_are = [&](const Primitive& t, float expected, const char* what) {
        on_every_target([&](const std::string&) {
            for (const float got : levels(false, t, 256, 256, samples))
                EXPECT_EQ(got, expected) << what;
        });
    };
    Primitive constant = straight_on(64);
    for (auto& f : constant.uv)
        f[0] = f[1] = f[2] = 0.3F;
    constant.a[0] = 1e6; // inside everywhere
    all_are(constant, -kLimit, "the same texel everywhere");
    all_are(Primitive{}, kLimit, "no weight at all: 0 / 0");
    for (const float odd : {kNaN, kInf, -kInf, 3e38F}) {
        Primitive t = straight_on(64);
        t.uv[0][1] = odd;
        all_are(t, kLimit, "coordinates without sense");
    }
}

} // namespace
} // namespace scanout::shade::test
