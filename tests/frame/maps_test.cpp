// The maps of a material in a frame: what has nothing in it changes no bit, forced or not; what has
// changes the picture; what the user lays on holds where the model has no coordinates.
#include "image/compare.h"
#include "support/scenes.h"

namespace scanout::test {
namespace {

using scene::Material;

struct Neutral {
    const char* effect;
    scene::TextureMap Material::*map;
    image::Rgba8 texel;
};
constexpr Neutral kNeutral[] = {
    {"normal_map", &Material::map_normal, {128, 128, 255, 255}},
    {"bump_map", &Material::map_bump, {90, 90, 90, 255}},
    {"specular_map", &Material::map_specular, {255, 255, 255, 255}},
    {"gloss_map", &Material::map_shininess, {255, 255, 255, 255}},
};

TEST(MaterialMaps, OfNothingAreLeftOutAndForcedOnTheyChangeNoBit) {
    for (const Neutral& n : kNeutral) {
        for (const char* model : {"auto", "phong", "blinn_phong_normalised", "ggx"}) {
            Shot with = mapped_sphere("with", n.map, {"neutral", image::Image(4, 4, n.texel)});
            with.options.reflection = model;
            Shot without = with;
            (without.scene.materials[0].*n.map).texture = -1;
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
        {"map_diffuse", "texture"},  {"map_opacity", "blending"},      {"map_normal", "normal_map"},
        {"map_bump", "bump_map"},    {"map_specular", "specular_map"}, {"map_gloss", "gloss_map"},
        {"map_emission", "emission"}};
    for (Shot s : map_shots()) {
        for (const auto& [name, effect] : effects) {
            if (s.name != name) continue;
            const image::Image with = draw(s);
            s.options.effects = {{effect, false}};
            EXPECT_GT(image::compare(with, draw(s), 2).over_tolerance, 40) << name;
        }
    }
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
        ASSERT_EQ(frame::facts(s.scene).sides.leaning, 1U);
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

} // namespace
} // namespace scanout::test
