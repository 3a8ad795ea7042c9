// The checks of test builds (SCANOUT_CHECK_LANES) fire: NaN or infinity in a live lane ends the
// program with the name of the stage that left it there; in a dead lane it does not.
#include "raster/geometry.h"
#include "shade/block.h"
#include "shade/check_lanes.h"
#include "shade/gather.h"
#include "shade/mip_chain.h"

#include <array>
#include <limits>

namespace scanout::shade::test {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

// What a stage of the tests does after the one that it stands for.
struct Poison {
    enum class Lanes { albedo, normal, colour, u, v, sampled, position, towards, light };
    Lanes lanes = Lanes::albedo;
    int lane = -1; // none
    bool dead = false;
    float value = 0;
};
Poison poison; // a Stage is a plain function

void write_poison(Block& b) {
    if (poison.lane < 0) return;
    const int lane = poison.dead ? b.count + poison.lane : poison.lane;
    float* const lanes[] = {
        b.albedo[1],   b.normal[2],           b.colour[0],         b.u, b.v, b.sampled[2],
        b.position[1], b.light[0].towards[1], b.light[0].colour[2]};
    lanes[static_cast<std::size_t>(poison.lanes)][lane] = poison.value;
}

// The stage of that name, and then the poison.
Stage poisoned(const Stage& stage, void (*run)(Block&, const FrameState&)) {
    return {stage.card, stage.needs, run};
}

// Two textured triangles with a highlight: a square of 30 x 20 pixels, its sides between samples.
class ShadeLanesDeathTest : public testing::Test {
protected:
    void SetUp() override {
#ifndef SCANOUT_CHECK_LANES
        GTEST_SKIP() << "built without SCANOUT_CHECK_LANES";
#endif
        testing::GTEST_FLAG(death_test_style) = "threadsafe";
        poison = {};
        scanout::test::add_quad(
            mesh_,
            {{{5.3F, 5.3F, 0.5F}, {35.3F, 5.3F, 0.5F}, {35.3F, 25.3F, 0.5F}, {5.3F, 25.3F, 0.5F}}},
            {0, 0, 1}, 0);
        frame_.attributes = {.normal = true, .uv = true, .ray = true, .position = true};
        lights_[0].kind = scene::LightKind::point;
        lights_[0].position = {0, 0, 3};
        frame_.lights = lights_;
        frame_.varies = varies_;
        frame_.attributes.maps = bit_of(kDiffuseMap);
        frame_.filter = find_filter("bilinear");
        frame_.reflection.fill(&stage("reflection", "blinn_phong"));
        materials_[0].specular = Vec3(1);
        materials_[0].shininess = 10;
    }
    // The frame as it is drawn, its stages with the poison after the one that it stands for.
    void shade(int samples = 4) {
        scene::View view;
        view.projection = scene::Projection::orthographic;
        view.half_width = view.half_height = 32;
        view.translation = {-32, -32, 0};
        const raster::ScreenTransform transform(view, 64, 64);
        Jobs jobs(1);
        raster::Geometry geometry;
        geometry.run(jobs, mesh_, transform, {.width = 64, .height = 64, .samples = samples});
        raster::VisibilityTile tile;
        tile.reset(geometry.tile_area(0), samples);
        geometry.draw(0, tile);
        GatherInput in;
        in.mesh = &mesh_;
        in.geometry = &geometry;
        in.transform = &transform;
        in.materials = materials_;
        in.textures = textures_;
        in.mips = &mips_;
        in.stages = stages_;
        in.frame = &frame_;
        in.rays = rays_;
        in.view = &view;
        image::Image picture(64, 64);
        Gatherer gatherer;
        EXPECT_GE(gatherer.shade(tile, in, picture), 600U);
    }

