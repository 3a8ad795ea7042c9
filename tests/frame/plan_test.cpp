#include "frame/in_vain.h"
#include "frame/plan.h"
#include "support/scenes.h"

#include <algorithm>
#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::frame {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> stages(const FramePlan& plan) {
    std::vector<std::string> names;
    for (const shade::Stage* stage : plan.stages)
        names.push_back(std::string(stage->card.axis) + " " + std::string(stage->card.name));
    return names;
}

std::vector<std::string> techniques(const FramePlan& plan) {
    std::vector<std::string> names;
    for (const Technique* technique : plan.techniques)
        names.push_back(std::string(technique->axis) + " " + std::string(technique->name));
    return names;
}

FramePlan plan_of(const SceneFacts& facts, const FrameOptions& options = {}) {
    auto result = plan(options, facts);
    EXPECT_TRUE(result) << result.error().what;
    return result.value_or(FramePlan());
}

TEST(Plan, RunsOnlyWhatTheSceneCallsFor) {
    SceneFacts facts;
    facts.triangles = 10;
    EXPECT_THAT(stages(plan_of(facts)),
                ElementsAre("interpolate perspective", "light ambient", "shading per_pixel"));
    EXPECT_FALSE(plan_of(facts).attributes.uv);
    EXPECT_FALSE(plan_of(facts).attributes.colour);
    EXPECT_TRUE(plan_of(facts).attributes.normal);
    facts.textured_triangles = 3;
    facts.uv = true;
    EXPECT_THAT(stages(plan_of(facts)), ElementsAre("interpolate perspective", "map diffuse",
                                                    "light ambient", "shading per_pixel"));
    EXPECT_THAT(techniques(plan_of(facts)),
                ElementsAre("interpolate perspective", "texture bilinear", "map diffuse",
                            "light ambient", "reflection lambert", "shading per_pixel", "aa none",
                            "encode srgb"));
    EXPECT_TRUE(plan_of(facts).attributes.uv);
    facts.specular_triangles = 1;
    EXPECT_THAT(stages(plan_of(facts)), ElementsAre("interpolate perspective", "map diffuse",
                                                    "light ambient", "shading per_pixel"));
    facts.vertex_colours = true;
    EXPECT_TRUE(plan_of(facts).attributes.colour);
    // Lines and points are unlit: nothing is fetched for them but their colour.
    SceneFacts wires;
    wires.lines = 5;
    EXPECT_FALSE(plan_of(wires).attributes.normal);
    EXPECT_FALSE(plan_of(wires).attributes.uv);
}

// Unlit vertex colours call for no normals, nor does any material in ambient light alone.
TEST(Plan, WithoutLightFromASideNothingIsDoneAboutNormals) {
    SceneFacts facts;
    facts.triangles = 10;
    facts.vertex_colours = facts.uv = true;
    facts.sides.leaning = facts.specular_triangles = 5;
    facts.mapped_triangles.fill(5);
    facts.readable_maps = ~shade::MapBits{0};
    FrameOptions options;
    for (const char* shading : {"auto", "per_pixel_raw"}) {
        options.shading = shading;
        options.lights = scene::default_lights();
        EXPECT_TRUE(plan_of(facts, options).attributes.normal);
        for (const bool ambient : {true, false}) {
            options.lights.clear();
            if (ambient) options.lights = {test::light_of(scene::LightKind::ambient, 0.8)};
            const FramePlan unlit = plan_of(facts, options);
            EXPECT_FALSE(unlit.attributes.normal);
            EXPECT_FALSE(unlit.attributes.ray);
            EXPECT_FALSE(unlit.corner_normals);
            EXPECT_TRUE(unlit.attributes.colour);
            for (const char* effect :
                 {"highlight", "two_sided", "normal_map", "bump_map", "specular_map", "gloss_map"})
                EXPECT_FALSE(unlit.decision(effect)->on()) << effect;
        }
    }
}

