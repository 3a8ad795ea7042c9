// The checks of test builds (SCANOUT_CHECK_LANES) fire: NaN or infinity in a live lane ends the
// program with the name of the stage that left it there; in a dead lane it does not.
#include "raster/stage/geometry.h"
#include "rows.h"
#include "shade/block.h"
#include "shade/check_lanes.h"
#include "shade/gather/gather.h"
#include "shade/mip/mip_chain.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string>

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

void write_poison(ShadingBlock& b) {
    if (poison.lane < 0) return;
    const int lane = poison.dead ? b.count + poison.lane : poison.lane;
    float* const lanes[] = {
        b.albedo[1],   b.normal[2],           b.colour[0],         b.u, b.v, b.sampled[2],
        b.position[1], b.light[0].towards[1], b.light[0].colour[2]};
    lanes[static_cast<std::size_t>(poison.lanes)][lane] = poison.value;
}

// The stage of that name, and then the poison.
Stage poisoned(const Stage& stage, void (*run)(ShadingBlock&, const FrameState&)) {
    return {stage.card, stage.pass, stage.needs, run};
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
        frame_.filter = find_row(shade::texture::kRows, "bilinear");
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
        const scene::Material unnamed;
        GatherInput in;
        in.mesh = &mesh_;
        in.unnamed = &unnamed;
        in.keys.mesh = &mesh_;
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
        PictureSink sink;
        sink.set(picture);
        Gatherer gatherer;
        EXPECT_GE(gatherer.shade(tile, in, sink), 600U);
    }

    geom::Mesh mesh_ = scanout::test::empty_mesh();
    std::vector<scene::Material> materials_{scanout::test::textured(0)};
    std::vector<scene::Texture> textures_{scanout::test::checkers()};
    std::vector<scene::ViewLight> lights_{1};
    std::array<bool, 1> varies_{true};
    const MipChains mips_{};
    FrameState frame_ = identity_frame();
    Rays rays_{0.01F, 0, 0.01F, 0};
    const Stage interpolate_ =
        poisoned(stage("interpolate", "perspective"), [](ShadingBlock& b, const FrameState& f) {
            stage("interpolate", "perspective").run(b, f);
            write_poison(b);
        });
    const Stage light_ =
        poisoned(stage("light", "point"), [](ShadingBlock& b, const FrameState& f) {
            stage("light", "point").run(b, f);
            write_poison(b);
        });
    const Stage map_ = poisoned(stage("map", "diffuse"), [](ShadingBlock& b, const FrameState& f) {
        stage("map", "diffuse").run(b, f);
        write_poison(b);
    });
    const Stage shading_ =
        poisoned(stage("shading", "per_pixel"), [](ShadingBlock& b, const FrameState& f) {
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
    materials_[0].map_diffuse.edit().texture = -1;
    poison = {Lanes::u, 5, false, kNaN};
    shade();
}

TEST_F(ShadeLanesDeathTest, ARayThatIsNotFiniteEndsTheProgramAfterPlaceLanes) {
    rays_.offset_x = kInf;
    EXPECT_DEATH(shade(), "ray x of lane 0 is inf after set_rays");
    rays_ = {0.01F, 0, kNaN, 0};
    EXPECT_DEATH(shade(), "ray y of lane 0 is -?nan after set_rays");
    frame_.attributes.ray = false; // nobody reads them
    stages_[3] = &stage("reflection", "lambert");
    shade();
}

// What all lanes of a triangle share.
TEST_F(ShadeLanesDeathTest, APrimitiveThatIsNotFiniteEndsTheProgramAfterItsSetUp) {
    Primitive p{};
    const Attributes all{true, true, true, true, true};
    check_primitive(p, all);
    p.id = 5;
    struct Value {
        float* at;
        const char* what;
    };
    for (const float bad : {kNaN, kInf, -kInf}) {
        for (double* weight : {&p.a[0], &p.b[1], &p.c[2]}) {
            *weight = bad;
            EXPECT_DEATH(check_primitive(p, {}),
                         "weight of triangle 5 is -?(nan|inf) after set-up");
            *weight = 0;
        }
        for (const Value& v : {Value{&p.inverse_w[1], "1 / w"},
                               {&p.facing[2], "facing"},
                               {&p.normal[2][0], "normal"},
                               {&p.uv[1][2], "uv"},
                               {&p.colour[0][1], "colour"},
                               {&p.position[1][1], "position"}}) {
            *v.at = bad;
            EXPECT_DEATH(check_primitive(p, all),
                         std::string(v.what) + " of triangle 5 is -?(nan|inf) after set-up");
            *v.at = 0;
        }
        p.uv[0][0] = bad; // nobody reads it
        check_primitive(p, {.normal = true});
        p.uv[0][0] = 0;
    }
    mesh_.uv[2].y = kNaN;
    EXPECT_DEATH(shade(), "uv of triangle [01] is nan after set-up");
}

// The interpolation clamps to the range of the vertices, of which NaN would become one.
TEST_F(ShadeLanesDeathTest, AnInterpolatedValueIsLookedAtBeforeItIsClamped) {
    const Stage& perspective = stage("interpolate", "perspective");
    auto block = std::make_unique<ShadingBlock>();
    block->material = materials_.data();
    frame_.attributes = {.colour = true};
    const auto run = [&](const Primitive& p) {
        block->count = 11;
        block->runs = 1;
        block->run[0] = {&p, 0, 11};
        std::fill(block->x, block->x + kPaddedBlock, 0);
        std::fill(block->y, block->y + kPaddedBlock, 0);
        perspective.run(*block, frame_);
    };
    Primitive sound{};
    sound.c[0] = sound.c[1] = sound.c[2] = 1;
    sound.inverse_w[0] = sound.inverse_w[1] = sound.inverse_w[2] = 1;
    sound.colour[1][2] = 1;
    run(sound);
    const char* const message = "value of lane 0 is -?nan after interpolation";
    Primitive p = sound;
    p.c[0] = p.c[1] = p.c[2] = 0; // 0 / 0
    EXPECT_DEATH(run(p), message);
    p = sound;
    p.inverse_w[1] = kNaN;
    EXPECT_DEATH(run(p), message);
    p = sound;
    p.clipped = true;
    run(p);
    p.c[1] = kNaN; // before it becomes a weight of 0
    EXPECT_DEATH(run(p), message);
    p = sound; // lanes behind the last are dead: there the weights cancel to 0 / 0
    p.c[0] = p.c[1] = p.c[2] = 11 * 256;
    p.a[0] = p.a[1] = p.a[2] = -1;
    const auto place = [&](int count) {
        block->count = count;
        block->runs = 1;
        block->run[0] = {&p, 0, count};
        for (int i = 0; i < kPaddedBlock; ++i)
            block->x[i] = i * 256;
        perspective.run(*block, frame_);
    };
    place(11);
    EXPECT_DEATH(place(12), "value of lane 11 is -?nan after interpolation");
}

TEST_F(ShadeLanesDeathTest, AmbientLightThatIsNotFiniteEndsTheProgram) {
    stages_.insert(stages_.begin() + 1, &stage("light", "ambient"));
    shade();
    for (const float bad : {kNaN, kInf, -kInf}) {
        frame_.ambient = {0.1F, bad, 0.1F};
        EXPECT_DEATH(shade(), "colour of ambient light 0 is -?(nan|inf) after light ambient");
    }
}

TEST_F(ShadeLanesDeathTest, ALightThatDoesNotVaryIsLookedAtToo) {
    lights_[0].kind = scene::LightKind::directional;
    varies_[0] = false;
    shade();
    const scene::ViewLight sound = lights_[0];
    for (const float bad : {kNaN, kInf, -kInf}) {
        lights_[0].colour.z = bad;
        EXPECT_DEATH(shade(), "colour of light 0 is -?(nan|inf) after the frame's set-up");
        lights_[0] = sound;
        lights_[0].towards.x = bad;
        EXPECT_DEATH(shade(), "direction of light 0 is -?(nan|inf) after the frame's set-up");
        lights_[0] = sound;
        lights_[0].reach = bad;
        EXPECT_DEATH(shade(), "length of light 0 is -?(nan|inf) after the frame's set-up");
        lights_[0] = sound;
    }
}

// A stage of another axis that writes colours past the last check: what is resolved is looked at
// again.
TEST_F(ShadeLanesDeathTest, ASumOfSamplesThatIsNotFiniteEndsTheProgramBeforeItIsResolved) {
    const Stage last = poisoned(stage("map", "diffuse"), [](ShadingBlock& b, const FrameState&) {
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

// What no block of lanes holds: each place that makes such values looks at them itself.
TEST_F(ShadeLanesDeathTest, MeansThatAreNotFiniteEndTheProgramBeforeTheyAreEncoded) {
    const Output output{find_row(shade::encode::kRows, "srgb")};
    std::uint32_t codes[kBlockSize + kPaddedBlock];
    const auto resolve = [&](float red) {
        PixelSums sums;
        sums.reset(20);
        sums.red[13] = red;
        sums.red[20] = kNaN; // dead
        resolve_pixels(sums, output, {}, nullptr, 20, codes);
    };
    resolve(0.5F);
    for (const float bad : {kNaN, kInf})
        EXPECT_DEATH(resolve(bad), "mean of lane 13 is -?(nan|inf) after resolve");
}

TEST_F(ShadeLanesDeathTest, AWideFilterThatIsNotFiniteEndsTheProgram) {
    const ReconstructionFilter filter(raster::sample_pattern(4),
                                      [](double d) { return d < 1 ? 1 - d : 0; });
    const auto filtered = [&](float red) {
        SplatPicture wide;
        wide.reset(8, 8, 8, 1, 1);
        wide.own.at(4, 4)[0] = red;
        PixelSums sums;
        sums.reset(64);
        filter_area(filter, wide, {0, 0, 8, 8}, sums);
    };
    filtered(0.5F);
    for (const float bad : {kNaN, kInf})
        EXPECT_DEATH(filtered(bad),
                     "sum of lane 27 is -?(nan|inf) after the reconstruction filter");
}

TEST_F(ShadeLanesDeathTest, LightAtCornersThatIsNotFiniteEndsTheProgram) {
    stages_.pop_back();
    const Stage& gouraud = stage("shading", "gouraud");
    stages_.push_back(&gouraud);
    frame_.attributes.vertices = true;
    const Stage* const lights[] = {&stage("light", "point"), &stage("light", "ambient")};
    frame_.vertex_lights = lights;
    shade();
    for (const float bad : {kNaN, kInf}) {
        frame_.ambient = {0.1F, bad, 0.1F};
        EXPECT_DEATH(shade(), "colour of lane [0-9]+ is -?(nan|inf) after light at vertices");
    }
}

TEST_F(ShadeLanesDeathTest, AValueOfAListIsNamedByItsPlace) {
    std::vector<float> texels(9, 0.5F);
    check_values(texels, "texel", "the mip chain");
    for (const float bad : {kNaN, kInf, -kInf}) {
        texels[8] = bad;
        EXPECT_DEATH(check_values(texels, "texel", "the mip chain"),
                     "texel of lane 8 is -?(nan|inf) after the mip chain");
    }
}

} // namespace
} // namespace scanout::shade::test