    geom::Mesh mesh_ = scanout::test::empty_mesh();
    std::vector<scene::Material> materials_{scanout::test::textured(0)};
    std::vector<scene::Texture> textures_{scanout::test::checkers()};
    std::vector<scene::ViewLight> lights_{1};
    std::array<bool, 1> varies_{true};
    const MipChains mips_;
    FrameState frame_ = identity_frame();
    Rays rays_{0.01F, 0, 0.01F, 0};
    const Stage interpolate_ =
        poisoned(stage("interpolate", "perspective"), [](Block& b, const FrameState& f) {
            stage("interpolate", "perspective").run(b, f);
            write_poison(b);
        });
    const Stage light_ = poisoned(stage("light", "point"), [](Block& b, const FrameState& f) {
        stage("light", "point").run(b, f);
        write_poison(b);
    });
    const Stage map_ = poisoned(stage("map", "diffuse"), [](Block& b, const FrameState& f) {
        stage("map", "diffuse").run(b, f);
        write_poison(b);
    });
    const Stage shading_ =
        poisoned(stage("shading", "per_pixel"), [](Block& b, const FrameState& f) {
            stage("shading", "per_pixel").run(b, f);
            write_poison(b);
        });
    std::vector<const Stage*> stages_{&stage("interpolate", "perspective"),
                                      &stage("light", "point"), &stage("map", "diffuse"),
                                      &stage("shading", "per_pixel")};
};

using Lanes = Poison::Lanes;
struct Written {
    std::size_t stage; // its place
    Lanes lanes;
    const char* message;
};
constexpr Written kWritten[] = {
    {0, Lanes::albedo, "albedo of lane 5 is -?(nan|inf) after interpolate perspective"},
    {0, Lanes::normal, "normal of lane 5 is -?(nan|inf) after interpolate perspective"},
    {0, Lanes::u, "u of lane 5 is -?(nan|inf) after interpolate perspective"},
    {0, Lanes::v, "v of lane 5 is -?(nan|inf) after interpolate perspective"},
    {0, Lanes::position, "position of lane 5 is -?(nan|inf) after interpolate perspective"},
    {1, Lanes::towards, "direction of lane 5 is -?(nan|inf) after light point"},
    {1, Lanes::light, "light of lane 5 is -?(nan|inf) after light point"},
    {2, Lanes::albedo, "albedo of lane 5 is -?(nan|inf) after map diffuse"},
    {2, Lanes::sampled, "sampled of lane 5 is -?(nan|inf) after map diffuse"},
    {3, Lanes::colour, "colour of lane 5 is -?(nan|inf) after shading per_pixel"},
};

TEST_F(ShadeLanesDeathTest, ALiveLaneThatIsNotFiniteEndsTheProgramAfterEveryStage) {
    const Stage* const poisonous[] = {&interpolate_, &light_, &map_, &shading_};
    shade();
    for (const Written& w : kWritten) {
        const auto sound = stages_;
        stages_[w.stage] = poisonous[w.stage];
        for (const float bad : {kNaN, kInf, -kInf}) {
            poison = {w.lanes, 5, false, bad};
            EXPECT_DEATH(shade(), w.message);
        }
        stages_ = sound;
    }
}

TEST_F(ShadeLanesDeathTest, ADeadLaneMayHoldAnything) {
    const Stage* const poisonous[] = {&interpolate_, &light_, &map_, &shading_};
    for (const Written& w : kWritten) {
        const auto sound = stages_;
        stages_[w.stage] = poisonous[w.stage];
        for (const float bad : {kNaN, kInf, -kInf}) {
            for (const int beyond : {0, 7, 15}) {
                poison = {w.lanes, beyond, true, bad};
                shade(); // lives
            }
        }
        stages_ = sound;
    }
    // Nor is a texture coordinate looked at where nothing is textured.
    stages_[0] = poisonous[0];
    materials_[0].map_diffuse.texture = -1;
    poison = {Lanes::u, 5, false, kNaN};
    shade();
}

TEST_F(ShadeLanesDeathTest, ARayThatIsNotFiniteEndsTheProgramAfterPlaceLanes) {
    rays_.offset_x = kInf;
    EXPECT_DEATH(shade(), "ray x of lane 0 is inf after place_lanes");
    rays_ = {0.01F, 0, kNaN, 0};
    EXPECT_DEATH(shade(), "ray y of lane 0 is -?nan after place_lanes");
    frame_.attributes.ray = false; // nobody reads them
    stages_[3] = &stage("reflection", "lambert");
    shade();
}

// A stage of another axis that writes colours past the last check: what is resolved is looked at
// again.
TEST_F(ShadeLanesDeathTest, ASumOfSamplesThatIsNotFiniteEndsTheProgramBeforeItIsResolved) {
    const Stage last = poisoned(stage("map", "diffuse"), [](Block& b, const FrameState&) {
        for (int i = 0; i < b.count; ++i)
            b.colour[1][i] = poison.value;
    });
    stages_.push_back(&last);
    poison.value = 0.5F;
    shade();
    for (const float bad : {kNaN, kInf}) {
        poison.value = bad;
        EXPECT_DEATH(shade(), "sum of lane [0-9]+ is -?(nan|inf) after the sums of samples");
    }
}

TEST_F(ShadeLanesDeathTest, SumsBeyondTheLastPixelAreDead) {
    PixelSums sums;
    sums.reset(20);
    check_sums(sums, 20);
    sums.green[20] = kNaN;
    check_sums(sums, 20);
    sums.green[19] = kNaN;
    EXPECT_DEATH(check_sums(sums, 20), "sum of lane 19 is -?nan");
}

} // namespace
} // namespace scanout::shade::test