TEST(Plan, NothingTexturedRunsNoTextureStageWhateverIsAsked) {
    SceneFacts facts;
    facts.triangles = 10;
    for (const char* filter : {"auto", "nearest", "bilinear"}) {
        FrameOptions options;
        options.texture = filter;
        for (const std::string& stage : stages(plan_of(facts, options)))
            EXPECT_THAT(stage, testing::Not(HasSubstr("map")));
        EXPECT_EQ(plan_of(facts, options).filter, nullptr);
    }
}

TEST(Plan, RunsWhatTheUserNames) {
    SceneFacts facts;
    facts.triangles = facts.textured_triangles = facts.specular_triangles = 10;
    facts.uv = true;
    FrameOptions options;
    options.texture = "nearest";
    options.reflection = "lambert";
    EXPECT_THAT(stages(plan_of(facts, options)),
                ElementsAre("interpolate perspective", "map diffuse", "light ambient",
                            "shading per_pixel"));
    EXPECT_EQ(plan_of(facts, options).filter, shade::find_filter("nearest"));
}

TEST(Plan, ChoosesAModelForEachKindOfSurface) {
    const auto models = [](const SceneFacts& facts, const std::string& asked = "auto") {
        FrameOptions options;
        options.reflection = asked;
        std::vector<std::string> names;
        for (const shade::Stage* model : plan_of(facts, options).reflection)
            names.emplace_back(model->card.name);
        return names;
    };
    SceneFacts facts;
    facts.triangles = 10;
    facts.specular_triangles = 7;
    facts.physical_triangles = 3;
    EXPECT_THAT(models(facts), ElementsAre("lambert", "blinn_phong", "ggx"));
    EXPECT_THAT(models(facts, "phong"), ElementsAre("lambert", "phong", "phong"));
    EXPECT_THAT(models(facts, "lambert"), ElementsAre("lambert", "lambert", "lambert"));
    EXPECT_EQ(plan_of(facts).decision("highlight")->technique, "blinn_phong and ggx");
    EXPECT_THAT(techniques(plan_of(facts)),
                ElementsAre("interpolate perspective", "light ambient", "reflection lambert",
                            "reflection blinn_phong", "reflection ggx", "shading per_pixel",
                            "aa none", "encode srgb"));
    FrameOptions off;
    off.effects["highlight"] = false;
    EXPECT_THAT(techniques(plan_of(facts, off)),
                ElementsAre("interpolate perspective", "light ambient", "reflection lambert",
                            "shading per_pixel", "aa none", "encode srgb"));
    EXPECT_FALSE(plan_of(facts, off).attributes.ray);
    facts.specular_triangles = facts.physical_triangles = 10;
    EXPECT_THAT(techniques(plan_of(facts)),
                ElementsAre("interpolate perspective", "light ambient", "reflection ggx",
                            "shading per_pixel", "aa none", "encode srgb"));
    EXPECT_EQ(plan_of(facts).decision("highlight")->technique, "ggx");
    EXPECT_TRUE(plan_of(facts).attributes.ray);
    // Forced on where nothing has one, it runs nowhere.
    SceneFacts matt;
    matt.triangles = 10;
    FrameOptions on;
    on.effects["highlight"] = true;
    EXPECT_FALSE(plan_of(matt, on).attributes.ray);
}

TEST(Plan, AnAxisIsNoEffect) {
    SceneFacts facts;
    facts.triangles = 10;
    FrameOptions options;
    options.effects["shading"] = false;
    const auto refused = plan(options, facts);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().what, HasSubstr("say --shading NAME"));
    options.effects = {{"depth_test", true}};
    EXPECT_THAT(plan(options, facts).error().what, HasSubstr("say --depth-test NAME"));
}

TEST(Plan, KnowsWhatIsAskedOfItInVain) {
    SceneFacts facts;
    facts.triangles = 10;
    const auto in_vain = [&](const FrameOptions& options) {
        return asked_in_vain(plan_of(facts, options));
    };
    FrameOptions options;
    EXPECT_THAT(in_vain(options), testing::IsEmpty());
    options.effects = {{"point_light", true}, {"spot_light", false}};
    options.shadow = "volume"; // nothing casts
    EXPECT_THAT(in_vain(options),
                testing::UnorderedElementsAre(StartsWith("point_light"), StartsWith("shadow")));
    options.lights = {test::light_of(scene::LightKind::point, 1)};
    options.lights.back().casts = true;
    EXPECT_THAT(in_vain(options), testing::IsEmpty());
    options.shading = "flat";
    EXPECT_THAT(in_vain(options), ElementsAre(StartsWith("shadow")));
}

