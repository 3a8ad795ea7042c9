// What a scene's data call for.
#include "frame/plan/plan.h"
#include "frame/plans.h"
#include "math/srgb.h"
#include "support/scenes.h"

#include <algorithm>
#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::frame {
namespace {

using testing::ElementsAre;

TEST(Facts, FindTheFloorWhicheverAxisIsUp) {
    EXPECT_EQ(find_shadow_plane(geom::Mesh()).triangles, 0U);
    for (int up = 0; up < 3; ++up) {
        for (const float side : {-1.0F, 1.0F}) {
            geom::Mesh mesh = test::empty_mesh();
            test::add_sphere(mesh, Vec3(0), 0.3F, 12, 6);
            EXPECT_EQ(find_shadow_plane(mesh).triangles, 0U);
            std::array<Vec3, 4> floor;
            for (std::size_t i = 0; i < 4; ++i) {
                floor[i][up] = side * 0.4F;
                floor[i][(up + 1) % 3] = i == 0 || i == 3 ? -1.0F : 1.0F;
                floor[i][(up + 2) % 3] = i < 2 ? -1.0F : 1.0F;
            }
            test::add_quad(mesh, floor, {0, 0, 1});
            const ShadowPlane found = find_shadow_plane(mesh);
            DVec3 axis(0);
            axis[up] = 1;
            EXPECT_EQ(found.normal, axis);
            EXPECT_EQ(found.offset, double{side * 0.4F});
            EXPECT_EQ(found.triangles, 2U);
            EXPECT_FALSE(found.by_user);
            std::vector<std::uint8_t> in(mesh.triangles(), 0);
            in[in.size() - 1] = in[in.size() - 2] = 1;
            EXPECT_EQ(in_shadow_plane(mesh, found), in);
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
        const ShadowPlane found = find_shadow_plane(mesh, {DVec3(0, 1, 2) * length, 18 * length});
        EXPECT_TRUE(found.by_user);
        EXPECT_EQ(found.triangles, 2U) << length;
        EXPECT_NEAR(dot3(found.normal, found.normal), 1, 1e-12);
        EXPECT_EQ(in_shadow_plane(mesh, found), leaning) << length;
        EXPECT_EQ(find_shadow_plane(mesh, {DVec3(0, 1, 2) * length, 18.01 * length}).triangles, 0U);
    }
    scene::Scene scene;
    scene.mesh = mesh;
    EXPECT_TRUE(facts(scene, FilePlane{{0, 1, 2}, 18}).shadow_plane.by_user);
    EXPECT_EQ(facts(scene).shadow_plane, find_shadow_plane(mesh));
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
    EXPECT_EQ(all.mapped_triangles[shade::kDiffuseMap], 6U);
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

TEST(Facts, TheBrightestTexelCountsWhereMapsAreRead) {
    scene::Scene scene;
    scene.mesh = test::empty_mesh();
    scene.textures = {{"dim.png", image::Image(2, 2, {150, 20, 0, 255})}};
    scene::Material dim = test::textured(0);
    dim.diffuse = {0.5F, 1, 1};
    scene.materials = {dim, test::plain(Vec3(0.125F))};
    test::add_square(scene.mesh, 1, 0, 0);
    test::add_square(scene.mesh, 1, 0, 1);
    EXPECT_EQ(facts(scene).brightest, 1);
    EXPECT_EQ(facts(scene).brightest_mapped, 0.5F * srgb_decode(std::uint8_t{150}));
    scene.materials[1].diffuse = Vec3(0.75F); // has no map
    EXPECT_EQ(facts(scene).brightest_mapped, 0.75F);
}

// With Pr a material reflects by its roughness, unless the user has it reflect by Ks and Ns.
TEST(Facts, MapsOfKsAndNsCountWherePhysicalMaterialsReflectByThem) {
    scene::Scene scene;
    scene.mesh = test::empty_mesh();
    scene.textures = {test::checkers()};
    scene::Material rough = test::plain(Vec3(0.3F), Vec3(0.8F), 20);
    rough.roughness = 0.4F;
    scene::Material mapped = rough;
    mapped.map_specular = mapped.map_shininess = test::textured(0).map_diffuse;
    scene::Material matt = mapped;
    matt.specular = Vec3(0);
    scene.materials = {mapped, rough, matt};
    for (const int material : {0, 1, 1, 2})
        test::add_square(scene.mesh, 1, 0, material);
    const SceneFacts found = facts(scene);
    const auto on = [&](const char* effect, const char* reflection) {
        FrameOptions options;
        options.reflection = reflection;
        return plan_of(found, options).decision(effect)->on();
    };
    for (const char* effect : {"specular_map", "gloss_map"}) {
        for (const char* model : {"phong", "blinn_phong", "blinn_phong_normalised"})
            EXPECT_TRUE(on(effect, model)) << effect << ' ' << model;
        for (const char* model : {"auto", "ggx", "lambert"})
            EXPECT_FALSE(on(effect, model)) << effect << ' ' << model;
    }
    EXPECT_EQ(found.specular_triangles, 8U);
    EXPECT_EQ(found.by_ks.specular_triangles, 6U);
    FrameOptions options;
    EXPECT_THAT(*materials_calling(found, plan_of(found, options), "gloss_map"),
                ElementsAre(false, false, false, false));
    options.reflection = "phong";
    EXPECT_THAT(*materials_calling(found, plan_of(found, options), "gloss_map"),
                ElementsAre(true, false, false, false));
}

// A material with one map, the picture of which is of one colour but for its first texel.
scene::Scene mapped(scene::Material material, scene::MaterialMap scene::Material::*map,
                    const image::Rgba8& rest, const image::Rgba8& first) {
    scene::Scene scene;
    scene.mesh = test::empty_mesh();
    scene.textures = {{"map.png", image::Image(4, 4)}};
    image::Image& picture = scene.textures[0].image;
    std::fill(picture.pixels().begin(), picture.pixels().end(), rest);
    picture.pixels()[0] = first;
    (material.*map).edit().texture = 0;
    (material.*map).edit().path = "map.png";
    scene.materials = {std::move(material)};
    test::add_square(scene.mesh, 1, 0, 0);
    return scene;
}

constexpr image::Rgba8 kWhite{255, 255, 255, 255}, kBlack{0, 0, 0, 255};

std::vector<std::string> effects_on(const scene::Scene& scene, const FrameOptions& options) {
    std::vector<std::string> on;
    for (const Decision& d : plan_of(facts(scene), options).decisions)
        if (!d.choice && d.on()) on.push_back(d.effect);
    return on;
}

TEST(Facts, LookAtWhatMapsHoldAndWhatTheyAreMultipliedWith) {
    const image::Rgba8 grey{7, 7, 7, 255};
    scene::Material red = test::plain({0.5F, 0, 0}), dark = test::plain(Vec3(0));
    scene::Material lamp = dark, shiny = test::plain(Vec3(0), {0.5F, 0, 0}, 40);
    lamp.emission = {0, 0.5F, 0};
    using M = scene::Material;
    const struct {
        const char* what;
        M material;
        scene::MaterialMap M::*map;
        image::Rgba8 rest, first; // in `first` alone is anything that matters
        const char* effect;
        bool otherwise; // whether the effect is on where `first` is as the rest
    } rows[] = {
        {"map_Kd", red, &M::map_diffuse, kWhite, grey, "texture", false},
        {"map_Kd, red alone", red, &M::map_diffuse, {255, 0, 0, 255}, kBlack, "texture", false},
        {"map_Kd of one colour", red, &M::map_diffuse, grey, kWhite, "texture", true},
        {"map_Kd lets light through",
         red,
         &M::map_diffuse,
         kWhite,
         {255, 255, 255, 9},
         "blending",
         false},
        {"map_Ke", lamp, &M::map_emission, {255, 0, 255, 255}, kWhite, "emission", false},
        {"map_Ke is white", lamp, &M::map_emission, kWhite, kBlack, "emission", true},
        {"map_Ks", shiny, &M::map_specular, {0, 255, 255, 255}, kWhite, "highlight", false},
        {"map_Ks is white", shiny, &M::map_specular, kWhite, grey, "specular_map", false},
        {"map_Ns", shiny, &M::map_shininess, kBlack, grey, "highlight", false},
        {"map_Ns is white", shiny, &M::map_shininess, kWhite, grey, "gloss_map", false},
        {"norm", red, &M::map_normal, {128, 128, 9, 255}, kWhite, "normal_map", false},
        {"map_bump", red, &M::map_bump, grey, kWhite, "bump_map", false},
        {"map_Kd is black",
         red,
         &M::map_diffuse,
         kBlack,
         {9, 0, 0, 255},
         "directional_light",
         false},
        {"map_Kd is black, in red",
         red,
         &M::map_diffuse,
         {0, 255, 0, 255},
         kWhite,
         "directional_light",
         false},
    };
    FrameOptions options;
    for (const auto& row : rows) {
        SCOPED_TRACE(row.what);
        const auto with = effects_on(mapped(row.material, row.map, row.rest, row.first), options);
        const auto without = effects_on(mapped(row.material, row.map, row.rest, row.rest), options);
        EXPECT_THAT(with, testing::Contains(row.effect));
        EXPECT_EQ(std::count(without.begin(), without.end(), row.effect), row.otherwise ? 1 : 0);
    }
    // What is multiplied with nothing is nothing, whatever the picture holds.
    EXPECT_THAT(effects_on(mapped(dark, &M::map_diffuse, grey, kWhite), options), ElementsAre());
    EXPECT_THAT(effects_on(mapped(dark, &M::map_normal, grey, kWhite), options), ElementsAre());
    EXPECT_THAT(effects_on(mapped(dark, &M::map_emission, grey, kWhite), options), ElementsAre());
    EXPECT_THAT(effects_on(mapped(dark, &M::map_bump, grey, kWhite), options), ElementsAre());
}

TEST(Facts, NoMapBlackensAnythingWithoutCoordinates) {
    scene::Material m = test::plain(Vec3(0.5F), Vec3(0.5F), 40);
    m.emission = Vec3(0.5F);
    for (const auto map : {&scene::Material::map_diffuse, &scene::Material::map_specular,
                           &scene::Material::map_emission}) {
        scene::Scene scene = mapped(m, map, kBlack, kBlack);
        scene.mesh.uv.clear();
        const SceneFacts found = facts(scene);
        EXPECT_EQ(found.specular_triangles, 2U);
        EXPECT_EQ(found.emitting_triangles, 2U);
        EXPECT_FALSE(found.black_by_maps);
    }
}

TEST(Facts, ATextureThatIsForcedOffBlackensNothing) {
    const scene::Scene scene =
        mapped(test::plain(Vec3(0.5F)), &scene::Material::map_diffuse, kBlack, kBlack);
    FrameOptions options;
    EXPECT_FALSE(plan_of(facts(scene), options).decision("directional_light")->on());
    options.effects = {{"texture", false}};
    EXPECT_TRUE(plan_of(facts(scene), options).decision("directional_light")->on());
    options.effects.clear();
    options.source = "checker"; // in the map's place
    EXPECT_TRUE(plan_of(facts(scene), options).decision("directional_light")->on());
}

TEST(Facts, TexturesOfOneColourHaveNoMipmapsAndTheCheapestFilter) {
    for (const image::Rgba8& first : {kBlack, kWhite}) {
        scene::Scene scene =
            mapped(test::plain(Vec3(0.5F)), &scene::Material::map_diffuse, kBlack, first);
        for (auto& uv : scene.mesh.uv)
            uv *= 1e6F;
        FrameOptions options;
        options.width = options.height = 64;
        const auto view = scene::make_view(scene.mesh, {}, {}, {}, {}, 64, 64);
        ASSERT_TRUE(view);
        const auto planned = plan(options, facts(scene), *view);
        ASSERT_TRUE(planned);
        EXPECT_EQ(planned->decision("mipmaps")->on(), first == kWhite);
        EXPECT_EQ(planned->filter->card.name, first == kWhite ? "trilinear" : "nearest");
    }
}

TEST(Facts, WhatIsNeverDrawnCallsForNothing) {
    scene::Scene scene =
        mapped(test::plain(Vec3(0.5F)), &scene::Material::map_diffuse, kWhite, kWhite);
    const std::vector<std::string> before = effects_on(scene, {});
    scene::Material rich = test::plain(Vec3(1), Vec3(1), 40);
    rich.opacity = 0.5F;
    rich.emission = Vec3(1);
    rich.map_diffuse.edit().texture = rich.map_normal.edit().texture = 0;
    scene.materials.push_back(rich);
    scene.textures[0].image.pixels()[0] = kBlack;
    scene.materials[0].map_diffuse.edit().texture = -1;
    const auto add_triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        scene.mesh.index.insert(scene.mesh.index.end(), {a, b, c});
        scene.mesh.material.push_back(1);
        scene.mesh.face.push_back(scene.mesh.face.back());
    };
    add_triangle(0, 1, 1);
    add_triangle(1, 0, 1);
    EXPECT_EQ(effects_on(scene, {}), before);
    EXPECT_EQ(facts(scene).brightest, 0.5F);
    add_triangle(0, 1, 2);
    EXPECT_GT(effects_on(scene, {}).size(), before.size() + 3);
}

TEST(Facts, WhiteVertexColoursAreNoColours) {
    scene::Scene scene =
        mapped(test::plain(Vec3(0.5F)), &scene::Material::map_diffuse, kWhite, kWhite);
    scene.mesh.colour.assign(scene.mesh.position.size(), Vec3(1));
    EXPECT_FALSE(plan_of(facts(scene)).decision("vertex_colours")->on());
    FrameOptions options;
    options.effects = {{"vertex_colours", true}};
    EXPECT_TRUE(plan_of(facts(scene), options).attributes.colour);
    scene.mesh.colour.back() = Vec3(1, 1, 0.99F);
    EXPECT_TRUE(plan_of(facts(scene)).decision("vertex_colours")->on());
}

} // namespace
} // namespace scanout::frame
