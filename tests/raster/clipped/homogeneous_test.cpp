// Clipped triangles against an oracle that never clips: HARD-CASES 5, 8, 10, 12; and whole scenes
// against one that looks at every triangle at every sample.
#include "oracle/visibility.h"
#include "raster/exact.h"

#include <algorithm>
#include <cmath>

namespace scanout::raster::test {
namespace {

using oracle::ClipPoint;
using oracle::HomogeneousTriangle;
using oracle::Place;

// An edge whose ends are snapped by up to 1/512 pixel in x and y passes within this of where it
// was.
constexpr double kSnapDistance = 1.0 / 256;

// Pixels times w of a point in view space, in double.
ClipPoint<double> projected_point(const scene::View& view, int width, int height,
                                  const Vec3& position) {
    const double x = position.x + view.translation.x, y = position.y + view.translation.y,
                 w = -(position.z + view.translation.z);
    return {(x / view.half_width + w) * (width / 2.0), (w - y / view.half_height) * (height / 2.0),
            w};
}

// HARD-CASES 8: any vertex before, on, or behind the eye's plane.
TEST(Homogeneous, TrianglesThroughTheEyesPlaneCoverWhatTheirEdgesSay) {
    constexpr int kWidth = 60, kHeight = 40;
    const scene::View view = eye_view(0.6, 0.4, 0);
    Jobs jobs(1);
    Random random(4);
    std::int64_t covered = 0, close = 0, behind = 0, wrong = 0;
    for (int i = 0; i < 12000; ++i) {
        const double size = std::exp2(random.in(-3, 12));
        std::array<Vec3, 3> v;
        for (Vec3& p : v) {
            p = Vec3(random.in_cube(size));
            if (i % 8 == 0 && random.bits() % 2 == 0) p.z = 0; // w = 0
            if (i % 8 == 1) p.z = static_cast<float>(-std::exp2(random.in(-40, -8)));
        }
        behind += v[0].z >= 0 || v[1].z >= 0 || v[2].z >= 0 ? 1 : 0;
        geom::Mesh mesh;
        add_triangle(mesh, v);
        const Planes planes = draw_planes(jobs, mesh, view, kWidth, kHeight);
        const HomogeneousTriangle<double> exact(projected_point(view, kWidth, kHeight, v[0]),
                                                projected_point(view, kWidth, kHeight, v[1]),
                                                projected_point(view, kWidth, kHeight, v[2]),
                                                view.near_distance);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const Place place = exact.place(x + 0.5, y + 0.5, kSnapDistance);
                close += place == Place::close ? 1 : 0;
                if (place == Place::close) continue;
                wrong += (planes.id(x, y) == 0) != (place == Place::inside) ? 1 : 0;
                covered += place == Place::inside ? 1 : 0;
            }
        ASSERT_EQ(wrong, 0) << i;
    }
    EXPECT_GT(covered, 1000000);
    EXPECT_GT(behind, 8000);
    EXPECT_LT(close, covered / 20);
    record("mismatches_beyond_1/256_px", static_cast<double>(wrong));
    record("samples_covered", static_cast<double>(covered));
    record("samples_closer", static_cast<double>(close));
}

// HARD-CASES 6: the finite part, up to a sixteenth of the largest float, beside vertices of
// ordinary size. (Two vertices seen in the same direction to 50 bits are one point to the renderer:
// random ones never are.)
TEST(Homogeneous, CoordinatesUpToTheLargestFloatsCoverWhatTheirEdgesSay) {
    constexpr int kWidth = 60, kHeight = 40;
    const scene::View view = eye_view(0.6, 0.4, 0);
    Jobs jobs(1);
    Random random(16);
    std::int64_t covered = 0, close = 0, wrong = 0, huge = 0;
    for (int i = 0; i < 12000; ++i) {
        std::array<Vec3, 3> v;
        int large = 0;
        for (Vec3& p : v) {
            const double log_size = random.in(i % 3 == 0 ? 90 : -20, 124);
            large += log_size > 100 ? 1 : 0; // above 1e30
            p = Vec3(random.in_cube(std::exp2(log_size)));
        }
        huge += large > 0 ? 1 : 0;
        geom::Mesh mesh;
        add_triangle(mesh, v);
        const Planes planes = draw_planes(jobs, mesh, view, kWidth, kHeight);
        const HomogeneousTriangle<double> exact(projected_point(view, kWidth, kHeight, v[0]),
                                                projected_point(view, kWidth, kHeight, v[1]),
                                                projected_point(view, kWidth, kHeight, v[2]),
                                                view.near_distance);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const Place place = exact.place(x + 0.5, y + 0.5, kSnapDistance);
                close += place == Place::close ? 1 : 0;
                if (place == Place::close) continue;
                wrong += (planes.id(x, y) == 0) != (place == Place::inside) ? 1 : 0;
                covered += place == Place::inside ? 1 : 0;
            }
        ASSERT_EQ(wrong, 0) << i;
    }
    EXPECT_GT(covered, 1000000);
    EXPECT_GT(huge, 5000);
    EXPECT_LT(close, covered / 20);
    record("mismatches_beyond_1/256_px", static_cast<double>(wrong));
    record("samples_covered", static_cast<double>(covered));
    record("triangles_above_1e30", static_cast<double>(huge));
}

