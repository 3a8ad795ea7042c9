// How often light is evaluated: what each rung loses (HARD-CASES L5), and what all of them agree
// on.
#include "image/compare.h"
#include "math/rotation.h"
#include "support/scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scanout::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const char* const kRungs[] = {"flat", "gouraud", "per_pixel_raw", "per_pixel"};

// A strip whose normals turn by `span` degrees from left to right, seen straight on without
// foreshortening; all it shows is a highlight of exponent `ns`. The light stands so that the
// highlight is where the normal is turned by `turn`.
std::vector<double> highlight(const std::string& rung, double span, float ns, double turn) {
    Shot s = shot("strip", 129, 9);
    s.scene.materials = {plain(Vec3(0), Vec3(1), ns)};
    add_quad(s.scene.mesh, {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}, {0, 0, 1}, 0);
    for (std::size_t i = 0; i < 4; ++i) {
        const double angle = (i == 1 || i == 2 ? 0.5 : -0.5) * span * kDegree;
        s.scene.mesh.normal[i] = {static_cast<float>(std::sin(angle)), 0,
                                  static_cast<float>(std::cos(angle))};
    }
    s.camera.projection = scene::Projection::orthographic;
    s.camera.fov_degrees = 2 * std::atan(9.0 / 129) / kDegree; // 129 pixels from -1 to 1
    s.camera.distance = 1;
    scene::Light light = light_of(scene::LightKind::directional, 1);
    light.towards = {std::sin(2 * turn * kDegree), 0, std::cos(2 * turn * kDegree)};
    s.options.lights = {light};
    s.options.shading = rung;
    s.options.reflection = "blinn_phong";
    shade::LinearPicture linear;
    draw(s, {.linear = &linear});
    std::vector<double> row;
    for (int x = 0; x < 129; ++x)
        row.push_back(double{linear.at(x, 4)[0]});
    return row;
}

// The largest error against light at every pixel, wherever the light stands.
double error(const std::string& rung, double span, float ns, bool straight_on) {
    double worst = 0;
    for (double turn = straight_on ? 0 : -span; turn <= (straight_on ? 0 : span);
         turn += span / 40) {
        const std::vector<double> got = highlight(rung, span, ns, turn),
                                  wanted = highlight("per_pixel", span, ns, turn);
        for (std::size_t i = 0; i < got.size(); ++i)
            worst = std::max(worst, std::abs(got[i] - wanted[i]));
    }
    return worst;
}

TEST(Shading, LosesAsMuchOfAHighlightAsTheLadderSays) {
    EXPECT_NEAR(error("flat", 11.25, 128, false), 0.61, 0.02);
    EXPECT_NEAR(error("flat", 5.6, 128, false), 0.32, 0.02);
    EXPECT_NEAR(error("gouraud", 11.25, 128, true), 0.46, 0.01);
    EXPECT_NEAR(error("gouraud", 5.6, 128, true), 0.14, 0.01);
    EXPECT_NEAR(error("gouraud", 1.4, 128, true), 0.010, 0.001);
    EXPECT_NEAR(error("gouraud", 2.8, 1024, true), 0.26, 0.01);
    // Normals that are not brought back to length 1 are no better.
    EXPECT_NEAR(error("per_pixel_raw", 11.25, 128, true), 0.46, 0.01);
    EXPECT_NEAR(error("per_pixel_raw", 1.4, 128, true), 0.010, 0.001);
}

TEST(Shading, PerPixelIsTheCosineOfTheInterpolatedNormal) {
    const std::vector<double> row = highlight("per_pixel", 11.25, 128, 0);
    for (int x = 0; x < 129; ++x) {
        // The chord between the two normals, at the pixel's centre.
        const double across = (x + 0.5) / 129 - 0.5, half = 11.25 / 2 * kDegree;
        const double sine = 2 * across * std::sin(half), cosine = std::cos(half);
        EXPECT_NEAR(row[static_cast<std::size_t>(x)],
                    std::pow(cosine / std::hypot(sine, cosine), 128), 1e-4);
    }
}

TEST(Shading, OfAFlatMattFaceInParallelLightIsTheSameOnEveryRung) {
    Shot s = textured_cube("cube", "nearest"); // the texture stays sharp
    s.options.shading = "per_pixel";
    shade::LinearPicture wanted;
    draw(s, {.linear = &wanted});
    for (const char* rung : kRungs) {
        for (const auto projection :
             {scene::Projection::perspective, scene::Projection::orthographic}) {
            s.camera.projection = projection;
            s.options.shading = "per_pixel";
            draw(s, {.linear = &wanted});
            s.options.shading = rung;
            shade::LinearPicture got;
            draw(s, {.linear = &got});
            for (std::size_t i = 0; i < got.pixel.size(); ++i)
                for (std::size_t c = 0; c < 4; ++c)
                    ASSERT_NEAR(got.pixel[i][c], wanted.pixel[i][c], 2e-6) << rung;
        }
    }
}

