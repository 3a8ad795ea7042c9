// What becomes of light above 1: how bright a scene can get, and the curve that this calls for.
#include "frame/facts/brightness.h"
#include "frame/plan/plan.h"
#include "frame/plans.h"
#include "image/compare.h"
#include "support/random.h"
#include "support/scenes.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::frame {
namespace {

using testing::HasSubstr;

scene::Light sun(const DVec3& towards, float colour) {
    scene::Light light;
    light.towards = towards;
    light.colour = Vec3(colour);
    return light;
}

// "diffuse light is at most 1.00" and the curve would contradict each other.
TEST(Tone, TakesTheCurveOnlyWhereTheFigureItPrintsIsAbove1) {
    SceneFacts facts;
    facts.triangles = 1;
    facts.brightest = 1;
    for (int step = 0; step <= 200; ++step) {
        FrameOptions options;
        scene::Light around;
        around.kind = scene::LightKind::ambient;
        around.power = 0.24 + step * 1e-4;
        options.lights = {sun({0, 1, 0}, 0.75F), around}; // together 0.99 to 1.01
        const Decision tone = *plan_of(facts, options).decision("tone");
        const bool above = tone.because.find("at most 1.01") != std::string::npos;
        EXPECT_EQ(tone.technique, above ? "shoulder" : "clamp") << tone.because;
    }
}

TEST(Tone, ClampsUnlessSurfacesGetBrighterThanWhite) {
    SceneFacts facts;
    facts.triangles = facts.specular_triangles = 5;
    facts.brightest = 1;
    const FramePlan usual = plan_of(facts);
    EXPECT_EQ(usual.decision("tone")->technique, "clamp");
    EXPECT_THAT(usual.decision("tone")->because, HasSubstr("at most 0.96"));
    EXPECT_EQ(usual.exposure, 1);
    EXPECT_EQ(usual.white, 1);
    EXPECT_THAT(usual.decision("tone")->because, HasSubstr("highlights may burn out"));
    FrameOptions matt;
    matt.effects["highlight"] = false;
    EXPECT_EQ(plan_of(facts, matt).decision("tone")->because, "diffuse light is at most 0.96");
    FrameOptions options;
    options.exposure = 1; // 0.96 becomes 1.93
    const FramePlan bright = plan_of(facts, options);
    EXPECT_EQ(bright.decision("tone")->technique, "shoulder");
    EXPECT_THAT(bright.decision("tone")->because, HasSubstr("1.93"));
    EXPECT_EQ(bright.exposure, 2);
    EXPECT_EQ(stages(bright).end()[-2], "exposure stops");
    EXPECT_NEAR(bright.white, 1.93, 0.005);
    EXPECT_EQ(stages(bright).back(), "tone shoulder");
    options.tone = "clamp";
    EXPECT_EQ(stages(plan_of(facts, options)).back(), "exposure stops");
    options = {};
    options.exposure = -2;
    EXPECT_EQ(stages(plan_of(facts, options)).back(), "exposure stops");
    EXPECT_EQ(plan_of(facts, options).decision("tone")->technique, "clamp");
    options = {};
    options.lights.push_back(sun({0, 0, 1}, 0.5F));
    EXPECT_EQ(stages(plan_of(facts, options)).back(), "tone shoulder");
    options.exposure = 21;
    const auto refused = plan(options, facts);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().what, HasSubstr("--exposure 21"));
}

// Where the curve sets in, too: a scene must not look another for a thousandth more light.
TEST(Tone, ALittleMoreLightChangesThePictureALittle) {
    test::Shot s = test::solids("brighter");
    bool clamped = false, rolled = false;
    const auto picture = [&](double light) {
        scene::Light around = test::light_of(scene::LightKind::ambient, light - 0.6);
        s.options.lights = {sun({1, 2, 3}, 0.6F), around};
        const auto plan = frame::plan(s.options, frame::facts(s.scene));
        (plan->decision("tone")->technique == "clamp" ? clamped : rolled) = true;
        return test::draw(s);
    };
    for (scene::Material& m : s.scene.materials)
        m.diffuse = Vec3(1);
    for (const double from : {0.98, 1.2, 2.0, 5.0}) {
        image::Image before = picture(from);
        for (int step = 1; step <= 40; ++step) {
            const image::Image after = picture(from + step * 0.001);
            ASSERT_LE(image::compare(before, after).max_difference, 1) << from << ' ' << step;
            before = after;
        }
    }
    EXPECT_TRUE(clamped && rolled);
}

