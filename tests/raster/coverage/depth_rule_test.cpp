// What is seen under every depth test and in every format of depth is what a depth buffer keeps
// that is drawn into in the order of ids, whatever the order of drawing; and what each format
// loses.
#include "raster/clipped/clipped_triangle.h"
#include "raster/exact.h"
#include "rows.h"
#include "support/targets.h"

#include <algorithm>
#include <cmath>

namespace scanout::raster::test {
namespace {

constexpr image::Rect kRuleArea{0, 0, kTileSize, kTileSize};

std::vector<Triangle> rule_triangles(Random& random, int count) {
    std::vector<Triangle> triangles;
    while (triangles.size() < static_cast<std::size_t>(count)) {
        Corners v;
        for (Corner& c : v)
            c = {random.whole(-2000, 18000), random.whole(-2000, 18000)};
        if (!has_area(v)) continue;
        const double z = random.in(0.001, 1), steep = random.whole(0, 1);
        triangles.push_back(set_up(v, static_cast<std::uint32_t>(triangles.size()),
                                   {z, z * (1 - 0.5 * steep), z * (1 - 0.9 * steep)}));
    }
    // Some of them twice, with another id: ties at every sample.
    for (int i = 0; i < count / 4; ++i) {
        Triangle twin = triangles[static_cast<std::size_t>(i)];
        twin.id += 1000;
        triangles.push_back(twin);
    }
    return triangles;
}

struct Kept {
    float depth = 0;
    std::uint32_t id = kNoPrimitive;
    friend bool operator==(const Kept&, const Kept&) = default;
};

// A depth buffer as the textbooks have it: the test is asked as the triangles come.
bool passes(DepthTest test, float z, const Kept& old) {
    if (old.id == kNoPrimitive && test != DepthTest::equal && test != DepthTest::never) return true;
    switch (test) {
    case DepthTest::equal:
        return old.id != kNoPrimitive && z == old.depth;
    case DepthTest::not_equal:
        return z != old.depth;
    case DepthTest::always:
        return true;
    case DepthTest::never:
        return false;
    case DepthTest::greater:
        return z < old.depth;
    case DepthTest::greater_equal:
        return z <= old.depth;
    case DepthTest::less_equal:
        return z >= old.depth;
    case DepthTest::less:
        return z > old.depth;
    }
    return false;
}

// 1 - depth in the format, and back.
float in_format(float depth, const DepthFormatRow& format) {
    if (!format.standard) return depth;
    const double turned = 1.0 - static_cast<double>(depth);
    const double kept = format.steps > 0 ? std::nearbyint(turned * format.steps) / format.steps
                                         : static_cast<double>(static_cast<float>(turned));
    return static_cast<float>(1.0 - kept);
}

std::vector<Kept> planes(const VisibilityTile& tile) {
    std::vector<Kept> all;
    for (int s = 0; s < tile.samples(); ++s)
        for (int y = 0; y < kTileSize; ++y)
            for (int x = 0; x < kTileSize; ++x)
                all.push_back({tile.depth(x, y, s), tile.id(x, y, s)});
    return all;
}

TEST(DepthRule, IsThatOfADepthBufferInTheOrderOfIds) {
    Random random(1);
    const std::vector<Triangle> triangles = rule_triangles(random, 80);
    for (const int samples : {1, 4}) {
        // Coverage and depth of each, alone.
        std::vector<std::vector<Kept>> alone;
        for (const Triangle& t : triangles) {
            VisibilityTile tile;
            tile.reset(kRuleArea, samples);
            tile.draw(t);
            alone.push_back(planes(tile));
        }
        for (const DepthTestRow* test : raster::depth_test::kRows) {
            for (const DepthFormatRow* format : raster::depth::kRows) {
                std::vector<Kept> expected(alone[0].size());
                for (std::size_t i = 0; i < triangles.size(); ++i) {
                    for (std::size_t p = 0; p < expected.size(); ++p) {
                        if (alone[i][p].id == kNoPrimitive) continue;
                        const float z = in_format(alone[i][p].depth, *format);
                        if (passes(test->test, z, expected[p])) expected[p] = {z, triangles[i].id};
                    }
                }
                scanout::test::on_every_target([&](const std::string& target) {
                    std::vector<Triangle> order = triangles;
                    for (int round = 0; round < 2; ++round) {
                        VisibilityTile tile;
                        tile.reset(kRuleArea, samples,
                                   {test->test, format->standard, format->steps});
                        for (const Triangle& t : order)
                            tile.draw(t);
                        EXPECT_EQ(planes(tile), expected)
                            << test->card.name << ' ' << format->card.name << ' ' << target;
                        EXPECT_EQ(tile.empty(),
                                  test->test == DepthTest::equal || test->test == DepthTest::never);
                        if (tile.rule().wants_order()) break; // it depends on the order
                        for (std::size_t i = order.size() - 1; i > 0; --i)
                            std::swap(order[i], order[static_cast<std::size_t>(
                                                    random.whole(0, static_cast<int>(i)))]);
                    }
                });
            }
        }
    }
}

// A triangle that leaves the screen keeps the same rule.
TEST(DepthRule, HoldsForPiecesToo) {
    Random random(2);
    for (const DepthTestRow* test : raster::depth_test::kRows) {
        for (const DepthFormatRow* format : raster::depth::kRows) {
            for (int round = 0; round < 20; ++round) {
                std::array<ExactPoint, 3> corner;
                for (ExactPoint& p : corner) {
                    ScreenVertex v;
                    v.x = random.whole(-2000, 18000);
                    v.y = random.whole(-2000, 18000);
                    v.depth = random.in(0.01, 1);
                    p = point_on_screen(v);
                }
                const ClippedTriangles clipped = split_polygon(corner, 3);
                if (clipped.count == 0) continue;
                VisibilityTile alone, tile;
                alone.reset(kRuleArea, 2);
                alone.draw_clipped(clipped.triangle[0]);
                tile.reset(kRuleArea, 2, {test->test, format->standard, format->steps});
                tile.draw_clipped(clipped.triangle[0]);
                std::vector<Kept> expected = planes(alone);
                for (Kept& one : expected) {
                    const float z = in_format(one.depth, *format);
                    const bool shows = one.id != kNoPrimitive && passes(test->test, z, {});
                    one = shows ? Kept{z, 3} : Kept{};
                }
                EXPECT_EQ(planes(tile), expected) << test->card.name << ' ' << format->card.name;
            }
        }
    }
}

// Two squares one behind the other, the farther one first in the file: lost where it is seen. Near
// 0.1, distances up to 1e6 (HARD-CASES L2).
double lost(const DepthFormatRow& format, double gap) {
    constexpr int kPairs = 4000;
    constexpr double kNear = 0.1, kRatio = 1e7;
    Random random(3);
    int count = 0;
    VisibilityTile tile;
    for (int i = 0; i < kPairs; ++i) {
        const double w = kNear * std::pow(kRatio, random.unit() * 0.9999);
        const double depth[2] = {kNear / (w * (1 + gap)), kNear / w};
        tile.reset({0, 0, 8, 8}, 1, {DepthTest::less, format.standard, format.steps});
        for (std::uint32_t id = 0; id < 2; ++id)
            tile.draw(set_up({{{-512, -512}, {4096, -512}, {-512, 4096}}}, id,
                             {depth[id], depth[id], depth[id]}));
        count += tile.id(2, 2) == 0;
    }
    return 100.0 * count / kPairs;
}

TEST(DepthFormats, LoseTheShareOfPairsThatTheTableSays) {
    const double gaps[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6};
    struct Row {
        const char* name;
        double percent[5];
    };
    const Row table[] = {{"fixed_16", {54, 68, 82, 96, 100}},
                         {"fixed_24", {19, 33, 48, 62, 76}},
                         {"float_32", {19, 33, 48, 62, 76}},
                         {"reversed", {0, 0, 0, 0, 0}}};
    for (const Row& row : table) {
        const DepthFormatRow* format = find_row(raster::depth::kRows, row.name);
        ASSERT_NE(format, nullptr) << row.name;
        for (std::size_t i = 0; i < std::size(gaps); ++i) {
            const double got = lost(*format, gaps[i]);
            if (row.percent[i] == 0)
                EXPECT_EQ(got, 0) << row.name << ' ' << gaps[i];
            else
                EXPECT_NEAR(got, row.percent[i], 3) << row.name << ' ' << gaps[i];
        }
    }
}

// z' = (w - n)/(f - n) in 24 bits, from n to f = reach n [ClipSpace 4.2]; and the same in lanes.
TEST(DepthFormats, LinearKeepsTheDistanceInEvenSteps) {
    const DepthFormatRow& format = *find_row(raster::depth::kRows, "linear");
    ASSERT_TRUE(format.linear);
    Random random(5);
    for (const double reach : {2.0, 50.0, 40000.0}) {
        const DepthRule rule{DepthTest::less, format.standard, format.steps, reach};
        for (int i = 0; i < 3000; ++i) {
            const double w = 1 + (reach - 1) * random.unit();
            const auto depth = static_cast<float>(1 / w);
            const long double share = (1.0L / static_cast<long double>(depth) - 1) / (reach - 1.0L);
            const long double kept =
                std::nearbyint(std::clamp(share, 0.0L, 1.0L) * 16777215) / 16777215;
            const long double step = (reach - 1.0L) / 16777215;
            // A share in the middle between two steps may round either way.
            EXPECT_NEAR(static_cast<double>(1 / static_cast<long double>(rule.stored(depth))),
                        static_cast<double>(1 + kept * (reach - 1)),
                        static_cast<double>(step * 1e-3L + 1.2e-7L * w));
            EXPECT_NEAR(rule.step(1 / w), static_cast<double>(step) / (w * w), 1e-12);
        }
        EXPECT_EQ(rule.stored(1), 1.0F);
        EXPECT_EQ(rule.stored(2), 1.0F);
        EXPECT_EQ(rule.stored(static_cast<float>(0.5 / reach)), static_cast<float>(1 / reach));
        scanout::test::on_every_target([&](const std::string& target) {
            VisibilityTile tile;
            for (int i = 0; i < 300; ++i) {
                const double depth = 1 / (1 + (reach - 1) * random.unit());
                tile.reset({0, 0, 8, 8}, 1, rule);
                tile.draw(
                    set_up({{{-512, -512}, {4096, -512}, {-512, 4096}}}, 0, {depth, depth, depth}));
                EXPECT_EQ(tile.depth(2, 2), rule.stored(static_cast<float>(depth))) << target;
            }
        });
    }
}

// What the caller cuts off passes no test, and is never seen.
TEST(DepthRule, CutsAreOfEveryTest) {
    for (const DepthTestRow* test : raster::depth_test::kRows)
        for (const double depth : {0.1, 0.3, 0.7}) {
            DepthRule rule{test->test};
            rule.farthest = 0.2F;
            rule.nearest = 0.5F;
            EXPECT_FALSE(rule.is_default());
            scanout::test::on_every_target([&](const std::string& target) {
                VisibilityTile tile;
                tile.reset({0, 0, 8, 8}, 4, rule);
                tile.draw(
                    set_up({{{-512, -512}, {4096, -512}, {-512, 4096}}}, 0, {depth, depth, depth}));
                EXPECT_EQ(tile.empty(), depth != 0.3 || !test->shows)
                    << test->card.name << ' ' << depth << ' ' << target;
            });
        }
}

// The near plane cuts at 1/16384 of the distance to the target. What stands behind the target by
// less than this share of its distance may not be told apart from it.
TEST(DepthFormats, HaveStepsAroundTheTargetOfTheSharesThatTheirCardsSay) {
    const auto share = [](const char* name) {
        const DepthFormatRow& format = *find_row(raster::depth::kRows, name);
        const DepthRule rule{DepthTest::less, format.standard, format.steps};
        const auto kept = [&](double distance) {
            return rule.stored(static_cast<float>(0x1p-14 / distance));
        };
        double worst = 0; // the widest step that touches the target's neighbourhood
        for (double from = 0.75; from < 1.25;) {
            double to = from;
            while (kept(to) == kept(from))
                to += from * 0x1p-22;
            worst = std::max(worst, (to - from) / from);
            from = to;
            if (to - from < 0x1p-14) from *= 1.01;
        }
        return worst;
    };
    EXPECT_GT(share("fixed_16"), 0.2);
    EXPECT_LT(share("fixed_16"), 0.4);
    EXPECT_NEAR(share("fixed_24"), 0.001, 0.0003);
    EXPECT_NEAR(share("float_32"), 0.001, 0.0003);
    EXPECT_LT(share("reversed"), 1e-6);
}

} // namespace
} // namespace scanout::raster::test