TEST(Plan, WritesOnlyLightsThatDifferFromPixelToPixel) {
    SceneFacts facts;
    facts.triangles = 10;
    facts.brightest = 0.2F;
    FrameOptions options;
    const auto add = [&](scene::LightKind kind, double power) {
        options.lights.push_back(test::light_of(kind, power));
    };
    EXPECT_FALSE(plan_of(facts, options).attributes.position);
    EXPECT_EQ(plan_of(facts, options).lights.size(), 3U);
    add(scene::LightKind::directional, 1);
    add(scene::LightKind::point, 0); // black
    EXPECT_FALSE(plan_of(facts, options).attributes.position);
    EXPECT_FALSE(plan_of(facts, options).decision("point_light")->on());
    EXPECT_EQ(plan_of(facts, options).lights.size(), 4U);
    add(scene::LightKind::spot, 1);
    add(scene::LightKind::point, 1);
    EXPECT_THAT(stages(plan_of(facts, options)),
                ElementsAre("interpolate perspective", "light ambient", "light point", "light spot",
                            "shading per_pixel"));
    EXPECT_TRUE(plan_of(facts, options).attributes.position);
    EXPECT_THAT(plan_of(facts, options).decision("directional_light")->because,
                HasSubstr("3 lights: key, fill, directional"));
    options.effects = {{"point_light", false}, {"spot_light", false}, {"ambient_light", false}};
    EXPECT_THAT(stages(plan_of(facts, options)),
                ElementsAre("interpolate perspective", "shading per_pixel"));
    EXPECT_TRUE(plan_of(facts, options).decision("point_light")->forced);
    options.lights.clear();
    options.effects = {{"point_light", true}, {"spot_light", true}, {"ambient_light", true}};
    EXPECT_THAT(stages(plan_of(facts, options)),
                ElementsAre("interpolate perspective", "shading per_pixel"));
    SceneFacts wires;
    wires.lines = 5;
    EXPECT_THAT(stages(plan_of(wires)),
                ElementsAre("interpolate perspective", "shading per_pixel"));
}

TEST(Plan, LightsNothingThatReflectsNone) {
    SceneFacts facts;
    facts.triangles = 10;
    facts.brightest = 0; // Kd is black
    EXPECT_TRUE(plan_of(facts, {}).lights.empty());
    for (const char* row : {"ambient_light", "directional_light", "two_sided", "shadow", "shading"})
        EXPECT_FALSE(plan_of(facts, {}).decision(row)->on()) << row;
    EXPECT_THAT(to_string(*plan_of(facts, {}).decision("directional_light")),
                HasSubstr("Kd and Ks are black"));
    facts.specular_triangles = 1;
    EXPECT_FALSE(plan_of(facts, {}).lights.empty());
    facts.specular_triangles = 0;
    facts.brightest = 0.01F;
    EXPECT_FALSE(plan_of(facts, {}).lights.empty());
}

TEST(Plan, DrawsNoShadowMapOfWhatThrowsNoShadow) {
    SceneFacts facts;
    facts.triangles = 10;
    facts.alpha.blended_triangles = 8;
    facts.alpha.unseen_triangles = 2;
    FrameOptions options;
    options.lights = {test::light_of(scene::LightKind::point, 1)};
    options.lights[0].casts = true;
    const auto shadow = [&] { return to_string(*plan_of(facts, options).decision("shadow")); };
    EXPECT_THAT(shadow(), StartsWith("shadow off: every triangle is blended or clear"));
    options.effects = {{"blending", false}}; // then they are opaque
    EXPECT_THAT(shadow(), StartsWith("shadow map_pcf"));
    options.effects.clear();
    facts.alpha.blended_triangles = 7;
    EXPECT_THAT(shadow(), StartsWith("shadow map_pcf"));
}

