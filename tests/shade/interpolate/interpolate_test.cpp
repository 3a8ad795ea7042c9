#include "shade/block.h"

#include <cmath>
#include <limits>

namespace scanout::shade::test {
namespace {

constexpr int kVertices = 3 * kBlockSize; // three of its own a lane

struct Attributes3 {
    std::vector<Vec3> normal{kVertices}, colour{kVertices};
    std::vector<Vec2> uv{kVertices};
};

// What a lane interpolates: exact areas and distances, as doubles; the block gets them rounded.
struct ExactLane {
    double area[3], inverse_w[3];
};

double exact(const ExactLane& lane, double f0, double f1, double f2) {
    // f = sum(b f / w) / sum(b / w) with 64 bits of mantissa; every product of doubles is
    // rounded by 2^-64 and nothing cancels in the weights.
    const double f[3] = {f0, f1, f2};
    long double top = 0, bottom = 0;
    for (int k = 0; k < 3; ++k) {
        const long double weight = static_cast<long double>(lane.area[k]) * lane.inverse_w[k];
        top += weight * f[k];
        bottom += weight;
    }
    return static_cast<double>(top / bottom);
}

ExactLane random_lane(Random& random, double w_ratio, int kind) {
    ExactLane lane{};
    for (int k = 0; k < 3; ++k) {
        // Areas as the rasteriser gives them: whole numbers up to 2^49, sometimes 0 (on an edge).
        lane.area[k] = std::floor(std::exp2(random.in(0, 49)));
        lane.inverse_w[k] = 1 / std::exp2(random.unit() * std::log2(w_ratio));
    }
    lane.inverse_w[0] = 1; // the whole ratio
    lane.inverse_w[2] = 1 / w_ratio;
    if (kind % 4 == 1) lane.area[kind / 4 % 3] = 0;
    if (kind % 4 == 2) lane.area[kind / 4 % 3] = lane.area[(kind / 4 + 1) % 3] = 0;
    return lane;
}

class Interpolation : public testing::Test {
protected:
    // Every lane a triangle of its own, whose weights are the same everywhere.
    void run(Random& random, double w_ratio, int round) {
        block->runs = kBlockSize;
        for (int i = 0; i < kBlockSize; ++i) {
            lane[i] = random_lane(random, w_ratio, round * kBlockSize + i);
            Primitive& t = primitive[i];
            for (int k = 0; k < 3; ++k) {
                t.c[k] = lane[i].area[k];
                t.inverse_w[k] = static_cast<float>(lane[i].inverse_w[k]);
                const auto vertex = static_cast<std::size_t>(3 * i + k);
                t.uv[0][k] = data.uv[vertex].x;
                t.uv[1][k] = data.uv[vertex].y;
                for (int c = 0; c < 3; ++c) {
                    t.normal[c][k] = data.normal[vertex][c];
                    t.colour[c][k] = data.colour[vertex][c];
                }
            }
            block->run[i] = {&t, i, 1};
        }
        frame.attributes = {
            .normal = true, .uv = true, .colour = true, .maps = bit_of(kDiffuseMap)};
        block->map[kDiffuseMap] = {&texture, material.map_diffuse.operator->()};
        stage("interpolate", "perspective").run(*block, frame);
    }
    scene::Material material = scanout::test::plain(Vec3(1));
    scene::Texture texture = scanout::test::checkers();
    std::unique_ptr<ShadingBlock> block = new_block(material);
    FrameState frame = identity_frame();
    Attributes3 data;
    ExactLane lane[kBlockSize];
    Primitive primitive[kBlockSize] = {};
};

TEST_F(Interpolation, IsWithinTwoToTheMinusTwentyOfTheRangeAtEveryRatioOfDistances) {
    Random random(1);
    for (const double ratio : {1.0, 10.0, 1e3, 1e6}) {
        double worst = 0;
        for (int round = 0; round < 1000; ++round) {
            for (Vec2& uv : data.uv)
                uv = {static_cast<float>(random.in(-4, 4)), static_cast<float>(random.in(0, 1))};
            for (Vec3& c : data.colour)
                c = {random.in(0, 1), random.in(0, 1e-3), random.in(0, 1e6)};
            run(random, ratio, round);
            for (int i = 0; i < kBlockSize; ++i) {
                const auto check = [&](float got, float f0, float f1, float f2) {
                    const double range = std::max({f0, f1, f2}) - std::min({f0, f1, f2});
                    const double error = std::abs(got - exact(lane[i], f0, f1, f2));
                    // The attribute itself is a float: half its last place is no one's fault.
                    const double size = std::max({std::abs(f0), std::abs(f1), std::abs(f2)});
                    worst = std::max(worst, (error - size * 0x1p-24) / range * 0x1p20);
                };
                const Vec2* uv = &data.uv[static_cast<std::size_t>(3 * i)];
                const Vec3* c = &data.colour[static_cast<std::size_t>(3 * i)];
                check(block->u[i], uv[0].x, uv[1].x, uv[2].x);
                check(block->v[i], uv[0].y, uv[1].y, uv[2].y);
                for (int k = 0; k < 3; ++k)
                    check(block->albedo[k][i], c[0][k], c[1][k], c[2][k]);
            }
        }
        EXPECT_LE(worst, 1) << ratio;
        RecordProperty("worst_ratio_" + std::to_string(static_cast<int>(ratio)),
                       testing::PrintToString(worst));
    }
}

TEST_F(Interpolation, NeverLeavesTheRangeOfItsVertices) {
    Random random(2);
    for (int round = 0; round < 2000; ++round) {
        for (Vec2& uv : data.uv) {
            uv = {static_cast<float>(random.in(-4, 4)), random.bits() % 2 == 0 ? 0.0F : 1.0F};
            if (random.bits() % 8 == 0) uv.x = static_cast<float>(random.in(-1, 1) * 1e30);
        }
        run(random, round % 2 == 0 ? 1 : 1e6, round);
        for (int i = 0; i < kBlockSize; ++i) {
            const Vec2* uv = &data.uv[static_cast<std::size_t>(3 * i)];
            ASSERT_LE(block->u[i], std::max({uv[0].x, uv[1].x, uv[2].x}));
            ASSERT_GE(block->u[i], std::min({uv[0].x, uv[1].x, uv[2].x}));
            ASSERT_LE(block->v[i], 1);
            ASSERT_GE(block->v[i], 0);
        }
    }
}

TEST_F(Interpolation, KeepsWhatIsConstantAndTheValueAtAVertex) {
    Random random(3);
    for (int round = 0; round < 500; ++round) {
        const auto value = static_cast<float>(random.in(-1e3, 1e3));
        for (Vec2& uv : data.uv)
            uv = {value, static_cast<float>(random.in(-1, 1))};
        run(random, 1e4, round);
        for (int i = 0; i < kBlockSize; ++i) {
            ASSERT_EQ(block->u[i], value);
            const ExactLane& l = lane[i];
            for (int k = 0; k < 3; ++k) {
                const bool corner = l.area[(k + 1) % 3] == 0 && l.area[(k + 2) % 3] == 0;
                const float there = data.uv[static_cast<std::size_t>(3 * i + k)].y;
                ASSERT_TRUE(!corner || std::abs(block->v[i] - there) <= 0x1p-22F) << i;
            }
        }
    }
}

TEST_F(Interpolation, NormalsAreUnitAndOnTheWayThatWeightsSay) {
    Random random(4);
    double worst = 0;
    for (int round = 0; round < 200; ++round) {
        for (std::size_t i = 0; i < kBlockSize; ++i) {
            const DVec3 towards = random.in_cube(1);
            for (int k = 0; k < 3; ++k)
                primitive[i].facing[k] = static_cast<float>(towards[k]);
            for (std::size_t k = 0; k < 3; ++k) {
                DVec3 n = random.in_cube(1);
                if (round % 5 == 0) n = n * 1e-3; // not even near unit length
                data.normal[3 * i + k] = Vec3(n);
            }
            if (round % 10 == 1) // opposite normals cancel
                data.normal[3 * i + 1] = data.normal[3 * i + 2] = -data.normal[3 * i];
        }
        const double angle = random.in(0, 3), s = std::sin(angle), c = std::cos(angle);
        const float turn[3][3] = {{static_cast<float>(c), 0, static_cast<float>(s)},
                                  {0, 1, 0},
                                  {static_cast<float>(-s), 0, static_cast<float>(c)}};
        std::copy(&turn[0][0], &turn[0][0] + 9, &frame.normal_matrix[0][0]);
        run(random, 1, round);
        for (int i = 0; i < kBlockSize; ++i) {
            const double x = block->normal[0][i], y = block->normal[1][i], z = block->normal[2][i];
            worst = std::max(worst, std::abs(std::sqrt(x * x + y * y + z * z) - 1));
            double sum[3] = {};
            const Vec3* n = &data.normal[static_cast<std::size_t>(3 * i)];
            for (int axis = 0; axis < 3; ++axis)
                sum[axis] = exact(lane[i], n[0][axis], n[1][axis], n[2][axis]);
            const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
            if (length < 1e-4) continue;
            const double tolerance = 1e-6 / length;
            ASSERT_NEAR(x, (turn[0][0] * sum[0] + turn[0][2] * sum[2]) / length, tolerance);
            ASSERT_NEAR(y, sum[1] / length, tolerance);
            ASSERT_NEAR(z, (turn[2][0] * sum[0] + turn[2][2] * sum[2]) / length, tolerance);
        }
    }
    EXPECT_LE(worst, 1e-6);
    RecordProperty("worst_length_error", testing::PrintToString(worst));
}

TEST_F(Interpolation, SurvivesNormalsThatAreNone) {
    Random random(5);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Vec3 bad[] = {Vec3(0), Vec3(1e-40F), Vec3(1e30F), Vec3(nan, 0, 1)};
    for (std::size_t i = 0; i < data.normal.size(); ++i)
        data.normal[i] = bad[i / 3 % 4];
    run(random, 10, 0);
    for (int i = 0; i < kBlockSize; ++i) {
        const double x = block->normal[0][i], y = block->normal[1][i], z = block->normal[2][i];
        if (i % 4 == 2) continue; // 1e30 squared is beyond float: the loader's normals are unit
        EXPECT_NEAR(x * x + y * y + z * z, 1, 1e-6) << i;
    }
}

// The kernel's formula in plain floats, of one normal.
Vec3 as_wanted(const Vec3& normal, const FrameState& frame) {
    if (frame.vertex_normals) return normal;
    float row[3];
    for (int r = 0; r < 3; ++r) {
        const auto& m = frame.normal_matrix[r];
        row[r] = (m[0] * normal.x + m[1] * normal.y) + m[2] * normal.z;
    }
    const float scale = 1 / std::sqrt((row[0] * row[0] + row[1] * row[1]) + row[2] * row[2]);
    return {row[0] * scale, row[1] * scale, row[2] * scale};
}

// Flat, or with one component of one normal that differs.
void set_normals(Primitive& t, bool flat, Random& random) {
    for (auto& component : t.normal)
        component[0] = component[1] = component[2] = static_cast<float>(random.in(-1, 1));
    if (flat) return;
    t.normal[random.bits() % 3][1 + random.bits() % 2] += random.bits() % 2 == 0 ? 1.0F : -1.0F;
}

TEST_F(Interpolation, GivesAllLanesOfAFlatTriangleItsNormalAndOthersWhatTheyHaveAlone) {
    Random random(7);
    frame.attributes = {.normal = true};
    for (auto& row : frame.normal_matrix)
        for (float& m : row)
            m = static_cast<float>(random.in(-1, 1));
    const auto of_run = [&](const ShadingBlock& b, int r) {
        const int i = b.run[r].first;
        return Vec3(b.normal[0][i], b.normal[1][i], b.normal[2][i]);
    };
    for (int round = 0; round < 100; ++round) {
        ShadingBlock& b = *block;
        b.runs = b.count = 0;
        const auto is_flat = [&](int run) { return run % 2 == round % 2; };
        const int count = round / 2 % 2 == 0 ? kBlockSize : random.whole(1, kBlockSize);
        while (b.count < count) {
            Primitive& t = primitive[b.runs];
            for (int k = 0; k < 3; ++k) {
                t.c[k] = std::floor(random.in(1, 1e6));
                t.inverse_w[k] = static_cast<float>(random.in(0.1, 1));
            }
            set_normals(t, is_flat(b.runs), random);
            add_items(b, &t, std::min(count - b.count, random.whole(1, 39)));
        }
        frame.attributes.colour = round % 3 == 0;
        frame.vertex_normals = round % 5 == 4;
        for (const char* rung : {"perspective", "affine", "affine_8", "adaptive"})
            scanout::test::on_every_target([&](const std::string& target) {
                stage("interpolate", rung).run(b, frame);
                const ShadingBlock together = b;
                for (int r = 0; r < together.runs; ++r) {
                    const Primitive& t = primitive[r];
                    b.runs = 1;
                    b.run[0] = together.run[r];
                    stage("interpolate", rung).run(b, frame);
                    const Vec3 first =
                        as_wanted({t.normal[0][0], t.normal[1][0], t.normal[2][0]}, frame);
                    const Vec3 here = of_run(together, r);
                    ASSERT_EQ(here == first, is_flat(r)) << rung << ' ' << target;
                    for (int c = 0; c < 3 && frame.vertex_normals; ++c) {
                        const auto [low, high] = std::minmax_element(t.normal[c], t.normal[c] + 3);
                        ASSERT_TRUE(*low <= here[c] && here[c] <= *high) << rung << ' ' << target;
                    }
                    for (int i = 0; i < b.run[0].count; ++i)
                        for (int c = 0; c < 3; ++c) {
                            const int at = b.run[0].first + i;
                            ASSERT_EQ(together.normal[c][at], b.normal[c][at]) << target;
                            ASSERT_EQ(together.normal[c][at], here[c]) << target; // one weight
                        }
                }
                b = together;
            });
    }
}

TEST_F(Interpolation, MultipliesDiffuseAndVertexColours) {
    Random random(6);
    material.diffuse = {0.25F, 0.5F, 2};
    for (Vec3& c : data.colour)
        c = {0.5F, 1, 0.125F};
    run(random, 1, 0);
    EXPECT_EQ(block->albedo[0][5], 0.125F);
    EXPECT_EQ(block->albedo[1][5], 0.5F);
    EXPECT_EQ(block->albedo[2][5], 0.25F);
    frame.attributes.colour = false;
    stage("interpolate", "perspective").run(*block, frame);
    EXPECT_EQ(block->albedo[2][5], 2);
}

} // namespace
} // namespace scanout::shade::test
