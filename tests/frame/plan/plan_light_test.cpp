// What the plan decides about light and shadow, and why.
#include "frame/plan/plan.h"
#include "frame/plans.h"
#include "support/axes.h"
#include "support/scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::frame {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// Unlit vertex colours call for no normals, nor does any material in ambient light alone.
TEST(Plan, WithoutLightFromASideNothingIsDoneAboutNormals) {
    SceneFacts facts;
    facts.triangles = 10;
    facts.vertex_colours = facts.uv = true;
    facts.topology.reversed_triangles = facts.specular_triangles = 5;
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
            EXPECT_FALSE(unlit.vertex_normals);
            EXPECT_TRUE(unlit.attributes.colour);
            for (const char* effect :
                 {"highlight", "two_sided", "normal_map", "bump_map", "specular_map", "gloss_map"})
                EXPECT_FALSE(unlit.decision(effect)->on()) << effect;
        }
    }
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
    facts.shadow_plane.by_user = true;
    EXPECT_THAT(shadow(),
                StartsWith("shadow off: no triangle lies in the plane of --shadow-plane"));
    facts.shadow_plane.triangles = 2;
    EXPECT_THAT(shadow(), StartsWith("shadow projected: 1 light casts"));
    options.effects = {{"shadow", false}};
    EXPECT_TRUE(plan_of(facts, options).decision("shadow")->forced);
    EXPECT_EQ(plan_of(facts, options).shadow.stage, nullptr);
    EXPECT_FALSE(plan_of(facts, options).attributes.position);
    facts.triangles = 0;
    EXPECT_THAT(shadow(), StartsWith("shadow off: nothing is lit"));
}

// A lamp that shines past the model is no light, casts nothing and calls for no tone curve.
// A plane throws no shadow on itself, but depth in coarse steps puts its samples before or behind
// it (found by a random walk: a triangle, 100 of its pixels darker by up to 108 codes).
TEST(Plan, CountsTheVolumesOfAPlaneWhereDepthIsCoarse) {
    SceneFacts facts;
    facts.triangles = 10;
    facts.topology.flat = true;
    FrameOptions options;
    options.lights = {test::light_of(scene::LightKind::directional, 1)};
    options.lights[0].casts = true;
    for (const std::string& depth : test::names_on("depth"))
        for (const std::string shadow : {"map_pcf", "map_soft", "volume"}) {
            options.depth = depth;
            options.shadow = shadow;
            EXPECT_EQ(plan_of(facts, options).decision("shadow")->needed,
                      shadow == "volume" && depth != "reversed")
                << shadow << ' ' << depth;
        }
}

TEST(Plan, ASpotThatMissesTheModelIsOff) {
    SceneFacts facts;
    facts.triangles = facts.topology.open_triangles = 5;
    facts.alpha.of_material = {AlphaClass::opaque};
    scene::View view;
    view.near_distance = 0.01;
    view.translation = view.world_origin = {0, 0, -5};
    FrameOptions options;
    scene::Light spot;
    spot.name = "spot";
    spot.kind = scene::LightKind::spot;
    spot.position = {4, 0, 0};
    spot.outer_degrees = 10;
    spot.power = 3;
    options.lights.push_back(spot);
    for (const bool hits : {true, false}) {
        options.lights.back().target = hits ? DVec3(0) : DVec3(4, 4, 0);
        const auto planned = plan(options, facts, view);
        ASSERT_TRUE(planned);
        EXPECT_EQ(planned->decision("spot_light")->on(), hits);
        EXPECT_EQ(planned->decision("shadow")->on(), hits);
        EXPECT_EQ(planned->decision("tone")->technique, hits ? "shoulder" : "clamp");
        EXPECT_EQ(planned->lights.size(), hits ? 4U : 3U);
        EXPECT_EQ(planned->decision("spot_light")->because,
                  hits ? "1 light: spot" : "its light falls beside the model");
    }
    EXPECT_EQ(plan_of(facts, options).lights.size(), 4U) << "nothing is known of the view";
}

// A mesh's own radius is 0.5 to 1 of its units: how far a lamp of the file is from it in its radii.
TEST(Plan, ALampStandsAsManyRadiiAwayAsItDoesInThePicture) {
    scene::Scene scene;
    scene.mesh = test::empty_mesh();
    test::add_square(scene.mesh, 0.5F);
    scene::View view;
    view.near_distance = 0.01;
    view.translation = view.world_origin = {0, 0, -5};
    FrameOptions options;
    options.lights = {test::light_of(scene::LightKind::spot, 1)};
    options.lights[0].position = {1.5, 0, 0};
    options.lights[0].target = DVec3(1.5, 3, 0);
    options.lights[0].outer_degrees = 60; // the ball's rim is at 48 degrees, or 71
    for (const double radius : {1.0, 0.5}) {
        scene.mesh.radius = radius;
        const auto planned = plan(options, facts(scene), view);
        ASSERT_TRUE(planned);
        EXPECT_EQ(planned->decision("spot_light")->on(), radius == 1) << radius;
    }
}

} // namespace
} // namespace scanout::frame