// As in a box with a lamp below its lid: most of the lid gets more light than the model's centre.
TEST(Tone, ALampsOwnSurroundingsCount) {
    test::Shot s = test::shot("lid");
    geom::Mesh& mesh = s.scene.mesh;
    mesh.radius = 1;
    test::add_quad(
        mesh,
        {{{-0.5F, 0.5F, 0.5F}, {0.5F, 0.5F, 0.5F}, {0.5F, 0.5F, -0.5F}, {-0.5F, 0.5F, -0.5F}}},
        {0, -1, 0}, -1);
    test::add_quad(
        mesh,
        {{{-0.5F, -0.5F, 0.5F}, {0.5F, -0.5F, 0.5F}, {0.5F, -0.5F, -0.5F}, {-0.5F, -0.5F, -0.5F}}},
        {0, 1, 0}, -1);
    const Surroundings surroundings = surroundings_of(mesh);
    ASSERT_GT(surroundings.cells.size(), 100U);
    for (const SurfaceCell& cell : surroundings.cells) {
        EXPECT_NEAR(std::abs(cell.place.y), 0.5, 1e-5);
        EXPECT_NEAR(std::abs(cell.normal.y), 1, 1e-9);
    }
    scene::Light lamp;
    lamp.kind = scene::LightKind::point;
    lamp.position = {0, 0.25, 0};
    lamp.power = 0.5;
    const std::vector<scene::Light> lights = {lamp};
    // Straight above it, a quarter away: 16 times as bright as one bounding radius away.
    const double most = greatest_light(lights, surroundings);
    EXPECT_GT(most, 0.5 * 16 * 0.5);
    EXPECT_LT(most, 0.5 * 16);
    EXPECT_EQ(greatest_light(lights), 0.5) << "of surfaces that are not known";
    s.options.lights = lights;
    const auto plan = frame::plan(s.options, facts(s.scene));
    EXPECT_EQ(plan->decision("tone")->technique, "shoulder") << plan->decision("tone")->because;
    EXPECT_GT(plan->white, 3);
    // No order of triangles, and no way to cut the same surface into them.
    std::reverse(mesh.index.begin(), mesh.index.end());
    EXPECT_EQ(surroundings_of(mesh).cells.size(), surroundings.cells.size());
    EXPECT_EQ(greatest_light(lights, surroundings_of(mesh)), most);
    // A lamp on the camera, and one far away, are as at the centre.
    std::vector<scene::Light> other = {lamp};
    other[0].frame = scene::LightFrame::camera;
    EXPECT_EQ(greatest_light(other, surroundings), 0.5);
    other[0].frame = scene::LightFrame::world;
    other[0].position = {0, 1e6, 0};
    EXPECT_NEAR(greatest_light(other, surroundings), 0.5, 1e-5);
    // A spot that shines elsewhere.
    other = {lamp};
    other[0].kind = scene::LightKind::spot;
    other[0].target = DVec3(0, -0.5, 0);
    other[0].outer_degrees = 30;
    EXPECT_LT(greatest_light(other, surroundings), most / 4);
}

TEST(Tone, TheMostLightIsThatOfTheWorstDirection) {
    EXPECT_EQ(greatest_light({}), 0);
    scene::Light ambient;
    ambient.kind = scene::LightKind::ambient;
    ambient.power = 0.25;
    scene::Light lamp;
    lamp.kind = scene::LightKind::point;
    lamp.power = 2;
    EXPECT_DOUBLE_EQ(greatest_light(std::vector{ambient, lamp}), 2.25);
    EXPECT_DOUBLE_EQ(greatest_light(std::vector{sun({1, 0, 0}, 0.75F), sun({0, 9, 0}, 1)}), 1.25);
    EXPECT_DOUBLE_EQ(greatest_light(std::vector{sun({1, 0, 0}, 1), sun({-1, 0, 0}, 0.5F)}), 1);
    EXPECT_DOUBLE_EQ(greatest_light(std::vector(9, sun({1, 0, 0}, 1))), 9);
    // How the camera's lights stand to the world's is a matter of the view: the worst counts.
    std::vector<scene::Light> mixed = {sun({1, 0, 0}, 0.75F), sun({0, 1, 0}, 1)};
    mixed[1].frame = scene::LightFrame::camera;
    EXPECT_DOUBLE_EQ(greatest_light(mixed), 1.75);
    // No direction gets more, and one gets as much.
    test::Random random(1);
    for (int round = 0; round < 20; ++round) {
        std::vector<scene::Light> lights;
        for (int i = 0; i < 4; ++i)
            lights.push_back(sun(random.in_cube(1), static_cast<float>(random.unit())));
        const double bound = greatest_light(lights);
        double most = 0;
        for (int i = 0; i < 4000; ++i) {
            const DVec3 d = random.in_cube(1), n = d / std::sqrt(dot3(d, d));
            double sum = 0;
            for (const scene::Light& l : lights)
                sum += double{l.colour.x} * std::max(0.0, dot3(n, l.towards)) /
                       std::sqrt(dot3(l.towards, l.towards));
            ASSERT_LE(sum, bound + 1e-6);
            most = std::max(most, sum);
        }
        EXPECT_GT(most, bound * 0.98);
    }
}

} // namespace
} // namespace scanout::frame
