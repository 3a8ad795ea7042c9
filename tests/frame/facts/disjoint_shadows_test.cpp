// Shadows that one body cannot throw on another are not looked for: against those that are drawn
// all the same.
#include "frame/facts/shadow_cull_facts.h"
#include "frame/plan/plan.h"
#include "math/rotation.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace scanout::frame {
namespace {

using scene::LightKind;

// Faceted: what the light meets edge-on is as dark as its shadow.
geom::Mesh faceted(const geom::Mesh& mesh) {
    geom::Mesh made = test::empty_mesh();
    for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
        std::uint32_t corner[3];
        for (std::size_t k = 0; k < 3; ++k)
            corner[k] = test::add_vertex(made, mesh.position[mesh.index[i + k]]);
        const DVec3 a(made.position[corner[0]]), b(made.position[corner[1]]),
            c(made.position[corner[2]]);
        for (const std::uint32_t v : corner)
            made.normal[v] = Vec3(normalized(cross3(b - a, c - a)));
        test::add_triangle(made, corner[0], corner[1], corner[2], 0);
    }
    return made;
}

// Boxes, squares and balls of few faces, two or three, somewhere in the unit ball.
geom::Mesh some_bodies(test::Random& random) {
    geom::Mesh mesh = test::empty_mesh();
    const int bodies = random.whole(2, 3);
    for (int i = 0; i < bodies; ++i) {
        const std::size_t first = mesh.position.size();
        const auto size = static_cast<float>(random.in(0.02, 0.2));
        const int kind = random.whole(0, 2);
        if (kind == 0) test::add_cube(mesh, size, 0);
        if (kind == 1) test::add_sphere(mesh, Vec3(0), size, 6, 4, 0);
        if (kind == 2) test::add_square(mesh, size, 0, 0);
        const Vec3 at(random.in_cube(0.7));
        for (std::size_t v = first; v < mesh.position.size(); ++v)
            mesh.position[v] = mesh.position[v] + at;
    }
    return faceted(mesh);
}

TEST(DisjointShadows, WhatStandsApartThrowsNoShadowOnOneAnother) {
    test::Random random(77);
    int apart = 0, shading = 0;
    for (int round = 0; round < 1200; ++round) {
        test::Shot s = test::shot("bodies");
        s.scene.materials = {test::plain(Vec3(0.7F))};
        s.scene.mesh = some_bodies(random);
        s.camera.azimuth_degrees = random.in(0, 360);
        s.camera.elevation_degrees = random.in(-80, 80);
        constexpr LightKind kKinds[] = {LightKind::directional, LightKind::point, LightKind::spot};
        scene::Light lamp = test::light_of(kKinds[round % 3], 0.9);
        lamp.casts = true;
        lamp.towards = random.in_cube(1);
        lamp.position = random.in_cube(round % 2 == 0 ? 1 : 4);
        lamp.outer_degrees = 80;
        s.options.lights = {lamp, test::light_of(LightKind::ambient, 0.1)};
        s.options.tone = "clamp";
        constexpr const char* kTechniques[] = {"volume", "map_pcf", "map"};
        s.options.shadow = kTechniques[round / 3 % 3];
        s.options.shadow_size = s.options.shadow == "volume" ? 4096 : 256; // room for no filter
        FrameStats stats;
        const image::Image planned = test::draw(s, {.stats = &stats});
        const bool looked = stats.shadow_bytes > 0;
        s.options.effects["shadow"] = true;
        const image::Image forced = test::draw(s, {.stats = &stats});
        EXPECT_GT(stats.shadow_bytes, 0U);
        EXPECT_EQ(forced, planned) << round;
        s.options.effects["shadow"] = false;
        apart += looked ? 0 : 1;
        shading += test::draw(s) == forced ? 0 : 1;
    }
    EXPECT_GT(apart, 100);
    EXPECT_GT(shading, 50);
}

