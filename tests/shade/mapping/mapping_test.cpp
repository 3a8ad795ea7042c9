// Coordinates made from the place on the model, and their slopes, against long double; at the seam
// and at the poles nothing is without end.
#include "rows.h"
#include "shade/block.h"

#include <array>
#include <cmath>
#include <functional>

namespace scanout::shade::test {
namespace {

using Real = long double;
constexpr Real kTurn = 6.283185307179586476925287L;
constexpr int kUsed = kBlockSize - 8; // runs of one lane write a register of eight

struct Uv {
    Real u, v;
};
struct Point {
    Real x, y, z;
};

// What the file of each says, by the library's functions.
Uv sphere(const Point& p) {
    return {0.5L + std::atan2(p.x, p.z) / kTurn,
            0.5L + std::atan2(p.y, std::hypot(p.x, p.z)) / (kTurn / 2)};
}
Uv cylinder(const Point& p) {
    return {0.5L + std::atan2(p.x, p.z) / kTurn, 0.5L + p.y / 2};
}
Uv plane(const Point& p) {
    return {0.5L + p.x / 2, 0.5L + p.y / 2};
}

// A triangle on the screen with places on the model.
struct Triangle {
    std::array<std::int64_t, 3> x{}, y{};
    Primitive primitive = {};

    static Triangle random(Random& random, double size) {
        Triangle t;
        const auto area = [&] {
            return (t.x[1] - t.x[0]) * (t.y[2] - t.y[0]) - (t.x[2] - t.x[0]) * (t.y[1] - t.y[0]);
        };
        do {
            for (std::size_t k = 0; k < 3; ++k) {
                t.x[k] = random.whole(-(1 << 14), 1 << 14);
                t.y[k] = random.whole(-(1 << 14), 1 << 14);
            }
        } while (area() < 1 << 20);
        const DVec3 middle = random.in_cube(0.6);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
            t.primitive.a[k] = static_cast<double>(t.y[i] - t.y[j]);
            t.primitive.b[k] = static_cast<double>(t.x[j] - t.x[i]);
            t.primitive.c[k] = static_cast<double>(t.x[i] * t.y[j] - t.x[j] * t.y[i]);
            t.primitive.inverse_w[k] = static_cast<float>(random.in(0.1, 1));
            const DVec3 p = middle + random.in_cube(size);
            for (int c = 0; c < 3; ++c)
                t.primitive.object[c][k] = static_cast<float>(p[c]);
        }
        const DVec3 n = random.in_cube(1);
        for (int c = 0; c < 3; ++c)
            t.primitive.facing[c] = static_cast<float>(n[c]);
        return t;
    }
    // px, py: 1/256 pixel.
    Point at(Real px, Real py) const {
        Real top[3] = {}, bottom = 0;
        for (int k = 0; k < 3; ++k) {
            const Real weight =
                (Real(primitive.a[k]) * px + Real(primitive.b[k]) * py + Real(primitive.c[k])) *
                Real(primitive.inverse_w[k]);
            bottom += weight;
            for (int c = 0; c < 3; ++c)
                top[c] += weight * Real(primitive.object[c][k]);
        }
        return {top[0] / bottom, top[1] / bottom, top[2] / bottom};
    }
};

struct MappedPoint {
    explicit MappedPoint(Random& random, double size = 0.3) {
        for (int i = 0; i < kUsed; ++i) {
            triangle[static_cast<std::size_t>(i)] = Triangle::random(random, size);
            const Triangle& t = triangle[static_cast<std::size_t>(i)];
            double share[3], sum = 0;
            for (double& s : share)
                sum += s = random.in(0.05, 1);
            double px = 0, py = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                px += share[k] / sum * static_cast<double>(t.x[k]);
                py += share[k] / sum * static_cast<double>(t.y[k]);
            }
            block->x[i] = static_cast<std::int32_t>(px);
            block->y[i] = static_cast<std::int32_t>(py);
            block->run[i] = {&t.primitive, i, 1};
        }
        block->count = block->runs = kUsed;
        frame.attributes.uv = frame.attributes.footprint = frame.attributes.object = true;
        frame.mapped = true;
        frame.source = find_row(shade::source::kRows, "checker"); // something reads them
    }
    void run(const char* name) { run_stage("mapping", name, *block, frame); }
    Point point(int i, Real dx = 0, Real dy = 0) const {
        return triangle[static_cast<std::size_t>(i)].at(block->x[i] + dx * 256,
                                                        block->y[i] + dy * 256);
    }
    scene::Material material;
    std::array<Triangle, kBlockSize> triangle;
    std::unique_ptr<ShadingBlock> block = new_block(material);
    FrameState frame = identity_frame();
};

// Turns between, the short way.
Real apart(Real a, Real b) {
    const Real d = a - b;
    return d - std::round(d);
}

