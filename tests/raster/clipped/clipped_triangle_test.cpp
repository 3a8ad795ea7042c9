// ClippedTriangles of triangles that have a vertex off the screen: coverage with every tie, depth,
// and what must not change a bit. That meshes of them are covered once: guard_test.cpp.
#include "oracle/plane.h"
#include "raster/clipped/clipped_triangle.h"
#include "raster/exact.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace scanout::raster::test {
namespace {

using oracle::Twofold;

constexpr int kClippedSide = 64;
constexpr double kNearW = 1;

// At (x / w, y / w) in 1/256 pixel.
struct WholePoint {
    std::int64_t x, y, w;
    bool snapped; // w is 1, a vertex on the screen
};
ExactPoint point_of(const WholePoint& p, double depth = 0.5) {
    if (p.snapped)
        return point_on_screen(
            {static_cast<std::int32_t>(p.x), static_cast<std::int32_t>(p.y), depth});
    const auto w = static_cast<double>(p.w);
    return point_off_screen(
        {static_cast<double>(p.x) / 256, static_cast<double>(p.y) / 256, depth * w, w});
}

// On which side of the line from p to q does a point lie that has moved by an infinitely small step
// to the right and a still smaller one down? 0: it is no line.
int side(const WholePoint& p, const WholePoint& q, std::int64_t x, std::int64_t y) {
    const Int128 a = Int128{p.y} * q.w - Int128{p.w} * q.y,
                 b = Int128{p.w} * q.x - Int128{p.x} * q.w,
                 c = Int128{p.x} * q.y - Int128{p.y} * q.x;
    for (const Int128 value : {a * x + b * y + c, a, b})
        if (value != 0) return value > 0 ? 1 : -1;
    return 0;
}

bool on_line(const WholePoint& p, const WholePoint& q, std::int64_t x, std::int64_t y) {
    return (Int128{p.y} * q.w - Int128{p.w} * q.y) * x +
               (Int128{p.w} * q.x - Int128{p.x} * q.w) * y + Int128{p.x} * q.y -
               Int128{p.y} * q.x ==
           0;
}

// Coarse: on pixel centres, so that edges run through samples all the time.
WholePoint any_point(Random& random, bool coarse) {
    const auto along = [&](int low, int high) {
        return coarse ? random.whole(low, high) * 1024 + 128
                      : random.whole(low * 1024, high * 1024);
    };
    if (random.whole(0, 2) == 0) return {along(-3, 19), along(-3, 19), 1, true};
    const int reach = 1 << random.whole(2, 16), w = 1 << random.whole(0, 6);
    if (coarse)
        return {std::int64_t{along(-reach, reach)} * w, std::int64_t{along(-reach, reach)} * w, w,
                false};
    return {along(-reach, reach), along(-reach, reach), random.whole(1, w), false};
}

TEST(ClippedTriangle, CoversWhatExactArithmeticSaysTiesIncluded) {
    Random random(1);
    VisibilityTile tile;
    std::int64_t inside = 0, ties = 0, none = 0;
    for (int i = 0; i < 3000; ++i) {
        std::array<WholePoint, 3> v{};
        for (WholePoint& p : v)
            p = any_point(random, i % 4 != 0);
        if (i % 60 == 0) v[2] = {v[0].x + v[1].x, v[0].y + v[1].y, v[0].w + v[1].w, false};
        const ClippedTriangles clipped =
            split_polygon(std::array{point_of(v[0]), point_of(v[1]), point_of(v[2])}, 0);
        none += clipped.count == 0 ? 1 : 0;
        const int samples = i % 8 == 0 ? 16 : 1;
        tile.reset({0, 0, kClippedSide, kClippedSide}, samples);
        for (const ClippedTriangle& triangle : clipped)
            tile.draw_clipped(triangle);
        for (int y = 0; y < kClippedSide; ++y)
            for (int x = 0; x < kClippedSide; ++x)
                for (int s = 0; s < samples; ++s) {
                    const SampleOffset at = tile.pattern()[static_cast<std::size_t>(s)];
                    const int px = x * 256 + at.x, py = y * 256 + at.y;
                    const int one = side(v[0], v[1], px, py), two = side(v[1], v[2], px, py),
                              three = side(v[2], v[0], px, py);
                    const bool covered = one != 0 && one == two && two == three;
                    ASSERT_EQ(tile.id(x, y, s) == 0, covered) << i << ": " << x << ' ' << y;
                    ASSERT_EQ(clipped.count > 0 && covers(clipped.triangle[0], px, py), covered)
                        << i;
                    inside += covered ? 1 : 0;
                    ties += covered && (on_line(v[0], v[1], px, py) ||
                                        on_line(v[1], v[2], px, py) || on_line(v[2], v[0], px, py))
                                ? 1
                                : 0;
                }
    }
    EXPECT_GT(inside, 500000);
    EXPECT_GT(ties, 2000);
    EXPECT_GE(none, 50);
    record("samples_inside", static_cast<double>(inside));
    record("samples_inside_on_an_edge", static_cast<double>(ties));
}

// An edge that passes a sample so closely that double is off by its whole bound of the error: what
// lanes cannot tell, whole numbers do.
TEST(ClippedTriangle, CoversNothingWhereDoubleIsOffByItsWholeBound) {
    constexpr std::int64_t kUnit = std::int64_t{1} << 23, kFar = std::int64_t{1} << 48,
                           kFarW = std::int64_t{1} << 40;
    const double depth = 0.5;
    const ExactPoint near{0, 0, kUnit, depth, depth},
        far{3 * kFar - 15, kFar + 17, kFarW, depth * (kFarW / kUnit), depth};
    VisibilityTile tile;
    std::array<int, std::size_t{kClippedSide} * kClippedSide> hits{};
    for (const ExactPoint& third : {ExactPoint{0, 64 * 256, kUnit, depth, depth},
                                    ExactPoint{64 * 256, 0, kUnit, depth, depth}}) {
        tile.reset({0, 0, kClippedSide, kClippedSide}, 1);
        const ClippedTriangles clipped = split_polygon(std::array{near, far, third}, 0);
        ASSERT_GT(clipped.count, 0);
        for (const ClippedTriangle& triangle : clipped)
            tile.draw_clipped(triangle);
        for (int y = 0; y < kClippedSide; ++y)
            for (int x = 0; x < kClippedSide; ++x) {
                bool covered = false;
                for (const ClippedTriangle& triangle : clipped)
                    covered |= covers(triangle, x * 256 + 128, y * 256 + 128);
                ASSERT_EQ(tile.id(x, y) == 0, covered) << x << ' ' << y;
                hits[static_cast<std::size_t>(y * kClippedSide + x)] += covered ? 1 : 0;
            }
    }
    EXPECT_EQ(std::count(hits.begin(), hits.end(), 2), 0); // on both sides of one edge
    EXPECT_GT(std::count(hits.begin(), hits.end(), 1), 1000);
}

// Depth at a sample: sum(E_i z_i) / sum(E_i w_i), of the clipped triangle's vertices.
Twofold twofold(Int128 v) {
    const auto high = static_cast<double>(v);
    return {high, static_cast<double>(v - static_cast<Int128>(high))};
}
Twofold exact_depth(const ClippedTriangle& clipped, std::int64_t x, std::int64_t y) {
    Twofold top, bottom;
    for (std::size_t i = 0; i < 3; ++i) {
        const ExactPoint &p = clipped.vertex[(i + 1) % 3], &q = clipped.vertex[(i + 2) % 3];
        const Int128 a = Int128{p.y} * q.w - Int128{p.w} * q.y,
                     b = Int128{p.w} * q.x - Int128{p.x} * q.w,
                     c = Int128{p.x} * q.y - Int128{p.y} * q.x;
        const Twofold e = twofold(a * x + b * y + (c << ExactPoint::kBits));
        top = top + e * Twofold(clipped.vertex[i].z);
        bottom = bottom + e * Twofold(static_cast<double>(clipped.vertex[i].w));
    }
    return top / bottom * Twofold(0x1p23);
}

// HARD-CASES 15, clipped: from vertices on the screen to vertices a million pixels away.
TEST(ClippedTriangle, HasDepthWithinTwoToTheMinus23OfItsPlane) {
    Random random(2);
    VisibilityTile tile;
    for (const double ratio : {1.0, 10.0, 1e3, 1e5, 1e7, 1e10}) {
        double worst = 0;
        int samples = 0;
        for (int i = 0; i < 3000; ++i) {
            std::array<ExactPoint, 3> v{};
            for (std::size_t k = 0; k < 3; ++k) {
                const double w = std::exp2(random.unit() * std::log2(ratio)) * kNearW;
                const double reach = std::exp2(random.in(5, 20));
                const double x = 32 + random.in(-reach, reach), y = 32 + random.in(-reach, reach);
                v[k] = point_off_screen({x * w, y * w, kNearW, w});
                if (random.whole(0, 2) == 0)
                    v[k] = point_on_screen(
                        {random.whole(-9999, 19999), random.whole(-9999, 19999), kNearW / w});
            }
            if (i % 3 == 0) { // a sliver over the whole tile
                const int x = random.whole(0, 16384), y = random.whole(0, 16384);
                v[0] = point_on_screen({x, y, kNearW});
                v[1] = point_on_screen(
                    {x + random.whole(-3, 3), y + random.whole(-3, 3), kNearW / ratio});
            }
            if (i % 3 == 1) { // through a sample, all of the depth within two steps of the grid
                const int x = random.whole(0, 63) * 256 + 128, y = random.whole(0, 63) * 256 + 128;
                const int reach = 1 << random.whole(2, 20);
                v[0] = point_on_screen({x - reach, y, kNearW / ratio});
                v[1] = point_on_screen({x + reach, y - random.whole(0, 1), kNearW / ratio});
                v[2] = point_on_screen({x, y + random.whole(1, 2), kNearW});
            }
            for (ClippedTriangle clipped : split_polygon(v, 0)) {
                tile.reset({0, 0, kClippedSide, kClippedSide}, i % 5 == 0 ? 8 : 1);
                tile.draw_clipped(clipped);
                for (int y = i % 3 == 2 ? i % 4 : 0; y < kClippedSide; y += i % 3 == 2 ? 4 : 1)
                    for (int x = 0; x < kClippedSide; ++x)
                        for (int s = 0; s < tile.samples(); ++s) {
                            if (tile.id(x, y, s) != 0) continue;
                            const SampleOffset at = tile.pattern()[static_cast<std::size_t>(s)];
                            const Twofold exact =
                                exact_depth(clipped, x * 256 + at.x, y * 256 + at.y);
                            worst =
                                std::max(worst, oracle::relative_error(tile.depth(x, y, s), exact));
                            ++samples;
                        }
            }
        }
        EXPECT_LE(worst, 1) << ratio;
        EXPECT_GT(samples, 100000);
        record("worst_in_2^-23_at_ratio_" + std::to_string(static_cast<long>(ratio)), worst);
    }
}

bool same_bits(const ClippedTriangle& a, const ClippedTriangle& b) {
    return std::equal(a.vertex.begin(), a.vertex.end(), b.vertex.begin(),
                      [](const ExactPoint& p, const ExactPoint& q) {
                          return p.x == q.x && p.y == q.y && p.w == q.w &&
                                 std::bit_cast<std::uint64_t>(p.z) ==
                                     std::bit_cast<std::uint64_t>(q.z) &&
                                 std::bit_cast<std::uint64_t>(p.depth) ==
                                     std::bit_cast<std::uint64_t>(q.depth);
                      }) &&
           a.flipped == b.flipped;
}

struct Cut {
    std::array<ClipVertex, 3> vertex{};
    std::array<ScreenVertex, 3> on_screen{};
    double near_w = kNearW;
    ClippedTriangles clipped() const { return clip_triangle(vertex, on_screen, near_w, 0); }
};
Cut any_cut(Random& random) {
    Cut cut;
    for (std::size_t k = 0; k < 3; ++k) {
        const double w = random.whole(0, 2) == 0 ? random.in(-9, 1) : std::exp2(random.in(0, 20));
        const double x = random.in(-99, 99), y = random.in(-99, 99);
        cut.vertex[k] = {x * w, y * w, kNearW, w};
        if (w >= kNearW && random.whole(0, 1) == 0)
            cut.on_screen[k] = {static_cast<std::int32_t>(std::nearbyint(x * 256)),
                                static_cast<std::int32_t>(std::nearbyint(y * 256)), kNearW / w};
    }
    return cut;
}

// Which vertex is named first changes nothing; the direction only reverses the winding.
TEST(ClippedTriangle, DoesNotDependOnTheOrderOfTheVerticesNorOnAScaleByAPowerOfTwo) {
    Random random(3);
    int two = 0;
    for (int i = 0; i < 20000; ++i) {
        const Cut cut = any_cut(random);
        const ClippedTriangles first = cut.clipped();
        two += first.count == 2 ? 1 : 0;
        const auto expect_same = [&](const ClippedTriangles& other, bool turned) {
            ASSERT_EQ(first.count, other.count) << i;
            for (const ClippedTriangle& a : first)
                ASSERT_TRUE(std::any_of(other.begin(), other.end(), [&](const ClippedTriangle& b) {
                    return same_bits(a, b) && (a.clockwise != b.clockwise) == turned;
                })) << i;
        };
        for (const std::array<std::size_t, 3> order :
             {std::array<std::size_t, 3>{1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}) {
            Cut other = cut;
            for (std::size_t k = 0; k < 3; ++k) {
                other.vertex[k] = cut.vertex[order[k]];
                other.on_screen[k] = cut.on_screen[order[k]];
            }
            expect_same(other.clipped(), (order[0] + 1) % 3 != order[1]);
        }
        for (const double scale : {0x1p-60, 0x1p-1, 0x1p7, 0x1p90}) {
            Cut other = cut;
            for (ClipVertex& v : other.vertex)
                v = {v.x * scale, v.y * scale, v.z * scale, v.w * scale};
            other.near_w *= scale;
            expect_same(other.clipped(), false);
        }
    }
    EXPECT_GT(two, 3000);
}

// Snapping may bend what is left of a triangle inwards; then there is one way only to cut it in
// two.
TEST(ClippedTriangle, OfABentPolygonLiesInsideIt) {
    Random random(4);
    int bent = 0;
    for (int i = 0; i < 20000; ++i) {
        std::array<WholePoint, 4> v{};
        for (std::size_t k = 0; k < 4; ++k) {
            constexpr int kCorner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
            v[k] = {kCorner[k][0] * 8192 + 4096 + random.whole(-6000, 6000),
                    kCorner[k][1] * 8192 + 4096 + random.whole(-6000, 6000), 1, true};
        }
        const auto turn = [&](std::size_t k) {
            const WholePoint &p = v[k], &q = v[(k + 1) % 4], &r = v[(k + 2) % 4];
            return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
        };
        const int inwards = (turn(0) < 0 ? 1 : 0) + (turn(1) < 0 ? 1 : 0) + (turn(2) < 0 ? 1 : 0) +
                            (turn(3) < 0 ? 1 : 0);
        if (inwards > 1) continue; // not simple
        bent += inwards;
        const ClippedTriangles clipped = split_polygon(
            std::array{point_of(v[0]), point_of(v[1]), point_of(v[2]), point_of(v[3])}, 0);
        for (const ClippedTriangle& triangle : clipped)
            ASSERT_TRUE(triangle.clockwise) << i;
    }
    EXPECT_GT(bent, 1000);
}

} // namespace
} // namespace scanout::raster::test
