// The maps of a material in a frame: what has nothing in it changes no bit, forced or not; what has
// changes the picture; what the user lays on holds where the model has no coordinates.
#include "image/compare.h"
#include "support/scenes.h"

#include <algorithm>

namespace scanout::test {
namespace {

using scene::Material;

struct Neutral {
    const char* effect;
    scene::MaterialMap Material::*map;
    image::Rgba8 texel;
};
constexpr Neutral kNeutral[] = {
    {"normal_map", &Material::map_normal, {128, 128, 255, 255}},
    {"bump_map", &Material::map_bump, {90, 90, 90, 255}},
    {"specular_map", &Material::map_specular, {255, 255, 255, 255}},
    {"gloss_map", &Material::map_shininess, {255, 255, 255, 255}},
    {"roughness_map", &Material::map_roughness, {255, 255, 255, 255}},
    {"metalness_map", &Material::map_metalness, {255, 255, 255, 255}},
};

TEST(MaterialMaps, OfNothingAreLeftOutAndForcedOnTheyChangeNoBit) {
    for (const Neutral& n : kNeutral) {
        for (const char* model : {"auto", "phong", "blinn_phong_normalised", "ggx"}) {
            Shot with = mapped_sphere("with", n.map, {"neutral", image::Image(4, 4, n.texel)});
            with.options.reflection = model;
            Shot without = with;
            (without.scene.materials[0].*n.map).edit().texture = -1;
            for (const int samples : {1, 4}) {
                with.options.samples = without.options.samples = samples;
                const image::Image plain = draw(without);
                with.options.effects.clear();
                EXPECT_FALSE(
                    frame::plan(with.options, frame::facts(with.scene))->decision(n.effect)->on())
                    << n.effect;
                EXPECT_EQ(draw(with), plain) << n.effect << ' ' << model;
                with.options.effects = {{n.effect, true}};
                EXPECT_EQ(draw(with), plain) << n.effect << ' ' << model;
            }
        }
    }
}

TEST(MaterialMaps, LeavingOneOutChangesThePicture) {
    const std::pair<const char*, const char*> effects[] = {
        {"map_diffuse", "texture"},         {"map_normal", "normal_map"},
        {"map_bump", "bump_map"},           {"map_specular", "specular_map"},
        {"map_gloss", "gloss_map"},         {"map_roughness", "roughness_map"},
        {"map_metalness", "metalness_map"}, {"map_emission", "emission"}};
    std::vector<Shot> shots = map_shots();
    shots.push_back(mapped_sphere("map_diffuse", &Material::map_diffuse, checkers()));
    for (const auto& [name, effect] : effects) {
        const auto found = std::find_if(shots.begin(), shots.end(),
                                        [&, name = name](const Shot& s) { return s.name == name; });
        ASSERT_NE(found, shots.end()) << name;
        Shot s = *found;
        const image::Image with = draw(s);
        s.options.effects = {{effect, false}};
        EXPECT_GT(image::compare(with, draw(s), 2).over_tolerance, 40) << name;
    }
}

TEST(MaterialMaps, BlackInMapNsShinesNowhereMoreThanWhite) {
    const auto of_texel = [](std::uint8_t code) {
        image::Image texel(1, 1);
        texel.at(0, 0) = {code, code, code, 255};
        return draw(mapped_sphere("gloss", &Material::map_shininess, {"texel", texel}));
    };
    Shot matt = mapped_sphere("matt", &Material::map_shininess, checkers());
    matt.options.effects = {{"highlight", false}};
    EXPECT_EQ(of_texel(0), draw(matt)) << "black is as no highlight at all";
    // 1/255 of Ns 20 is below 1: what is left of the highlight has faded.
    const image::Image faded = of_texel(1);
    EXPECT_LE(image::compare(faded, draw(matt)).max_difference, 30);
    EXPECT_NE(faded, draw(matt));
}

// Physical materials have a roughness of their own: the maps of a highlight are not theirs.
TEST(MaterialMaps, OfAHighlightDoNotTouchPhysicalMaterials) {
    Shot s = mapped_sphere("physical", &Material::map_specular, checkers());
    s.scene.materials[0].map_shininess = s.scene.materials[0].map_specular;
    s.scene.materials[0].roughness = 0.4F;
    const frame::FramePlan plan = *frame::plan(s.options, frame::facts(s.scene));
    EXPECT_FALSE(plan.decision("specular_map")->on());
    EXPECT_FALSE(plan.decision("gloss_map")->on());
    const image::Image without = draw(s);
    s.options.effects = {{"specular_map", true}, {"gloss_map", true}};
    EXPECT_EQ(draw(s), without);
}

// And the other way round: who reflects by another model has no use for roughness.
TEST(MaterialMaps, OfRoughnessAndMetalnessAreForPhysicalMaterialsAlone) {
    Shot s = mapped_sphere("glossy", &Material::map_shininess, checkers());
    Material& m = s.scene.materials[0];
    std::swap(m.map_shininess, m.map_roughness);
    m.map_metalness = m.map_roughness;
    const auto on = [&](const char* effect) {
        return frame::plan(s.options, frame::facts(s.scene))->decision(effect)->on();
    };
    const auto expect_neither = [&] {
        EXPECT_FALSE(on("roughness_map"));
        EXPECT_FALSE(on("metalness_map"));
        const image::Image without = draw(s);
        s.options.effects = {{"roughness_map", true}, {"metalness_map", true}};
        EXPECT_EQ(draw(s), without);
        s.options.effects.clear();
    };
    expect_neither(); // glossy
    m.roughness = m.metalness = 0.5F;
    EXPECT_TRUE(on("roughness_map"));
    EXPECT_TRUE(on("metalness_map"));
    s.options.reflection = "phong";
    expect_neither();
    s.options.reflection = "auto";
    m.roughness = m.metalness = 0.0F; // nothing to multiply
    expect_neither();
}

TEST(MaterialMaps, AModelWithoutCoordinatesWearsWhatTheUserLaysOn) {
    Shot s = covered_solids("bare", "auto", "auto");
    const Shot own = s;
    s.scene.mesh.uv.clear();
    const image::Image bare = draw(s);
    Shot plain = s;
    plain.options.effects = {{"texture", false}};
    EXPECT_EQ(draw(plain), bare) << "nothing is laid on by a guess";
    for (const char* mapping : {"plane", "box", "cylinder", "sphere"}) {
        s.options.mapping = mapping;
        Shot with = own; // whether the model has coordinates or not
        with.options.mapping = mapping;
        EXPECT_EQ(draw(s), draw(with)) << mapping;
        EXPECT_GT(image::compare(draw(s), bare, 2).over_tolerance, 200) << mapping;
    }
}

// Directions on a surface come from the triangle's own normal, whether or not the frame needs that
// for its sides: a hidden triangle whose normals lean backwards makes it need it.
TEST(MaterialMaps, DoNotDependOnWhatTheSidesOfOtherFacesAskFor) {
    for (Shot s : map_shots()) {
        if (s.name != "map_normal" && s.name != "map_bump" && s.name != "mapping_box") continue;
        const image::Image alone = draw(s);
        geom::Mesh& mesh = s.scene.mesh;
        for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(0.1F, 0, 0), Vec3(0, 0.1F, 0)}) {
            add_vertex(mesh, corner, {0, 0, -1});
            mesh.uv.emplace_back(0.0F, 0.0F);
        }
        const auto first = static_cast<std::uint32_t>(mesh.position.size() - 3);
        add_triangle(mesh, first, first + 1, first + 2, 0);
        ASSERT_EQ(frame::facts(s.scene).topology.reversed_triangles, 1U);
        EXPECT_EQ(image::compare(draw(s), alone).differing_pixels, 0) << s.name;
    }
}