// HARD-CASES 10: external triangles, in whole numbers. View space is a grid of 1/64; the picture
// has 64 pixels across two units at distance 1, so pixels times w are whole numbers of 1/64, and
// samples whole numbers of half pixels.
TEST(Homogeneous, ExternalTrianglesCoverWhatExactArithmeticSays) {
    constexpr int kSide = 64;
    const scene::View view = eye_view(1, 1, 0, 1.0 / 64);
    Jobs jobs(1);
    Random random(5);
    std::int64_t covered = 0, close = 0, external = 0;
    double worst = 0;
    for (int i = 0; i < 8000; ++i) {
        std::array<Vec3, 3> v;
        std::array<ClipPoint<Int128>, 3> p;
        const int reach = 1 << (4 + i % 14);
        int in_front = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const int x = random.whole(-reach, reach), y = random.whole(-reach, reach),
                      w = random.whole(-reach, reach);
            v[k] = Vec3(static_cast<float>(x) / 64, static_cast<float>(y) / 64,
                        -static_cast<float>(w) / 64);
            // Half pixels times w, in 1/64: 2 * (32 x + 32 w)
            p[k] = {64 * (Int128{x} + w), 64 * (Int128{w} - y), Int128{w}};
            in_front += w > 0 ? 1 : 0;
        }
        external += in_front == 1 || in_front == 2 ? 1 : 0;
        geom::Mesh mesh;
        add_triangle(mesh, v);
        const Planes planes = draw_planes(jobs, mesh, view, kSide, kSide);
        const HomogeneousTriangle<Int128> exact(p[0], p[1], p[2], 1, 2);
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const Int128 sx = 2 * x + 1, sy = 2 * y + 1;
                const Place place = exact.place(sx, sy, 1e-12);
                const bool drawn = planes.id(x, y) == 0;
                covered += drawn ? 1 : 0;
                if (place != Place::close && drawn == (place == Place::inside)) continue;
                // How far from an edge or cut is a sample that differs?
                double far = 1e-12;
                while (far < 1 && exact.place(sx, sy, far) != Place::close)
                    far *= 1.25;
                ++close;
                worst = std::max(worst, far);
            }
    }
    EXPECT_LE(worst, kSnapDistance * 1.25);
    EXPECT_GT(covered, 1000000);
    EXPECT_GT(external, 4000);
    record("worst_displacement_px", worst);
    record("samples_that_differ", static_cast<double>(close));
}

bool beyond_guard(const Corner& c) {
    return std::max(std::abs(c.x), std::abs(c.y)) > kGuardPixels * kSubpixel;
}

// Corners up to 2^log_size pixels about the picture, on a grid that a float holds: 24 bits.
Corners far_corners(Random& random, int log_size, int side) {
    const int coarse = std::max(0, log_size + 8 - 23);
    Corners v;
    for (Corner& c : v) {
        // From 2^15 on some corners stay near, so that one edge, two or none leave the guard band.
        const int log_reach = log_size >= 15 && random.bits() % 4 == 0 ? 13 : log_size;
        const int reach = 1 << (log_reach + 8 - coarse);
        c = {random.whole(-reach, reach) * (1 << coarse),
             random.whole(-reach, reach) * (1 << coarse)};
        if (log_size < 7) c = {c.x + side * 128, c.y + side * 128};
    }
    return v;
}