// A lamp over any corner of an equilateral triangle lights its flat face alike, as its light is
// that of the middle; over the middle it is brighter. Bouknight 1970.
TEST(Shading, OfAFlatFaceIsThatOfItsMiddle) {
    Shot s = shot("triangle", 65, 65);
    s.scene.materials = {plain(Vec3(0.5F), Vec3(0), 0)};
    std::vector<DVec3> places = {{0, 0, 0.6}};
    for (int i = 0; i < 3; ++i) {
        const double angle = i * 120 * kDegree;
        places.push_back({0.9 * std::cos(angle), 0.9 * std::sin(angle), 0.6});
        add_vertex(s.scene.mesh, Vec3(places.back().x, places.back().y, 0), {0, 0, 1});
    }
    add_triangle(s.scene.mesh, 0, 1, 2, 0);
    s.options.shading = "flat";
    std::vector<double> seen;
    for (const DVec3& place : places) {
        scene::Light lamp = light_of(scene::LightKind::point, 1);
        lamp.position = place;
        s.options.lights = {lamp};
        shade::LinearPicture linear;
        draw(s, {.linear = &linear});
        seen.push_back(double{linear.at(32, 32)[0]});
    }
    EXPECT_GT(seen[1], 0.01);
    EXPECT_NEAR(seen[2], seen[1], 1e-5);
    EXPECT_NEAR(seen[3], seen[1], 1e-5);
    EXPECT_GT(seen[0], seen[1] * 1.5);
}

TEST(Shading, OfWhatTheNearPlaneCutsIsTheSameToo) {
    Shot s = near_clip("floor"); // vertices behind the eye
    shade::LinearPicture wanted, got;
    s.options.shading = "per_pixel";
    draw(s, {.linear = &wanted});
    for (const char* rung : kRungs) {
        s.options.shading = rung;
        draw(s, {.linear = &got});
        for (std::size_t i = 0; i < got.pixel.size(); ++i)
            for (std::size_t c = 0; c < 4; ++c)
                ASSERT_NEAR(got.pixel[i][c], wanted.pixel[i][c], 1e-5) << rung;
    }
}

TEST(Shading, OfGouraudIsExactAtTheVertices) {
    // A fine mesh is all vertices: the finer, the nearer.
    double last = 2;
    for (const int steps : {8, 32, 128}) {
        Shot s = shot("ball", 96, 96);
        s.scene.materials = {plain({0.5F, 0.4F, 0.3F}, Vec3(0.5F), 20)};
        add_sphere(s.scene.mesh, Vec3(0), 0.9F, 2 * steps, steps, 0);
        scene::Light lamp = light_of(scene::LightKind::point, 0.9);
        lamp.position = {2, 2, 3};
        s.options.lights = {lamp, light_of(scene::LightKind::ambient, 0.1)};
        shade::LinearPicture wanted, got;
        s.options.shading = "per_pixel";
        draw(s, {.linear = &wanted});
        s.options.shading = "gouraud";
        draw(s, {.linear = &got});
        double worst = 0;
        for (std::size_t i = 0; i < got.pixel.size(); ++i)
            worst = std::max(worst, std::abs(double{got.pixel[i][0]} - double{wanted.pixel[i][0]}));
        EXPECT_LT(worst, last / 3) << steps;
        last = worst;
    }
    EXPECT_LT(last, 0.01);
}

TEST(Shading, OfManySmallTrianglesInABlockLightsEachItself) {
    // More triangles than a vertex group holds, in every order.
    Shot s = shot("dust", 128, 128);
    s.scene.materials = {plain(Vec3(1))};
    Random random(1);
    geom::Mesh& mesh = s.scene.mesh;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const DVec3 n = random.in_cube(1) + DVec3(0, 0, 1.5);
            const auto at = [](int i) { return static_cast<float>(i) / 32 - 1; };
            add_quad(mesh,
                     {{{at(x), at(y), 0},
                       {at(x + 1), at(y), 0},
                       {at(x + 1), at(y + 1), 0},
                       {at(x), at(y + 1), 0}}},
                     Vec3(n / std::sqrt(dot3(n, n))), 0);
        }
    }
    mesh.uv.clear();
    s.camera.projection = scene::Projection::orthographic;
    shade::LinearPicture wanted, got;
    draw(s, {.linear = &wanted});
    s.options.shading = "gouraud";
    draw(s, {.linear = &got});
    for (std::size_t i = 0; i < got.pixel.size(); ++i)
        ASSERT_NEAR(got.pixel[i][1], wanted.pixel[i][1], 2e-6) << i;
}