TEST(Plan, RunsShadowsOnlyWhereALightCastsThem) {
    SceneFacts facts;
    facts.triangles = 10;
    FrameOptions options;
    const auto shadow = [&] { return to_string(*plan_of(facts, options).decision("shadow")); };
    // Those that hang on the camera cast none, nor does ambient light or one that is black.
    EXPECT_THAT(shadow(), StartsWith("shadow off: no light that reaches anything casts shadows"));
    options.effects = {{"shadow", true}};
    EXPECT_EQ(plan_of(facts, options).shadow.stage, nullptr);
    options.effects.clear();
    options.lights = {test::light_of(scene::LightKind::directional, 0)};
    options.lights[0].casts = true;
    EXPECT_THAT(shadow(), StartsWith("shadow off"));
    options.lights[0].power = 1;
    EXPECT_THAT(shadow(), StartsWith("shadow map_pcf: 1 light casts: directional"));
    EXPECT_THAT(stages(plan_of(facts, options)),
                ElementsAre("interpolate perspective", "light directional", "shadow map_pcf",
                            "shading per_pixel"));
    EXPECT_TRUE(plan_of(facts, options).attributes.position);
    options.lights[0].size = 2;
    EXPECT_THAT(shadow(), StartsWith("shadow map_soft: 1 light casts: directional; 1 with a size"));
    for (const char* shading : {"flat", "gouraud"}) {
        options.shading = shading;
        EXPECT_THAT(shadow(), StartsWith("shadow off: they need light at pixels"));
        EXPECT_THAT(shadow(), HasSubstr(shading));
    }
    options.shading = "per_pixel_raw";
    EXPECT_THAT(shadow(), StartsWith("shadow map_soft"));
    options.shading = "auto";
    options.shadow = "attached"; // nothing runs
    EXPECT_EQ(plan_of(facts, options).shadow.stage, nullptr);
    EXPECT_THAT(techniques(plan_of(facts, options)), testing::Contains("shadow attached"));
    options.shadow = "projected"; // there is no floor
    EXPECT_THAT(shadow(), StartsWith("shadow off: no triangle lies flat"));
    facts.ground.asked = true;
    EXPECT_THAT(shadow(),
                StartsWith("shadow off: no triangle lies in the plane of --shadow-plane"));
    facts.ground.triangles = 2;
    EXPECT_THAT(shadow(), StartsWith("shadow projected: 1 light casts"));
    options.effects = {{"shadow", false}};
    EXPECT_TRUE(plan_of(facts, options).decision("shadow")->forced);
    EXPECT_EQ(plan_of(facts, options).shadow.stage, nullptr);
    EXPECT_FALSE(plan_of(facts, options).attributes.position);
    facts.triangles = 0;
    EXPECT_THAT(shadow(), StartsWith("shadow off: nothing is lit"));
}

TEST(Plan, GivesAReasonForEveryDecision) {
    SceneFacts facts;
    facts.triangles = 40;
    facts.textured_triangles = 30;
    facts.uv = true;
    facts.specular_triangles = 20;
    const FramePlan on = plan_of(facts);
    EXPECT_THAT(to_string(*on.decision("texture")),
                StartsWith("texture bilinear: 30 of 40 triangles"));
    EXPECT_THAT(to_string(*on.decision("highlight")),
                StartsWith("highlight blinn_phong: 20 of 40 triangles"));
    EXPECT_THAT(to_string(*on.decision("vertex_colours")), StartsWith("vertex_colours off"));
    const FramePlan off = plan_of({});
    EXPECT_THAT(to_string(*off.decision("texture")), StartsWith("texture off"));
    EXPECT_EQ(on.decisions.size(), off.decisions.size());
    EXPECT_EQ(on.decision("nothing"), nullptr);
    for (const Decision& decision : on.decisions) {
        EXPECT_EQ(to_string(decision).find('\n'), std::string::npos);
        EXPECT_EQ(decision.on(), decision.needed);
        EXPECT_FALSE(decision.forced);
    }
}