TEST(Mapping, GivesTheCoordinatesAndSlopesOfThePlaceItself) {
    Random random(1);
    const std::pair<const char*, std::function<Uv(const Point&)>> mappings[] = {
        {"sphere", sphere}, {"cylinder", cylinder}, {"plane", plane}};
    for (const auto& mapping : mappings) {
        const auto& exact = mapping.second;
        Real worst = 0, worst_slope = 0;
        for (int round = 0; round < 100; ++round) {
            MappedPoint m(random);
            m.run(mapping.first);
            for (int i = 0; i < kUsed; ++i) {
                const Point p = m.point(i);
                const Real near = std::hypot(p.x, p.z);
                if (near < 0.02L) continue; // towards the axis everything grows
                const Uv here = exact(p);
                worst = std::max({worst, std::abs(apart(m.block->u[i], here.u)),
                                  std::abs(m.block->v[i] - here.v)});
                const Real h = 1e-4L;
                const auto slope = [&](Real dx, Real dy, float u, float v) {
                    const Uv before = exact(m.point(i, -dx, -dy)),
                             after = exact(m.point(i, dx, dy));
                    const Real du = apart(after.u, before.u) / (2 * h),
                               dv = (after.v - before.v) / (2 * h);
                    const Real size = std::max({std::abs(du), std::abs(dv), Real(1e-3)});
                    worst_slope = std::max({worst_slope, std::abs(du - u) / size * near,
                                            std::abs(dv - v) / size * near});
                };
                slope(h, 0, m.block->u_x[i], m.block->v_x[i]);
                slope(0, h, m.block->u_y[i], m.block->v_y[i]);
            }
        }
        EXPECT_LT(worst, 4e-6L) << mapping.first;
        EXPECT_LT(worst_slope, 1e-4L) << mapping.first;
    }
}

TEST(Mapping, HasFiniteSlopesOnTheAxisAndAcrossTheSeam) {
    Random random(2);
    for (const char* name : {"sphere", "cylinder"}) {
        for (int round = 0; round < 50; ++round) {
            MappedPoint m(random, 0.3);
            for (int i = 0; i < kUsed; ++i) {
                // All on the axis, or a face through it, or just beside the seam.
                auto& object = m.triangle[static_cast<std::size_t>(i)].primitive.object;
                for (int k = 0; k < 3; ++k) {
                    if (round % 3 == 0) object[0][k] = object[2][k] = 0;
                    if (round % 3 == 1) object[0][k] = 0;
                    if (round % 3 == 2) {
                        object[0][k] *= 1e-3F;
                        object[2][k] = -0.5F;
                    }
                }
            }
            m.run(name);
            for (int i = 0; i < kUsed; ++i) {
                ASSERT_TRUE(m.block->u[i] >= 0 && m.block->u[i] <= 1) << name;
                ASSERT_TRUE(m.block->v[i] >= 0 && m.block->v[i] <= 1) << name;
                for (const float* slope : {m.block->u_x, m.block->v_x, m.block->u_y, m.block->v_y})
                    ASSERT_TRUE(std::isfinite(slope[i]));
                if (round % 3 != 2) continue;
                // No steeper than the place moves, half a unit from the axis: no turn at the seam.
                const auto most = [&](Real dx, Real dy) {
                    const Real h = 1e-4L;
                    const Point from = m.point(i), to = m.point(i, h * dx, h * dy);
                    return std::hypot(to.x - from.x, to.y - from.y, to.z - from.z) / h /
                               (kTurn / 2 * 0.5L) * 1.01L +
                           1e-5L;
                };
                ASSERT_LE(std::abs(m.block->u_x[i]), most(1, 0)) << name;
                ASSERT_LE(std::abs(m.block->v_x[i]), most(1, 0)) << name;
                ASSERT_LE(std::abs(m.block->u_y[i]), most(0, 1)) << name;
                ASSERT_LE(std::abs(m.block->v_y[i]), most(0, 1)) << name;
            }
        }
    }
}

TEST(Mapping, BoxTakesTheSideThatTheTriangleFacesAndMirrorsNone) {
    Random random(3);
    MappedPoint m(random);
    const struct {
        Vec3 facing;
        Vec3 u, v; // directions in which they grow: a turn over two units
    } sides[] = {{{0, 0.1F, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0.1F, -1}, {-1, 0, 0}, {0, 1, 0}},
                 {{1, 0.5F, 0}, {0, 0, -1}, {0, 1, 0}}, {{-1, 0, 0.5F}, {0, 0, 1}, {0, 1, 0}},
                 {{0.2F, 1, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, -1, 0.5F}, {1, 0, 0}, {0, 0, 1}}};
    for (const auto& side : sides) {
        // Right-handed with the normal: text reads from left to right.
        EXPECT_GT(dot3(cross3(side.u, side.v), side.facing), 0);
        for (Triangle& t : m.triangle)
            for (int c = 0; c < 3; ++c)
                t.primitive.facing[c] = side.facing[c];
        m.run("box");
        for (int i = 0; i < kUsed; ++i) {
            const Point p = m.point(i);
            const auto along = [&](const Vec3& d) {
                return 0.5L + (p.x * d.x + p.y * d.y + p.z * d.z) / 2;
            };
            ASSERT_NEAR(m.block->u[i], along(side.u), 1e-6);
            ASSERT_NEAR(m.block->v[i], along(side.v), 1e-6);
        }
    }
}

// Snapping may leave a sample beside a clipped triangle: then its weights say nothing.
TEST(Mapping, OfASampleThatNoWeightIsLeftForLiesWithinItsTriangle) {
    Random random(4);
    for (const char* name : {"plane", "box", "cylinder", "sphere"}) {
        MappedPoint m(random);
        for (Triangle& t : m.triangle) {
            t.primitive.clipped = true;
            for (int k = 0; k < 3; ++k) {
                t.primitive.a[k] = t.primitive.b[k] = 0;
                t.primitive.c[k] = -1;
            }
        }
        m.run(name);
        for (int i = 0; i < kUsed; ++i) {
            ASSERT_TRUE(m.block->u[i] >= 0 && m.block->u[i] <= 1) << name;
            ASSERT_TRUE(m.block->v[i] >= 0 && m.block->v[i] <= 1) << name;
            for (const float* slope : {m.block->u_x, m.block->v_x, m.block->u_y, m.block->v_y})
                ASSERT_TRUE(std::isfinite(slope[i])) << name;
        }
    }
}

} // namespace
} // namespace scanout::shade::test