TEST(Shading, FetchesWhatTheRungReadsAndNothingElse) {
    const auto plan_of = [](const std::string& rung) {
        Shot s = stage("stage", {light_of(scene::LightKind::point, 1),
                                 light_of(scene::LightKind::ambient, 0.1)});
        s.options.shading = rung;
        s.options.tone = "clamp"; // no stage of its own
        return *frame::plan(s.options, frame::facts(s.scene));
    };
    for (const char* rung : {"flat", "gouraud"}) {
        const frame::FramePlan plan = plan_of(rung);
        EXPECT_FALSE(plan.attributes.normal || plan.attributes.position || plan.attributes.ray);
        EXPECT_TRUE(plan.attributes.vertices);
        EXPECT_EQ(plan.vertex_lights.size(), 2U);
        EXPECT_EQ(plan.stages.size(), 2U);
    }
    const frame::FramePlan plan = plan_of("auto");
    EXPECT_TRUE(plan.attributes.normal && plan.attributes.position && plan.attributes.ray);
    EXPECT_FALSE(plan.attributes.vertices);
    EXPECT_TRUE(plan.vertex_lights.empty());
}

// Gouraud's light is an attribute of the vertices like any other, also where the near plane cuts
// the triangle: a scene whose vertices have that light as their colour looks the same.
TEST(Shading, LightAtVerticesIsNotCutByTheNearPlane) {
    Shot lit = shot("floor", 97, 61);
    lit.scene.materials = {plain(Vec3(1))};
    geom::Mesh& mesh = lit.scene.mesh;
    add_quad(mesh, {{{-2, -0.3F, 2}, {2, -0.3F, 2.5F}, {2, -0.3F, -3}, {-2, -0.3F, -2}}}, {0, 1, 0},
             0);
    const DVec3 towards = normalized(DVec3(0.2, 0.9, 0.3));
    std::vector<Vec3> light;
    for (std::size_t i = 0; i < mesh.normal.size(); ++i) {
        const double lean = 0.35 * static_cast<double>(i) - 0.5;
        const DVec3 n = normalized(DVec3(lean, 1, 0.5 - lean * lean));
        mesh.normal[i] = Vec3(n);
        light.emplace_back(static_cast<float>(std::max(0.0, dot3(n, towards))));
    }
    lit.camera.eye = DVec3(0.1, 0.4, 0.3);
    lit.camera.target = DVec3(0.1, 0, -1);
    lit.options.shading = "gouraud";
    scene::Light sun = light_of(scene::LightKind::directional, 1);
    sun.frame = scene::LightFrame::world;
    sun.towards = towards;
    lit.options.lights = {sun};
    Shot coloured = lit;
    coloured.scene.mesh.colour = light;
    coloured.options.shading = "per_pixel";
    coloured.options.lights = {light_of(scene::LightKind::ambient, 1)};
    shade::LinearPicture got, wanted;
    draw(lit, {.linear = &got});
    draw(coloured, {.linear = &wanted});
    double worst = 0, least = 1, most = 0;
    for (int y = 0; y < 61; ++y)
        for (int x = 0; x < 97; ++x) {
            const double w = double{wanted.at(x, y)[0]};
            worst = std::max(worst, std::abs(double{got.at(x, y)[0]} - w));
            least = std::min(least, w);
            most = std::max(most, w);
        }
    EXPECT_LE(worst, 2e-6);
    EXPECT_GT(most - least, 0.1);
}

// Without light from a side the plan takes what normals are for out of a frame: no bit of it
// changes, against the same frame with all of it forced on.
TEST(Shading, InAmbientLightNormalsAndWhatReadsThemChangeNoBit) {
    int with_normals = 0;
    for (Shot s : golden_shots()) {
        if (s.options.stencil == "overdraw" || s.scene.mesh.triangles() == 0) continue;
        s.options.lights = {light_of(scene::LightKind::ambient, 0.7)};
        shade::LinearPicture off, on;
        const image::Image without = draw(s, {.linear = &off});
        s.options.effects["highlight"] = true;
        s.options.effects.erase("two_sided");
        EXPECT_EQ(draw(s, {.linear = &on}), without) << s.name;
        EXPECT_EQ(on, off) << s.name;
        ++with_normals;
    }
    EXPECT_GT(with_normals, 60);
}

} // namespace
} // namespace scanout::test
