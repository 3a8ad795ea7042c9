// Two-sided lighting: which side of a face is lit, and that deciding it once a face instead of at
// every pixel changes no bit.
#include "image/compare.h"
#include "support/scenes.h"

namespace scanout::test {
namespace {

image::Image draw_sides(const Shot& s, shade::Sides sides, shade::LinearPicture& linear) {
    const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                                       s.options.height);
    auto plan = frame::plan(s.options, frame::facts(s.scene));
    EXPECT_TRUE(view && plan);
    plan->sides = sides;
    Jobs jobs(1);
    frame::Renderer renderer(jobs);
    return renderer.render(s.scene, *view, *plan, nullptr, 64, &linear);
}

TEST(TwoSided, DecidedOnceAFaceIsTheSameToTheBit) {
    int compared = 0;
    for (const int samples : {1, 4}) {
        for (Shot s : golden_shots()) {
            if (s.options.aa != "auto") continue; // samples are what this varies
            if (frame::facts(s.scene).topology.reversed_triangles > 0 ||
                s.scene.mesh.triangles() == 0)
                continue;
            s.options.width = 157;
            s.options.height = 113;
            s.options.samples = samples;
            for (const bool mirrored : {false, true}) {
                if (mirrored) s.model.scale.x = -1;
                shade::LinearPicture lane, face;
                const image::Image a = draw_sides(s, shade::Sides::eye, lane),
                                   b = draw_sides(s, shade::Sides::face, face);
                EXPECT_EQ(a, b) << s.name;
                EXPECT_EQ(lane, face) << s.name;
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 60);
}

// A square of two triangles, both with normals on either side of the face: one more on its front,
// one more on its back.
Shot leaning(bool away, bool reversed) {
    Shot s = shot("leaning", 96, 96);
    s.scene.materials = {plain(Vec3(0.8F))};
    s.options.lights = {light_of(scene::LightKind::ambient, 0.02),
                        light_of(scene::LightKind::directional, 0.9)};
    s.options.lights[1].towards = {away ? 1.0 : -1.0, 0, 1};
    geom::Mesh& mesh = s.scene.mesh;
    const float sign = reversed ? -1.0F : 1.0F;
    for (const auto& [x, y] : {std::pair(-0.8F, -0.8F), {0.8F, -0.8F}, {0.8F, 0.8F}, {-0.8F, 0.8F}})
        add_vertex(mesh, {x, y, 0}, Vec3(x < 0 ? -0.8F : 0.0F, 0, x < 0 ? -0.6F : 1.0F) * sign);
    add_triangle(mesh, 0, reversed ? 2 : 1, reversed ? 1 : 2, 0);
    add_triangle(mesh, 0, reversed ? 3 : 2, reversed ? 2 : 3, 0);
    return s;
}

TEST(TwoSided, TurnsAllNormalsOfAFaceTogether) {
    for (const bool away : {false, true}) {
        Shot s = leaning(away, false);
        s.options.effects["two_sided"] = false;
        const image::Image front = draw(s);
        s.options.effects["two_sided"] = true;
        EXPECT_EQ(draw(s), front);
        shade::LinearPicture eye;
        EXPECT_EQ(draw_sides(s, shade::Sides::eye, eye), front);
        // The file may turn all of it over: the eye sees the same.
        Shot turned = leaning(away, true);
        turned.options.effects["two_sided"] = true;
        EXPECT_EQ(draw(turned), front);
        EXPECT_EQ(draw_sides(turned, shade::Sides::eye, eye), front);
    }
}

TEST(TwoSided, IsNotNeededWhereNoBackCanBeSeenAndThenForcingItChangesNoBit) {
    for (const Shot& closed : {solids("solids"), glossy("glossy", "auto")}) {
        const auto plan = frame::plan(closed.options, frame::facts(closed.scene));
        ASSERT_TRUE(plan);
        EXPECT_FALSE(plan->decision("two_sided")->on());
        shade::LinearPicture wanted;
        draw(closed, {.linear = &wanted});
        for (const bool on : {true, false}) {
            Shot forced = closed;
            forced.options.effects["two_sided"] = on;
            shade::LinearPicture got;
            draw(forced, {.linear = &got});
            EXPECT_EQ(got, wanted);
        }
    }
}

// Where backs come to be seen by a choice of depths, the plan knows: without it they are dark.
TEST(TwoSided, IsNeededWhereDepthsShowBacksOfClosedBodies) {
    for (const auto& [axis, name] :
         {std::pair("depth_test", "greater"), {"depth_test", "always"}, {"depth", "fixed_16"}}) {
        Shot s = solids("solids");
        EXPECT_TRUE(frame::ask(s.options, axis, name));
        const auto plan = frame::plan(s.options, frame::facts(s.scene));
        ASSERT_TRUE(plan);
        EXPECT_TRUE(plan->decision("two_sided")->needed) << name;
        const image::Image both = draw(s);
        s.options.effects["two_sided"] = false;
        EXPECT_GT(image::compare(draw(s), both, 8).over_tolerance, 50) << name;
    }
}

TEST(TwoSided, LightsTheInsideOfABowlAndLeavingItOutDoesNot) {
    Shot open = bowl("bowl", frame::Cull::none);
    const auto plan = frame::plan(open.options, frame::facts(open.scene));
    ASSERT_TRUE(plan);
    EXPECT_TRUE(plan->decision("two_sided")->needed);
    const image::Image both = draw(open);
    open.options.effects["two_sided"] = true;
    EXPECT_EQ(draw(open), both);
    open.options.effects["two_sided"] = false;
    const image::Image one = draw(open);
    EXPECT_GT(image::compare(one, both, 8).over_tolerance, 200);
    // What shows its front is the same.
    open.options.cull = frame::Cull::back;
    open.options.effects.clear();
    const image::Image fronts = draw(open);
    int same = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            if (fronts.at(x, y) != open.options.background && both.at(x, y) == one.at(x, y)) ++same;
    EXPECT_GT(same, 200);
    // A face in the eye's back light: its own normal looks away from the key and the fill.
    Shot away = shot("away", 32, 32);
    away.scene.materials = {plain(Vec3(0.8F))};
    add_square(away.scene.mesh, 3, 0, 0);
    away.camera.azimuth_degrees = 180;
    away.options.effects["two_sided"] = false;
    const image::Image dark = draw(away);
    away.options.lights = {light_of(scene::LightKind::ambient, 0.15)};
    EXPECT_EQ(dark, draw(away)) << "ambient light alone";
}

TEST(TwoSided, SaysWhy) {
    const auto because = [](const Shot& s) {
        const auto plan = frame::plan(s.options, frame::facts(s.scene));
        return plan ? plan->decision("two_sided")->because : plan.error().what;
    };
    EXPECT_NE(because(bowl("", frame::Cull::none)).find("open edges"), std::string::npos);
    EXPECT_NE(because(bowl("", frame::Cull::back)).find("--cull back"), std::string::npos);
    EXPECT_NE(because(bowl("", frame::Cull::front)).find("--cull front"), std::string::npos);
    EXPECT_NE(because(solids("")).find("closed"), std::string::npos);
    EXPECT_NE(because(soup("", 50, 1, 1)).find("point to their back"), std::string::npos);
}

} // namespace
} // namespace scanout::test