// A leaf that is cut out by its picture's alpha, laid on anew: colour and alpha move together.
TEST(MaterialMaps, AlphaFollowsTheMapping) {
    Shot s = shot("leaf");
    s.scene.materials = {textured(0)};
    s.scene.textures = {leaf(false)};
    for (image::Rgba8& texel : s.scene.textures[0].image.pixels())
        if (texel.a == 0)
            texel = {255, 0, 0, 0};
        else
            texel = {0, 255, 0, 255};
    add_square(s.scene.mesh, 0.8F, 0, 0);
    for (Vec2& uv : s.scene.mesh.uv)
        uv = {0.01F, 0.01F}; // of its own: a corner, that is nothing
    s.options.texture = "nearest";
    s.options.background = {0, 0, 0, 255};
    s.options.lights = {light_of(scene::LightKind::ambient, 1)};
    EXPECT_EQ(draw(s).at(32, 32).g, 0);
    s.options.mapping = "plane";
    const image::Image seen = draw(s);
    EXPECT_GT(seen.at(32, 32).g, 200);
    for (const image::Rgba8& p : seen.pixels())
        EXPECT_EQ(p.r, 0);
}

// The same coordinates, made or given: also where the near plane cuts the faces.
TEST(MaterialMaps, WhatTheNearPlaneCutsIsMappedAsTheWhole) {
    for (const DVec3& eye : {DVec3(0.1, 0.1, 0.3), DVec3(-0.3, 0.02, 0.1), DVec3(0, 0.4, 0.9)}) {
        Shot given = near_clip("given");
        given.camera.eye = eye;
        for (std::size_t i = 0; i < given.scene.mesh.uv.size(); ++i) {
            const Vec3& p = given.scene.mesh.position[i];
            given.scene.mesh.uv[i] = {0.5F + p.x / 2,
                                      0.5F - p.z / 2}; // mapping/box.cpp, from above
        }
        Shot made = given;
        made.options.mapping = "box";
        for (const char* filter : {"bilinear", "trilinear"}) {
            given.options.texture = made.options.texture = filter;
            EXPECT_LE(image::compare(draw(given), draw(made), 1).over_tolerance, 0) << filter;
        }
    }
}

// And so does the shadow of what is cut out: the same coordinates, made or given.
TEST(MaterialMaps, ShadowsOfHolesFollowTheMapping) {
    Shot given = shot("shade of a leaf");
    given.scene.materials = {textured(0), plain(Vec3(0.8F))};
    given.scene.textures = {leaf(false)};
    add_square(given.scene.mesh, 0.8F, 0, 0);
    for (std::size_t i = 0; i < given.scene.mesh.uv.size(); ++i) {
        const Vec3& p = given.scene.mesh.position[i];
        given.scene.mesh.uv[i] = {0.5F + p.x / 2, 0.5F + p.y / 2}; // mapping/plane.cpp
    }
    add_square(given.scene.mesh, 0.95F, -0.4F, 1);
    scene::Light sun = light_of(scene::LightKind::directional, 0.9);
    sun.towards = {0.5, 0.3, 1};
    sun.casts = true;
    given.options.lights = {sun, light_of(scene::LightKind::ambient, 0.2)};
    given.options.texture = "nearest";
    given.options.shadow = "map";
    Shot made = given;
    made.options.mapping = "plane";
    for (Vec2& uv : made.scene.mesh.uv)
        uv = {0.01F, 0.01F};
    const image::Image expected = draw(given);
    Shot bright = given;
    bright.options.effects = {{"shadow", false}};
    EXPECT_GT(image::compare(draw(bright), expected, 2).over_tolerance, 40);
    EXPECT_LE(image::compare(draw(made), expected, 2).over_tolerance, 4);
}

} // namespace
} // namespace scanout::test