// HARD-CASES 5: from one pixel to two million, within the guard band and far beyond it.
TEST(Homogeneous, TrianglesFarLargerThanTheScreenAreExact) {
    constexpr int kSide = 64;
    Jobs jobs(1);
    Random random(6);
    std::int64_t partly = 0; // triangles with one corner beyond the guard band
    for (int log_size = 0; log_size <= 21; ++log_size) {
        std::int64_t wrong = 0, covered = 0;
        for (int i = 0; i < 500; ++i) {
            const Corners v = far_corners(random, log_size, kSide);
            const int samples = i % 5 == 0 ? 4 : 1;
            std::array<Vec3, 3> position;
            for (std::size_t k = 0; k < 3; ++k) {
                position[k] = Vec3(static_cast<float>(v[k].x) / 256,
                                   static_cast<float>(kSide - v[k].y / 256.0), 0.5F);
                ASSERT_EQ(kSide - static_cast<double>(position[k].y), v[k].y / 256.0);
            }
            geom::Mesh mesh;
            add_triangle(mesh, position);
            const Planes planes =
                draw_planes(jobs, mesh, pixel_view(kSide, kSide), kSide, kSide, samples);
            const ExactTriangle exact(v);
            for (int s = 0; s < samples; ++s) {
                const SampleOffset at = sample_pattern(samples)[static_cast<std::size_t>(s)];
                for (int y = 0; y < kSide; ++y) {
                    auto e = exact.at(at.x, y * 256 + at.y);
                    for (int x = 0; x < kSide; ++x, exact.step_right(e)) {
                        const bool inside = exact.inside(e);
                        covered += inside ? 1 : 0;
                        wrong += (planes.id(x, y, s) == 0) != inside ? 1 : 0;
                    }
                }
            }
            partly += std::count_if(v.begin(), v.end(), beyond_guard) == 1 ? 1 : 0;
        }
        EXPECT_EQ(wrong, 0) << "2^" << log_size << " pixels";
        EXPECT_GT(covered, log_size < 3 ? 20 : 500);
        record("mismatches_at_2^" + std::to_string(log_size), static_cast<double>(wrong));
    }
    EXPECT_GT(partly, 200);
}

// A grid of triangles on a plane in space, and where a ray meets it.
struct PlaneOfTriangles {
    static constexpr int kCells = 16;
    DVec3 origin, right, up; // right, up: one cell
    std::vector<Vec3> vertex;

    PlaneOfTriangles(Random& random, double cell) {
        const auto unit = [](const DVec3& v) { return v / std::sqrt(dot3(v, v)); };
        const DVec3 n = unit(random.in_cube(1));
        right = unit(cross3(n, random.in_cube(1))) * cell;
        up = cross3(n, right);
        origin = n * (0.01 * random.in(0.3, 3)) + right * random.in(-5, 5) + up * random.in(-5, 5);
        for (int j = 0; j <= kCells; ++j)
            for (int i = 0; i <= kCells; ++i)
                vertex.emplace_back(origin + right * (i - 8 + random.in(-0.2, 0.2)) +
                                    up * (j - 8 + random.in(-0.2, 0.2)));
    }
    // Where the ray (x, y, -1) meets the plane: in cells from the middle, and w.
    struct Hit {
        double u, v, w;
    };
    Hit meet(double x, double y) const {
        const DVec3 n = cross3(right, up), ray(x, y, -1);
        const double w = dot3(n, origin) / dot3(n, ray);
        const DVec3 hit = ray * w - origin;
        return {dot3(hit, right) / dot3(right, right), dot3(hit, up) / dot3(up, up), w};
    }
    template <class F>
    void each_triangle(F&& f) const {
        for (std::size_t j = 0; j < kCells; ++j)
            for (std::size_t i = 0; i < kCells; ++i) {
                const std::size_t a = j * (kCells + 1) + i, b = a + 1, c = b + kCells + 1,
                                  d = c - 1;
                f(std::array{vertex[a], vertex[b], vertex[c]});
                f(std::array{vertex[c], vertex[d], vertex[a]});
            }
    }
};