TEST(Plan, TheUserForcesAnEffectOnOrOff) {
    SceneFacts facts;
    facts.triangles = facts.textured_triangles = facts.specular_triangles = 7;
    facts.uv = true;
    FrameOptions options;
    options.effects = {{"texture", false}, {"highlight", true}, {"vertex_colours", true}};
    const FramePlan forced = plan_of(facts, options);
    EXPECT_FALSE(forced.decision("texture")->on());
    EXPECT_TRUE(forced.decision("texture")->forced);
    EXPECT_TRUE(forced.decision("highlight")->on());
    EXPECT_FALSE(forced.decision("highlight")->forced); // it would run anyway
    EXPECT_TRUE(forced.decision("vertex_colours")->on());
    EXPECT_FALSE(forced.attributes.colour); // there is nothing to fetch
    EXPECT_FALSE(forced.attributes.uv);
    EXPECT_THAT(stages(forced),
                ElementsAre("interpolate perspective", "light ambient", "shading per_pixel"));
    options.effects = {{"fog", true}};
    const auto refused = plan(options, facts);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().exit, Exit::usage);
    EXPECT_THAT(refused.error().what, HasSubstr("--effect fog=on"));
    EXPECT_THAT(refused.error().what, HasSubstr("highlight"));
}

TEST(Plan, IsAPureFunction) {
    SceneFacts facts;
    facts.triangles = facts.textured_triangles = 7;
    FrameOptions options;
    options.samples = 4;
    options.cull = Cull::back;
    const FramePlan a = plan_of(facts, options), b = plan_of(facts, options);
    EXPECT_EQ(a.stages, b.stages);
    EXPECT_EQ(a.decisions, b.decisions);
    EXPECT_EQ(a.options.samples, 4);
    EXPECT_EQ(a.options.cull, Cull::back);
}

TEST(Plan, RefusesWhatDoesNotExist) {
    const auto refusal = [](auto&& change) {
        FrameOptions options;
        change(options);
        const auto result = plan(options, {});
        if (result) return std::string("accepted");
        EXPECT_EQ(result.error().exit, Exit::usage);
        EXPECT_EQ(result.error().what.find('\n'), std::string::npos);
        return result.error().what;
    };
    // Each message names the value and what there is instead.
    const std::string texture = refusal([](FrameOptions& o) { o.texture = "quadrilinear"; });
    EXPECT_THAT(texture, HasSubstr("quadrilinear"));
    EXPECT_THAT(texture, HasSubstr(" bilinear"));
    EXPECT_THAT(texture, HasSubstr("nearest"));
    const std::string reflection = refusal([](FrameOptions& o) { o.reflection = "mirror"; });
    EXPECT_THAT(reflection, HasSubstr("blinn_phong"));
    EXPECT_THAT(refusal([](FrameOptions& o) { o.shadow = "stencil"; }), HasSubstr("volume"));
    for (const int size : {0, 63, 8193})
        EXPECT_THAT(refusal([&](FrameOptions& o) { o.shadow_size = size; }),
                    HasSubstr("--shadow-size"));
    for (const int filter : {0, -3, 16})
        EXPECT_THAT(refusal([&](FrameOptions& o) { o.shadow_filter = filter; }),
                    HasSubstr("--shadow-filter"));
    // A technique of another axis is none of this one.
    EXPECT_NE(refusal([](FrameOptions& o) { o.texture = "lambert"; }), "accepted");
    EXPECT_NE(refusal([](FrameOptions& o) { o.reflection = ""; }), "accepted");
    for (const int side : {0, -1, kMaxSide + 1, 1 << 30}) {
        EXPECT_THAT(refusal([&](FrameOptions& o) { o.width = side; }),
                    HasSubstr(std::to_string(side)));
        EXPECT_THAT(refusal([&](FrameOptions& o) { o.height = side; }),
                    HasSubstr(std::to_string(kMaxSide)));
    }
    for (const int samples : {0, -1, 3, 5, 32})
        EXPECT_THAT(refusal([&](FrameOptions& o) { o.samples = samples; }),
                    HasSubstr("1, 2, 4, 8 or 16"));
    EXPECT_EQ(refusal([](FrameOptions& o) { o.width = o.height = kMaxSide; }), "accepted");
}

