// Laws of the lights: what arrives at a lane, and what does not.
#include "shade/block.h"
#include "support/lights.h"

#include <array>
#include <cmath>
#include <numbers>

namespace scanout::shade::test {
namespace {

using scene::LightKind;
using scene::ViewLight;

constexpr double kDegree = std::numbers::pi / 180;

ViewLight light_at(LightKind kind, const Vec3& position) {
    ViewLight light;
    light.kind = kind;
    light.position = position;
    light.colour = {0.9F, 0.5F, 0.25F};
    light.reach = 1.5F;
    light.nearest = 0x1p-10F;
    light.cos_inner = static_cast<float>(std::cos(10 * kDegree));
    light.cos_outer = static_cast<float>(std::cos(25 * kDegree));
    return light;
}

// Lanes at random places before the eye; the lights' stages written over them.
struct Lit {
    scene::Material material;
    std::unique_ptr<ShadingBlock> block = new_block(material);
    FrameState frame = identity_frame();
    std::vector<ViewLight> lights;
    std::array<bool, 8> varies{};

    explicit Lit(std::vector<ViewLight> shining, std::uint64_t seed = 1)
        : lights(std::move(shining)) {
        Random random(seed);
        for (int i = 0; i < kPaddedBlock; ++i)
            for (int c = 0; c < 3; ++c)
                block->position[c][i] = static_cast<float>(random.in(-1, 1)) - (c == 2 ? 3 : 0);
        block->light.resize(lights.size());
        for (BlockLight& lanes : block->light) {
            for (int c = 0; c < 3; ++c) {
                std::fill_n(lanes.towards[c], kPaddedBlock, -7.0F);
                std::fill_n(lanes.colour[c], kPaddedBlock, -7.0F);
            }
        }
        varies.fill(true);
        frame.lights = lights;
        frame.varies = {varies.data(), lights.size()};
    }
    void run(std::string_view name) { run_stage("light", name, *block, frame); }
    DVec3 position(int i) const {
        return {block->position[0][i], block->position[1][i], block->position[2][i]};
    }
    DVec3 towards(int i, std::size_t k = 0) const {
        const BlockLight& l = block->light[k];
        return {l.towards[0][i], l.towards[1][i], l.towards[2][i]};
    }
    double colour(int i, int c, std::size_t k = 0) const {
        return static_cast<double>(block->light[k].colour[c][i]);
    }
};

TEST(Light, OfAPointFallsOffWithTheSquareOfTheDistance) {
    for (std::uint64_t seed = 1; seed < 50; ++seed) {
        Lit lit({light_at(LightKind::point, {0.3F, 0.7F, -2.0F})}, seed);
        lit.run("point");
        for (int i = 0; i < kBlockSize; ++i) {
            const DVec3 way = DVec3(lit.lights[0].position) - lit.position(i);
            const double square = dot3(way, way);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(lit.towards(i)[c], way[c] / std::sqrt(square), 1e-6);
                const double arrives = lit.lights[0].colour[c] * 1.5 * 1.5 / square;
                EXPECT_NEAR(lit.colour(i, c), arrives, arrives * 1e-6);
            }
        }
    }
}

TEST(Light, OfAPointGetsNoBrighterThanAtItsOwnSurface) {
    Lit lit({light_at(LightKind::point, {0, 0, -3})});
    lit.lights[0].nearest = 0.5F;
    for (int i = 0; i < kBlockSize; ++i) {
        const float near =
            static_cast<float>(i) / kBlockSize * 0.4F; // the first lane is on the light
        lit.block->position[0][i] = near;
        lit.block->position[1][i] = 0;
        lit.block->position[2][i] = -3;
    }
    lit.run("point");
    for (int i = 0; i < kBlockSize; ++i) {
        EXPECT_FLOAT_EQ(lit.block->light[0].colour[0][i], 0.9F * 1.5F * 1.5F / 0.25F);
        EXPECT_FLOAT_EQ(lit.block->light[0].towards[0][i], i == 0 ? 0 : -1) << i;
    }
}

TEST(Light, OfASpotIsThatOfAPointInsideTheConeAndNothingOutside) {
    int inside = 0, outside = 0, between = 0;
    for (std::uint64_t seed = 1; seed < 20; ++seed) {
        Lit lit({light_at(LightKind::spot, {0, 0, 0}), light_at(LightKind::point, {0, 0, 0})},
                seed);
        lit.run("spot");
        lit.run("point");
        for (int i = 0; i < kBlockSize; ++i) {
            const DVec3 at = lit.position(i);
            const double angle = std::acos(-at.z / std::sqrt(dot3(at, at))) / kDegree;
            const double share = lit.colour(i, 1) / lit.colour(i, 1, 1);
            EXPECT_EQ(lit.towards(i), lit.towards(i, 1));
            if (angle < 10 - 1e-4) {
                EXPECT_EQ(share, 1);
                ++inside;
            } else if (angle > 25 + 1e-4) {
                EXPECT_EQ(share, 0);
                ++outside;
            } else {
                const double t = (std::cos(angle * kDegree) - std::cos(25 * kDegree)) /
                                 (std::cos(10 * kDegree) - std::cos(25 * kDegree));
                EXPECT_NEAR(share, t * t * (3 - 2 * t), 1e-5);
                ++between;
            }
        }
    }
    EXPECT_GT(inside, 100);
    EXPECT_GT(outside, 100);
    EXPECT_GT(between, 100);
}

TEST(Light, OfASpotWithoutARimHasAHardEdge) {
    Lit lit({light_at(LightKind::spot, {0, 0, 0})});
    lit.lights[0].cos_outer = lit.lights[0].cos_inner;
    lit.run("spot");
    for (int i = 0; i < kBlockSize; ++i) {
        const DVec3 at = lit.position(i);
        const double cosine = -at.z / std::sqrt(dot3(at, at));
        if (std::abs(cosine - lit.lights[0].cos_inner) > 1e-6) {
            EXPECT_EQ(lit.colour(i, 0) > 0, cosine > lit.lights[0].cos_inner) << i;
        }
    }
}

TEST(Light, OfASpotWithAConeOfHalfATurnIsThatOfAPointToTheBit) {
    scene::Light spot;
    spot.kind = LightKind::spot;
    spot.position = {0.2, 0.1, -2.8}; // among the lanes
    spot.inner_degrees = spot.outer_degrees = 180;
    spot.frame = scene::LightFrame::camera;
    scene::Light point = spot;
    point.kind = LightKind::point;
    geom::Mesh mesh;
    mesh.radius = 1;
    Lit lit({in_view(spot, {}, mesh), in_view(point, {}, mesh)});
    lit.run("spot");
    lit.run("point");
    EXPECT_EQ(std::memcmp(&lit.block->light[0], &lit.block->light[1], sizeof(BlockLight)), 0);
}

TEST(Light, ThatIsDirectionalIsTheSameInEveryLane) {
    ViewLight light = scanout::test::key_and_fill()[0];
    Lit lit({light, light_at(LightKind::point, {0, 0, 0})});
    lit.run("directional");
    for (int i = 0; i < kBlockSize; ++i) {
        EXPECT_EQ(lit.towards(i), DVec3(light.towards));
        EXPECT_EQ(lit.block->light[0].colour[2][i], light.colour.z);
        EXPECT_EQ(lit.block->light[1].colour[0][i], -7.0F) << "the other kind is not its business";
    }
}

TEST(Light, ThatVariesInNoLaneIsNotWritten) {
    Lit lit({light_at(LightKind::point, {0, 0, 0}), light_at(LightKind::point, {1, 0, 0})});
    lit.varies[0] = false;
    lit.run("point");
    EXPECT_EQ(lit.block->light[0].colour[0][0], -7.0F);
    EXPECT_NE(lit.block->light[1].colour[0][0], -7.0F);
}

TEST(Light, WrittenToTheLanesReflectsAsWhenItIsTheSameEverywhere) {
    Random random(3);
    const scene::Material material = scanout::test::plain(Vec3(1), Vec3(0.6F), 20);
    for (const char* name : {"lambert", "blinn_phong"}) {
        Lit lit(scanout::test::key_and_fill());
        lit.block->material = &material;
        for (int i = 0; i < kBlockSize; ++i) {
            const DVec3 n = random.in_cube(1);
            for (int c = 0; c < 3; ++c)
                lit.block->normal[c][i] = static_cast<float>(n[c] / std::sqrt(dot3(n, n)));
        }
        lit.run("directional");
        run_stage("reflection", name, *lit.block, lit.frame);
        auto same = std::make_unique<ShadingBlock>(*lit.block);
        lit.frame.varies = {};
        run_stage("reflection", name, *same, lit.frame);
        EXPECT_TRUE(same_lanes(*same, *lit.block, 0, kBlockSize)) << name;
    }
}

// The sky's share is (1 + cos) / 2: all of it straight up, half of it from the side.
TEST(Light, OfAHemisphereGoesFromItsSkyToItsGround) {
    Random random(5);
    ViewLight day = light_at(LightKind::hemisphere, Vec3(0)), dusk = day;
    day.towards = {0.6F, 0.8F, 0};
    day.ground = {0.1F, 0.2F, 0.05F};
    dusk.towards = {0, 0, -1};
    dusk.colour = {0.3F, 0.1F, 0};
    dusk.ground = Vec3(0);
    Lit lit({});
    const std::vector<ViewLight> both = {day, dusk};
    lit.frame.hemispheres = both;
    for (int i = 0; i < kPaddedBlock; ++i) {
        const DVec3 n = i == 0   ? DVec3(0.6, 0.8, 0)
                        : i == 1 ? DVec3(-0.6, -0.8, 0)
                                 : random.in_cube(1);
        for (int c = 0; c < 3; ++c)
            lit.block->normal[c][i] = static_cast<float>(n[c] / std::sqrt(dot3(n, n)));
    }
    lit.run("hemisphere");
    lit.block->ambient = Vec3(0.25F);
    run_stage("reflection", "lambert", *lit.block, lit.frame);
    for (int i = 0; i < kBlockSize; ++i)
        for (int c = 0; c < 3; ++c) {
            double arrives = 0.25;
            for (const ViewLight& light : both) {
                double cosine = 0;
                for (int k = 0; k < 3; ++k)
                    cosine += double{lit.block->normal[k][i]} * double{light.towards[k]};
                arrives += double{light.colour[c]} * (1 + cosine) / 2 +
                           double{light.ground[c]} * (1 - cosine) / 2;
            }
            EXPECT_NEAR(lit.block->colour[c][i], arrives, 1e-6) << i;
        }
    lit.frame.hemispheres = std::span(both).first(1);
    lit.run("hemisphere");
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(lit.block->from_hemispheres[c][0], day.colour[c], 1e-6);
        EXPECT_NEAR(lit.block->from_hemispheres[c][1], day.ground[c], 1e-6);
    }
}

TEST(Light, ThatIsAmbientIsTheFrames) {
    Lit lit({});
    lit.frame.ambient = {0.1F, 0.2F, 0.3F};
    lit.run("ambient");
    EXPECT_EQ(lit.block->ambient, Vec3(0.1F, 0.2F, 0.3F));
    run_stage("reflection", "lambert", *lit.block, lit.frame);
    for (int c = 0; c < 3; ++c)
        EXPECT_EQ(lit.block->colour[c][5], lit.frame.ambient[c]);
}

} // namespace
} // namespace scanout::shade::test