// A face that turns away from a lamp lies in its own shadow, though the side of it that the file
// calls its front may be lit. Smooth normals take the light over a convex body's edge.
TEST(DisjointShadows, FallsNotOnConvexBodiesWhateverTheirNormals) {
    test::Shot round = test::shot("round"); // a cube that is shaded like a ball
    round.scene.materials = {test::plain(Vec3(0.7F))};
    test::add_cube(round.scene.mesh, 0.5F, 0);
    round.scene.mesh.uv.clear();
    round.camera.azimuth_degrees = 200; // a face that turns away from the lamp
    for (std::size_t i = 0; i < round.scene.mesh.normal.size(); ++i)
        round.scene.mesh.normal[i] = Vec3(normalized(DVec3(round.scene.mesh.position[i])));
    test::Shot sheet = test::shot("sheet");
    sheet.scene.materials = round.scene.materials;
    test::add_square(sheet.scene.mesh, 0.8F, 0, 0);
    sheet.scene.mesh.uv.clear();
    sheet.options.effects["two_sided"] = false;
    sheet.camera.azimuth_degrees = 200; // its back, and the lamp stands before its front
    for (test::Shot s : {round, sheet}) {
        scene::Light lamp = test::light_of(LightKind::directional, 0.9);
        lamp.casts = true;
        s.options.lights = {lamp, test::light_of(LightKind::ambient, 0.1)};
        FrameStats stats;
        const image::Image planned = test::draw(s, {.stats = &stats});
        EXPECT_EQ(stats.shadow_bytes == 0, s.name != "sheet") << s.name;
        s.options.effects["shadow"] = true;
        EXPECT_EQ(test::draw(s), planned) << s.name;
        s.options.effects["shadow"] = false;
        EXPECT_EQ(test::draw(s), planned) << s.name; // nothing lies between the lamp and a sheet
    }
}

// Of a convex body whose backs show, the near side stands between the lamp and the far one.
TEST(DisjointShadows, FallsOnTheFarSideOfABox) {
    test::Shot s = test::shot("far side");
    s.scene.materials = {test::plain(Vec3(0.7F))};
    test::add_cube(s.scene.mesh, 0.5F, 0);
    s.scene.mesh.uv.clear();
    s.camera.elevation_degrees = 20;
    s.options.depth_test = "greater";
    scene::Light lamp = test::light_of(LightKind::directional, 0.9);
    lamp.casts = true;
    s.options.lights = {lamp, test::light_of(LightKind::ambient, 0.1)};
    const image::Image planned = test::draw(s);
    s.options.effects["shadow"] = true;
    EXPECT_EQ(test::draw(s), planned);
    s.options.effects["shadow"] = false;
    EXPECT_NE(test::draw(s), planned);
}

TEST(DisjointShadows, IsToldFromBoxesAndTheLight) {
    scene::View view;
    view.near_distance = 0.01;
    view.translation = {0, 0, -3};
    const geom::Box left{DVec3(-0.9, -0.1, -0.1), DVec3(-0.7, 0.1, 0.1)},
        right{DVec3(0.7, -0.1, -0.1), DVec3(0.9, 0.1, 0.1)};
    const geom::Box both[] = {left, right};
    const ShadowMapTexels map{1024, 3};
    scene::ViewLight light;
    light.towards = {0, 1, 0};
    EXPECT_TRUE(shadows_are_disjoint(both, light, view, map));
    EXPECT_TRUE(shadows_are_disjoint({&left, 1}, light, view, map));
    light.towards = {1, 0, 0}; // from the right: one stands in the other's light
    EXPECT_FALSE(shadows_are_disjoint(both, light, view, map));
    light.towards = {0, 1, 0};
    EXPECT_FALSE(shadows_are_disjoint(both, light, view, {32, 9}))
        << "the filter is as wide as the gap";
    light.size = 0.1F;
    EXPECT_FALSE(shadows_are_disjoint(both, light, view, map));
    light.size = 0;
    light.kind = LightKind::point;
    light.position = {0, 0, -3}; // between them
    EXPECT_TRUE(shadows_are_disjoint(both, light, view, map));
    light.position = {3, 0, -3}; // beyond the right one
    EXPECT_FALSE(shadows_are_disjoint(both, light, view, map));
    light.position = {3, 2, -3};
    EXPECT_TRUE(shadows_are_disjoint(both, light, view, map));
    view.near_distance = 0; // not known
    EXPECT_FALSE(shadows_are_disjoint(both, light, view, map));
}

} // namespace
} // namespace scanout::frame