TEST(Facts, FindTheFloorWhicheverAxisIsUp) {
    EXPECT_EQ(ground(geom::Mesh()).triangles, 0U);
    for (int up = 0; up < 3; ++up) {
        for (const float side : {-1.0F, 1.0F}) {
            geom::Mesh mesh = test::empty_mesh();
            test::add_sphere(mesh, Vec3(0), 0.3F, 12, 6);
            EXPECT_EQ(ground(mesh).triangles, 0U);
            std::array<Vec3, 4> floor;
            for (std::size_t i = 0; i < 4; ++i) {
                floor[i][up] = side * 0.4F;
                floor[i][(up + 1) % 3] = i == 0 || i == 3 ? -1.0F : 1.0F;
                floor[i][(up + 2) % 3] = i < 2 ? -1.0F : 1.0F;
            }
            test::add_quad(mesh, floor, {0, 0, 1});
            const Ground found = ground(mesh);
            DVec3 axis(0);
            axis[up] = 1;
            EXPECT_EQ(found.normal, axis);
            EXPECT_EQ(found.offset, double{side * 0.4F});
            EXPECT_EQ(found.triangles, 2U);
            EXPECT_FALSE(found.asked);
            std::vector<std::uint8_t> in(mesh.triangles(), 0);
            in[in.size() - 1] = in[in.size() - 2] = 1;
            EXPECT_EQ(in_ground(mesh, found), in);
        }
    }
}

TEST(Facts, TheUsersGroundIsThePlaneOfTheFileAtAnyLengthOfItsNormal) {
    geom::Mesh mesh = test::empty_mesh();
    mesh.centre = {100, 20, -3}; // and a unit of the mesh is four of the file
    mesh.exponent = 2;
    // z = 1/2 - y / 2 in the mesh: in the file 2 (z + 3) = 4 - (y - 20).
    test::add_quad(mesh, {{{-1, -1, 1}, {1, -1, 1}, {1, 1, 0}, {-1, 1, 0}}}, {0, 0.4F, 0.9F});
    test::add_square(mesh, 1, 0);
    const std::vector<std::uint8_t> leaning = {1, 1, 0, 0};
    for (const double length : {1.0, -3.0, 1e-200, 1e200}) {
        const Ground found = ground(mesh, {DVec3(0, 1, 2) * length, 18 * length});
        EXPECT_TRUE(found.asked);
        EXPECT_EQ(found.triangles, 2U) << length;
        EXPECT_NEAR(dot3(found.normal, found.normal), 1, 1e-12);
        EXPECT_EQ(in_ground(mesh, found), leaning) << length;
        EXPECT_EQ(ground(mesh, {DVec3(0, 1, 2) * length, 18.01 * length}).triangles, 0U);
    }
    scene::Scene scene;
    scene.mesh = mesh;
    EXPECT_TRUE(facts(scene, FilePlane{{0, 1, 2}, 18}).ground.asked);
    EXPECT_EQ(facts(scene).ground, ground(mesh));
}

TEST(Plan, PicksHowCodesAreMade) {
    SceneFacts facts;
    facts.triangles = 1;
    const FramePlan usual = plan_of(facts);
    EXPECT_EQ(usual.output.encoding, shade::find_encoding("srgb"));
    EXPECT_EQ(usual.output.blend_space, shade::find_blend_space("linear"));
    EXPECT_FALSE(usual.output.dither);
    FrameOptions options;
    options.encode = "square_root";
    options.blend_space = "encoded";
    options.dither = "bayer";
    const FramePlan naive = plan_of(facts, options);
    EXPECT_EQ(naive.output.encoding, shade::find_encoding("square_root"));
    EXPECT_EQ(naive.output.blend_space, shade::find_blend_space("encoded"));
    EXPECT_TRUE(naive.output.dither);
    EXPECT_TRUE(naive.decision("encode")->forced);
    options.blend_space = "gamma";
    const auto refused = plan(options, facts);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().what, HasSubstr("--blend-space gamma"));
    EXPECT_THAT(refused.error().what, HasSubstr("encoded linear"));
}

