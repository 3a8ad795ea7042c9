// What a scene's data call for.
#include "frame/plan.h"
#include "frame/plans.h"
#include "support/scenes.h"

#include <algorithm>
#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::frame {
namespace {

using testing::ElementsAre;

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

} // namespace
} // namespace scanout::frame
