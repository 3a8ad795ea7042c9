#include "frame/plan/ignored_options.h"
#include "frame/plan/plan.h"
#include "frame/plans.h"
#include "rows.h"
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

TEST(Plan, RunsOnlyWhatTheSceneCallsFor) {
    SceneFacts facts;
    facts.triangles = 10;
    EXPECT_THAT(stages(plan_of(facts)),
                ElementsAre("interpolate perspective", "light ambient", "shading per_pixel"));
    EXPECT_FALSE(plan_of(facts).attributes.uv);
    EXPECT_FALSE(plan_of(facts).attributes.colour);
    EXPECT_TRUE(plan_of(facts).attributes.normal);
    facts.mapped_triangles[shade::kDiffuseMap] = 3;
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
    facts.triangles = facts.mapped_triangles[shade::kDiffuseMap] = facts.specular_triangles = 10;
    facts.uv = true;
    FrameOptions options;
    options.texture = "nearest";
    options.reflection = "lambert";
    EXPECT_THAT(stages(plan_of(facts, options)),
                ElementsAre("interpolate perspective", "map diffuse", "light ambient",
                            "shading per_pixel"));
    EXPECT_EQ(plan_of(facts, options).filter, find_row(shade::texture::kRows, "nearest"));
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
    facts.specular_triangles = facts.by_ks.specular_triangles = 7;
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

TEST(Plan, KnowsTheOptionsThatItIgnores) {
    SceneFacts facts;
    facts.triangles = 10;
    const auto ignored = [&](const FrameOptions& options) {
        return ignored_options(plan_of(facts, options));
    };
    FrameOptions options;
    EXPECT_THAT(ignored(options), testing::IsEmpty());
    options.effects = {{"point_light", true}, {"spot_light", false}};
    options.shadow = "volume"; // nothing casts
    EXPECT_THAT(ignored(options),
                testing::UnorderedElementsAre(StartsWith("point_light"), StartsWith("shadow")));
    options.lights = {test::light_of(scene::LightKind::point, 1)};
    options.lights.back().casts = true;
    EXPECT_THAT(ignored(options), testing::IsEmpty());
    options.shading = "flat";
    EXPECT_THAT(ignored(options), ElementsAre(StartsWith("shadow")));
}

TEST(Plan, GivesAReasonForEveryDecision) {
    SceneFacts facts;
    facts.triangles = 40;
    facts.mapped_triangles[shade::kDiffuseMap] = 30;
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
        EXPECT_TRUE(decision.on() == decision.needed || decision.choice) << decision.effect;
        EXPECT_TRUE(decision.on() || !decision.needed) << decision.effect;
        EXPECT_FALSE(decision.forced);
    }
}