TEST(Facts, CountWhatTheDataCallsFor) {
    scene::Scene scene;
    scene.mesh = test::empty_mesh();
    scene.textures = {test::checkers()};
    scene::Material unreadable = test::textured(-1);
    scene.materials = {test::plain(Vec3(1)), test::textured(0),
                       test::plain(Vec3(1), {0, 0, 0.1F}, 10), unreadable,
                       test::plain(Vec3(1), Vec3(1), 0)};
    for (const int material : {-1, 0, 1, 1, 1, 2, 3, 4}) // a quad each
        test::add_square(scene.mesh, 1, 0, material);
    test::add_line(scene.mesh, 0, 1);
    test::add_point(scene.mesh, 0);
    const SceneFacts all = facts(scene);
    EXPECT_EQ(all.triangles, 16U);
    EXPECT_EQ(all.lines, 1U);
    EXPECT_EQ(all.points, 1U);
    EXPECT_EQ(all.textured_triangles, 6U);
    EXPECT_EQ(all.specular_triangles, 2U); // Ns 0 is no highlight
    // The last stands for what has no material.
    EXPECT_THAT(all.materials_of.at("texture"),
                ElementsAre(false, true, false, false, false, false));
    EXPECT_THAT(all.materials_of.at("highlight"),
                ElementsAre(false, false, true, false, false, false));
    EXPECT_FALSE(all.vertex_colours);
    scene.mesh.uv.clear(); // a texture without coordinates shows nothing
    EXPECT_FALSE(facts(scene).uv);
    EXPECT_FALSE(plan_of(facts(scene)).decision("texture")->on());
    scene.mesh.colour.resize(scene.mesh.position.size());
    EXPECT_TRUE(facts(scene).vertex_colours);
    EXPECT_EQ(facts(scene::Scene()).triangles, 0U);
    EXPECT_EQ(all.brightest, 1); // of the materials that are used
    scene.mesh.colour.assign(scene.mesh.position.size(), Vec3(0.25F, 0.5F, 0));
    EXPECT_EQ(facts(scene).brightest, 0.5F);
    scene.materials[0].diffuse = Vec3(7);
    EXPECT_EQ(facts(scene).brightest, 1); // no surface gives back more than it gets
}

// A material with every map, whose pictures can be chosen.
scene::Scene mapped(const image::Rgba8& texel, const image::Rgba8& other) {
    scene::Scene scene;
    scene.mesh = test::empty_mesh();
    scene.textures = {{"any", image::Image(2, 1, texel)}};
    scene.textures[0].image.at(1, 0) = other;
    scene.materials = {test::plain(Vec3(1), Vec3(1), 10), test::plain(Vec3(1))};
    scene::Material& m = scene.materials[0];
    m.emission = {0, 0.5F, 0};
    for (std::size_t i = 0; i < shade::kMaps; ++i)
        if (i != shade::kOpacityMap) (m.*shade::map_slots()[i].map).texture = 0;
    test::add_square(scene.mesh, 1, 0, 0);
    test::add_square(scene.mesh, 1, 0, 1);
    return scene;
}