// HARD-CASES 12, P1: planes through the eye's neighbourhood, so that the mesh straddles near, the
// eye's plane and every side of the guard band; triangles are drawn one by one and counted.
TEST(Homogeneous, AMeshThatStraddlesEveryPlaneOfTheFrustumIsCoveredOnce) {
    constexpr int kSide = 48;
    const scene::View view = eye_view(0.5, 0.5, 0);
    Jobs jobs(1);
    Random random(7);
    std::int64_t once = 0, cut[5] = {};
    for (int round = 0; round < 400; ++round) {
        const PlaneOfTriangles plane(random, 0.003 * std::exp2(random.in(0, 17)));
        std::vector<int> hits(std::size_t{kSide} * kSide);
        plane.each_triangle([&](const std::array<Vec3, 3>& v) {
            // Which planes does it cross? Left, right, top, bottom of the guard band, near.
            int outside[5] = {};
            for (const Vec3& p : v) {
                const ClipPoint<double> c = projected_point(view, kSide, kSide, p);
                const double guard = kGuardPixels * c.w;
                const bool out[5] = {c.x<-guard, c.x> guard, c.y<-guard, c.y> guard,
                                     c.w < view.near_distance};
                for (int k = 0; k < 5; ++k)
                    outside[k] += out[k] ? 1 : 0;
            }
            for (int k = 0; k < 5; ++k)
                cut[k] += outside[k] == 1 || outside[k] == 2 ? 1 : 0;
            geom::Mesh mesh;
            add_triangle(mesh, v);
            const Planes planes = draw_planes(jobs, mesh, view, kSide, kSide);
            const std::uint32_t* id = planes.ids.data(); // 472 million times in all
            for (int& hit : hits)
                if (*id++ == 0) ++hit;
        });
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const auto ray = [&](double px, double py) {
                    return plane.meet((px + 0.5) / kSide - 0.5, 0.5 - (py + 0.5) / kSide);
                };
                const auto here = ray(x, y), right = ray(x + 1, y), down = ray(x, y + 1);
                // Towards the horizon cells become smaller than the grid of 1/256 pixel, and
                // snapping folds them: no rasteriser that snaps can count them once.
                const double cells =
                    std::max({std::abs(right.u - here.u), std::abs(right.v - here.v),
                              std::abs(down.u - here.u), std::abs(down.v - here.v)});
                if (cells > 8 || here.w * right.w < 0 || here.w * down.w < 0) continue;
                const double in =
                    PlaneOfTriangles::kCells / 2.0 - std::max(std::abs(here.u), std::abs(here.v));
                const int count =
                    hits[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)];
                const double near = here.w / view.near_distance;
                ASSERT_LE(count, 1) << round << ": " << x << ' ' << y;
                ASSERT_TRUE(in < 0.5 || near < 1.2 || count == 1) << round << ": " << x << ' ' << y;
                ASSERT_TRUE((in > -0.5 && near > 0.8) || count == 0)
                    << round << ": " << x << ' ' << y;
                once += count;
            }
    }
    EXPECT_GT(once, 100000);
    constexpr const char* kName[] = {"left", "right", "top", "bottom", "near"};
    for (std::size_t k = 0; k < 5; ++k) {
        EXPECT_GT(cut[k], 50) << kName[k];
        record(std::string("triangles_across_") + kName[k], static_cast<double>(cut[k]));
    }
    record("samples_covered_once", static_cast<double>(once));
}

// Whole scenes, hidden surfaces included: what is seen at every sample where the oracle can tell.
TEST(Homogeneous, WhatIsSeenOfASceneIsWhatIsNearestAtEverySample) {
    constexpr int kWidth = 90, kHeight = 70;
    Jobs jobs(2);
    Random random(8);
    std::int64_t told = 0, untold = 0, wrong = 0;
    for (int round = 0; round < 24; ++round) {
        const scene::View view = eye_view(0.5, 0.4, round % 3 == 0 ? 0.01 : 1.2);
        const double size = round % 3 == 0 ? 5 : 0.9, part = round % 2 == 0 ? 0.3 : 1;
        const int samples = round % 4 == 3 ? 4 : 1;
        geom::Mesh mesh;
        oracle::ExactScene scene(view.near_distance);
        for (int t = 0; t < 150; ++t) {
            const DVec3 middle = random.in_cube(size);
            std::array<Vec3, 3> v;
            for (Vec3& p : v)
                p = Vec3(middle + random.in_cube(size * part));
            add_triangle(mesh, v);
            scene.add(projected_point(view, kWidth, kHeight, v[0]),
                      projected_point(view, kWidth, kHeight, v[1]),
                      projected_point(view, kWidth, kHeight, v[2]));
        }
        const Planes planes = draw_planes(jobs, mesh, view, kWidth, kHeight, samples);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                for (int s = 0; s < samples; ++s) {
                    const SampleOffset at = sample_pattern(samples)[static_cast<std::size_t>(s)];
                    const auto seen = scene.seen(x + at.x / 256.0, y + at.y / 256.0);
                    (seen ? told : untold) += 1;
                    wrong += seen && *seen != planes.id(x, y, s) ? 1 : 0;
                }
        ASSERT_EQ(wrong, 0) << round;
    }
    EXPECT_LT(untold, told / 10);
    record("samples_compared", static_cast<double>(told));
    record("samples_too_close_to_tell", static_cast<double>(untold));
    record("wrong", static_cast<double>(wrong));
}

} // namespace
} // namespace scanout::raster::test