TEST(Plan, TheUserForcesAnEffectOnOrOff) {
    SceneFacts facts;
    facts.triangles = facts.mapped_triangles[shade::kDiffuseMap] = facts.specular_triangles = 7;
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
    facts.triangles = facts.mapped_triangles[shade::kDiffuseMap] = 7;
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

TEST(Plan, PicksHowCodesAreMade) {
    SceneFacts facts;
    facts.triangles = 1;
    const FramePlan usual = plan_of(facts);
    EXPECT_EQ(usual.output.encoding, find_row(shade::encode::kRows, "srgb"));
    EXPECT_EQ(usual.output.blend_space, find_row(shade::blend_space::kRows, "linear"));
    EXPECT_FALSE(usual.output.dither);
    FrameOptions options;
    options.encode = "square_root";
    options.blend_space = "encoded";
    options.dither = "bayer";
    const FramePlan naive = plan_of(facts, options);
    EXPECT_EQ(naive.output.encoding, find_row(shade::encode::kRows, "square_root"));
    EXPECT_EQ(naive.output.blend_space, find_row(shade::blend_space::kRows, "encoded"));
    EXPECT_TRUE(naive.output.dither);
    EXPECT_EQ(usual.decision("dither")->technique, "none");
    options.bits = 5; // dithered where they are made of whole codes, and not before
    EXPECT_FALSE(plan_of(facts, options).output.dither);
    EXPECT_EQ(plan_of(facts, options).decision("dither")->technique, "bayer");
    options.dither = "none";
    EXPECT_EQ(plan_of(facts, options).decision("dither")->technique, "none");
    options.dither = "auto";
    EXPECT_EQ(plan_of(facts, options).decision("dither")->technique, "bayer");
    EXPECT_THAT(plan_of(facts, options).decision("dither")->because, HasSubstr("5 bits"));
    EXPECT_TRUE(naive.decision("encode")->forced);
    options.blend_space = "gamma";
    const auto refused = plan(options, facts);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().what, HasSubstr("--blend-space gamma"));
    EXPECT_THAT(refused.error().what, HasSubstr("encoded linear"));
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
        if (i != shade::kOpacityMap) (m.*shade::map_slots()[i].map).edit().texture = 0;
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
    EXPECT_EQ(plan.source, find_row(shade::source::kRows, "checker"));
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

// Alpha is interpolated exactly, whatever the colours are.
TEST(Plan, NamesEveryTechniqueThatRunsOnce) {
    SceneFacts facts;
    facts.triangles = facts.mapped_triangles[shade::kDiffuseMap] = 4;
    facts.uv = true;
    facts.alpha.cut_out_triangles = 4;
    facts.alpha.of_material = {AlphaClass::opaque, AlphaClass::cut_out};
    facts.alpha.maps = {{}, {true, false}};
    for (const char* interpolate : {"auto", "affine"}) {
        FrameOptions options;
        options.interpolate = interpolate;
        const std::vector<std::string> names = techniques(plan_of(facts, options));
        for (const std::string& name : names)
            EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
        EXPECT_THAT(names, testing::Contains("interpolate perspective"));
    }
}

// HARD-CASES Z6: nothing in view, nothing to do.
TEST(Plan, NothingRunsForAModelThatIsOutOfView) {
    test::Shot s = test::solids("balls");
    s.scene.materials[0].opacity = 0.5F;
    const SceneFacts found = facts(s.scene);
    FrameOptions options = s.options;
    options.lights[0].casts = true;
    int seen = 0;
    for (const auto projection : {scene::Projection::perspective, scene::Projection::orthographic})
        for (const DVec3& move : {DVec3(0), DVec3(9, 0, 0), DVec3(-9, 0, 0), DVec3(0, 9, 0),
                                  DVec3(0, -9, 0), DVec3(0, 0, 90)}) {
            s.camera.projection = projection;
            s.camera.azimuth_degrees = s.camera.elevation_degrees = 0;
            const auto view =
                scene::make_view(s.scene.mesh, {}, {}, s.camera, {}, options.width, options.height);
            ASSERT_TRUE(view);
            scene::View moved = *view;
            moved.translation += move;
            const auto planned = plan(options, found, moved);
            ASSERT_TRUE(planned);
            const bool behind = move.z > 0 && projection == scene::Projection::orthographic;
            if (move == DVec3(0) || behind) { // a parallel view has no front
                ++seen;
                EXPECT_TRUE(planned->decision("shadow")->on());
                continue;
            }
            EXPECT_EQ(planned->shadow.stage, nullptr);
            EXPECT_TRUE(planned->lights.empty());
            for (const Decision& d : planned->decisions) {
                if (d.choice) continue;
                EXPECT_FALSE(d.on()) << d.effect;
                EXPECT_EQ(d.because, "nothing of the model is in view");
            }
        }
    EXPECT_EQ(seen, 3);
}

TEST(Plan, WithoutLightNoPictureIsRead) {
    SceneFacts facts;
    facts.triangles = facts.mapped_triangles[shade::kDiffuseMap] = 7;
    facts.uv = true;
    FrameOptions options;
    for (scene::Light& light : options.lights)
        light.power = 0;
    EXPECT_EQ(to_string(*plan_of(facts, options).decision("texture")),
              "texture off: no light shines");
    EXPECT_FALSE(plan_of(facts, options).decision("two_sided")->on());
    options.lights.back().power = 0.01;
    EXPECT_TRUE(plan_of(facts, options).decision("texture")->on());
}

// What is forced on where nothing calls for it runs, or it says that it does not.
TEST(Plan, OpaqueTrianglesAreBlendedOnlyWhereThatChangesNothing) {
    SceneFacts facts;
    facts.triangles = 7;
    facts.alpha.of_material = {AlphaClass::opaque};
    facts.alpha.maps.resize(1);
    const auto blends = [&](const FrameOptions& options) {
        const FramePlan planned = plan_of(facts, options);
        EXPECT_EQ(planned.transparency.blended == nullptr,
                  planned.decision("blending")->because.find("stay as they are") !=
                      std::string::npos);
        return planned.transparency.blended != nullptr;
    };
    FrameOptions options;
    options.effects = {{"blending", true}};
    EXPECT_TRUE(blends(options));
    for (const auto& [axis, name] : {std::pair("depth_test", "greater"),
                                     {"depth_test", "less_equal"},
                                     {"blend", "multiply"},
                                     {"transparency", "sorted"},
                                     {"aa", "area"},
                                     {"aa", "tent"},
                                     {"aa", "gaussian"}}) {
        FrameOptions other = options;
        ASSERT_TRUE(ask(other, axis, name));
        EXPECT_FALSE(blends(other)) << name;
    }
    const auto cuts = [&](const char* transparency, const char* aa) {
        options.transparency = transparency;
        options.aa = aa;
        options.effects = {{"cut_out", true}};
        return !plan_of(facts, options).transparency.alpha_modes.empty();
    };
    EXPECT_TRUE(cuts("auto", "auto"));
    EXPECT_TRUE(cuts("auto", "tent"));
    EXPECT_FALSE(cuts("auto", "area"));
    EXPECT_TRUE(cuts("exact", "auto"));
    EXPECT_FALSE(cuts("exact", "tent"));
    EXPECT_FALSE(cuts("sorted", "auto"));
}

TEST(Plan, AShadowThatIsForcedOnIsDrawnWhereverOneCanBe) {
    SceneFacts facts;
    facts.triangles = 12;
    facts.topology.closed = true;
    facts.topology.convex_components = {{DVec3(-0.5), DVec3(0.5)}};
    facts.alpha.of_material = {AlphaClass::opaque};
    FrameOptions options;
    options.lights[0].casts = true;
    scene::View outside;
    outside.near_distance = 0.01;
    outside.translation = {0, 0, -5};
    outside.half_width = outside.half_height = 1;
    auto planned = plan(options, facts, outside);
    ASSERT_TRUE(planned);
    EXPECT_FALSE(planned->decision("shadow")->on());
    EXPECT_EQ(planned->shadow.stage, nullptr);
    options.effects = {{"shadow", true}};
    planned = plan(options, facts, outside);
    ASSERT_TRUE(planned);
    EXPECT_TRUE(planned->decision("shadow")->forced);
    EXPECT_NE(planned->shadow.stage, nullptr);
    options.lights[0].casts = false;
    planned = plan(options, facts, outside);
    ASSERT_TRUE(planned);
    EXPECT_EQ(planned->shadow.stage, nullptr) << "no light casts";
}

} // namespace
} // namespace scanout::frame