TEST(Plan, RunsTheMapsThatCanChangeAPixel) {
    const FramePlan all = plan_of(facts(mapped({1, 2, 3, 255}, {4, 5, 6, 255})));
    EXPECT_THAT(stages(all), ElementsAre("interpolate perspective", "map diffuse", "map normal",
                                         "map bump", "map specular", "map gloss", "light ambient",
                                         "shading per_pixel", "map emission"));
    for (const char* effect :
         {"normal_map", "bump_map", "specular_map", "gloss_map", "emission", "texture"}) {
        ASSERT_NE(all.decision(effect), nullptr) << effect;
        EXPECT_TRUE(all.decision(effect)->on()) << effect;
        EXPECT_THAT(all.decision(effect)->because, HasSubstr("2 of 4 triangles"));
    }
    // Flat normals, one height, white: nothing to see.
    const image::Rgba8 flat{128, 128, 255, 255}, white{255, 255, 255, 255};
    EXPECT_FALSE(plan_of(facts(mapped(flat, flat))).decision("normal_map")->on());
    EXPECT_FALSE(plan_of(facts(mapped(flat, flat))).decision("bump_map")->on());
    EXPECT_TRUE(plan_of(facts(mapped(flat, white))).decision("normal_map")->on());
    EXPECT_FALSE(plan_of(facts(mapped(white, white))).decision("specular_map")->on());
    EXPECT_FALSE(plan_of(facts(mapped(white, white))).decision("gloss_map")->on());
    // Without a highlight its maps do not run, forced or not.
    FrameOptions matt;
    matt.reflection = "lambert";
    matt.effects = {{"specular_map", true}};
    EXPECT_THAT(stages(plan_of(facts(mapped({1, 2, 3, 255}, {4, 5, 6, 255})), matt)),
                ElementsAre("interpolate perspective", "map diffuse", "map normal", "map bump",
                            "light ambient", "shading per_pixel", "map emission"));
    // Nor where light does not fall on pixels; what is given off shows all the same.
    FrameOptions flat_faces;
    flat_faces.shading = "flat";
    EXPECT_THAT(
        stages(plan_of(facts(mapped({1, 2, 3, 255}, {4, 5, 6, 255})), flat_faces)),
        ElementsAre("interpolate perspective", "map diffuse", "shading flat", "map emission"));
}

TEST(Plan, LaysTexturesOnAModelAsTheUserAsks) {
    scene::Scene scene = mapped({1, 2, 3, 255}, {4, 5, 6, 255});
    EXPECT_FALSE(plan_of(facts(scene)).mapped);
    EXPECT_EQ(plan_of(facts(scene)).decision("mapping")->technique, "uv");
    FrameOptions asked;
    asked.mapping = "sphere";
    EXPECT_EQ(stages(plan_of(facts(scene), asked))[1], "mapping sphere");
    EXPECT_TRUE(plan_of(facts(scene), asked).attributes.object);
    // Without coordinates of its own no picture is laid on by a guess.
    scene.mesh.uv.clear();
    EXPECT_EQ(stages(plan_of(facts(scene), asked))[1], "mapping sphere");
    asked.mapping = "uv"; // which it does not have
    for (const FrameOptions& options : {FrameOptions(), asked}) {
        EXPECT_THAT(stages(plan_of(facts(scene), options)),
                    ElementsAre("interpolate perspective", "light ambient", "shading per_pixel",
                                "map emission"));
        EXPECT_THAT(plan_of(facts(scene), options).decision("normal_map")->because,
                    HasSubstr("no texture coordinates"));
    }
    // What reads no coordinates makes none.
    SceneFacts plain;
    plain.triangles = 5;
    asked.mapping = "sphere";
    EXPECT_THAT(stages(plan_of(plain, asked)),
                ElementsAre("interpolate perspective", "light ambient", "shading per_pixel"));
    EXPECT_FALSE(plan_of(plain, asked).attributes.object);
    asked.mapping = "cone";
    const auto refused = plan(asked, plain);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().what, HasSubstr("cylinder"));
}

TEST(Plan, ComputesTexturesWhereTheUserAsks) {
    SceneFacts facts;
    facts.triangles = 5;
    FrameOptions options;
    options.source = "checker";
    const FramePlan plan = plan_of(facts, options);
    EXPECT_THAT(stages(plan), ElementsAre("interpolate perspective", "mapping box", "map diffuse",
                                          "light ambient", "shading per_pixel"));
    EXPECT_EQ(plan.source, shade::find_source("checker"));
    EXPECT_EQ(plan.filter, nullptr);
    EXPECT_TRUE(plan.attributes.footprint);
    options.effects = {{"texture", false}};
    EXPECT_EQ(plan_of(facts, options).source, nullptr);
    EXPECT_THAT(stages(plan_of(facts, options)),
                ElementsAre("interpolate perspective", "light ambient", "shading per_pixel"));
    options.effects = {{"source", false}};
    const auto refused = frame::plan(options, facts);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().what, HasSubstr("--source NAME"));
}

} // namespace
} // namespace scanout::frame
