// What glTF's materials ask of a frame beyond MTL's: a surface without light, and a least alpha of
// its own.
#include "math/srgb.h"
#include "support/scenes.h"

namespace scanout::test {
namespace {

TEST(GltfMaterials, AnUnlitSurfaceShowsItsColourUnderAnyLight) {
    Shot s = shot("unlit");
    scene::Material material = plain(Vec3(1, 0, srgb_decode(std::uint8_t{100})), Vec3(1), 20);
    material.unlit = true;
    s.scene.materials = {material};
    add_sphere(s.scene.mesh, Vec3(0), 0.95F, 32, 16, 0);
    s.options.tone = "clamp";
    const int x = s.options.width / 2, y = s.options.height / 2;
    for (const int offset : {0, 6})
        EXPECT_EQ(draw(s).at(x + offset, y + offset), (image::Rgba8{255, 0, 100, 255}));
    s.options.effects = {{"emission", false}}; // then it is a surface like others
    EXPECT_NE(draw(s).at(x, y), (image::Rgba8{255, 0, 100, 255}));
}

TEST(GltfMaterials, AnUnlitSurfaceHasItsVertexColoursAndTexture) {
    Shot s = wrapped_square("unlit", "auto");
    s.scene.textures = {{"grey", image::Image(1, 1, {188, 188, 188, 255})}};
    s.scene.materials[0].unlit = true;
    s.scene.materials[0].diffuse = Vec3(1);
    s.scene.mesh.colour.assign(s.scene.mesh.position.size(), Vec3(1, 0, 1));
    s.options.tone = "clamp";
    EXPECT_EQ(draw(s).at(s.options.width / 2, s.options.height / 2),
              (image::Rgba8{188, 0, 188, 255}));
}

TEST(GltfMaterials, WhereAllIsUnlitNothingIsLit) {
    Shot s = wrapped_square("unlit", "auto");
    s.scene.textures = {{"grey", image::Image(1, 1, {188, 188, 188, 255})}};
    scene::Material& material = s.scene.materials[0];
    const auto planned = [&] { return *frame::plan(s.options, frame::facts(s.scene)); };
    EXPECT_TRUE(planned().decision("directional_light")->on());
    material.unlit = true;
    const std::string why = "nothing is lit: every material is unlit";
    for (const char* effect : {"directional_light", "two_sided", "shadow", "shading"}) {
        EXPECT_FALSE(planned().decision(effect)->on()) << effect;
        EXPECT_EQ(planned().decision(effect)->because, why);
    }
    EXPECT_FALSE(planned().decision("highlight")->on());
    EXPECT_TRUE(planned().decision("texture")->on());
    const image::Image lit = draw(s);
    s.options.lights.clear(); // its texture needs none
    EXPECT_TRUE(planned().decision("texture")->on());
    EXPECT_EQ(draw(s).at(s.options.width / 2, s.options.height / 2),
              lit.at(s.options.width / 2, s.options.height / 2));
    s.options.effects = {{"emission", false}}; // then it is a surface like others
    EXPECT_NE(planned().decision("shading")->because, why);
}

// A bowl of one material and a square of another, seen from many sides.
Shot bowl_and_square() {
    Shot s = bowl("sides", frame::Cull::material);
    s.scene.materials.push_back(plain({0.9F, 0.3F, 0.2F}));
    add_square(s.scene.mesh, 0.8F, 0.1F, 1);
    return s;
}

TEST(GltfMaterials, TheBackOfAOneSidedMaterialIsNotSeen) {
    int hidden = 0;
    for (const bool bowl_alone : {false, true})
        for (const double azimuth : {0.0, 70.0, 180.0, 250.0})
            for (const double elevation : {-60.0, 35.0})
                for (const char* aa : {"none", "samples_4", "area", "supersampling_2"})
                    for (const bool mirrored : {false, true}) {
                        Shot s = bowl_and_square();
                        s.options.aa = aa;
                        s.camera.azimuth_degrees = azimuth;
                        s.camera.elevation_degrees = elevation;
                        if (mirrored) s.model.scale = DVec3(-1, 1, 1);
                        s.scene.materials[0].one_sided = bowl_alone;
                        s.scene.materials[1].one_sided = !bowl_alone;
                        const image::Image found = draw(s);
                        Shot whole = s;
                        whole.options.cull = frame::Cull::none;
                        hidden += draw(whole) != found ? 1 : 0;
                        // Without the triangles that turn away it is the same picture.
                        const scene::View view =
                            *scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {},
                                              s.options.width, s.options.height);
                        const std::vector<bool> away = frame::back_facing(s.scene.mesh, view);
                        for (std::size_t t = 0; t < away.size(); ++t)
                            if (away[t] && (s.scene.mesh.material[t] == 0) == bowl_alone)
                                for (std::size_t k = 0; k < 3; ++k)
                                    whole.scene.mesh.index[3 * t + k] =
                                        whole.scene.mesh.index[3 * t];
                        EXPECT_EQ(draw(whole), found) << aa << azimuth << elevation << mirrored;
                    }
    EXPECT_GT(hidden, 40);
}

TEST(GltfMaterials, TheOptionDecidesOverTheMaterials) {
    Shot s = bowl_and_square();
    const auto row = [&] {
        return *frame::plan(s.options, frame::facts(s.scene))->decision("cull");
    };
    EXPECT_EQ(row().technique, "none");
    EXPECT_EQ(row().because, "no material is one-sided");
    const image::Image both = draw(s);
    s.scene.materials[0].one_sided = true;
    EXPECT_EQ(row().technique, "material");
    EXPECT_EQ(row().because.substr(row().because.find(" triangles")),
              " triangles have a one-sided material");
    EXPECT_NE(draw(s), both);
    s.scene.materials[1].one_sided = true;
    EXPECT_EQ(row().technique, "back");
    EXPECT_EQ(row().because, "every material is one-sided");
    const image::Image fronts = draw(s);
    s.options.cull = frame::Cull::none;
    EXPECT_EQ(row().because, "as asked");
    EXPECT_EQ(draw(s), both);
    s.scene.materials[0].one_sided = s.scene.materials[1].one_sided = false;
    s.options.cull = frame::Cull::back;
    EXPECT_EQ(draw(s), fronts);
}

// Alpha 150 of 255 everywhere, which neither blends nor asks --alpha-cut.
TEST(GltfMaterials, ACutOfItsOwnDecidesWhole) {
    Shot s = wrapped_square("cut", "auto");
    s.scene.textures = {{"grey", image::Image(1, 1, {255, 255, 255, 150})}};
    const auto covered = [&] {
        const image::Image picture = draw(s);
        return picture.at(s.options.width / 2, s.options.height / 2) != s.options.background;
    };
    for (const double option : {0.0, 0.1, 0.9, 1.0}) {
        s.options.alpha_cut = option;
        s.scene.materials[0].alpha_cut = 0.55F;
        EXPECT_TRUE(covered());
        EXPECT_EQ(frame::plan(s.options, frame::facts(s.scene))->transparency.blended, nullptr);
        s.scene.materials[0].alpha_cut = 0.65F;
        EXPECT_FALSE(covered());
    }
    // A material's own opacity is held against it, too.
    s.scene.textures[0].image.at(0, 0).a = 255;
    s.scene.materials[0].opacity = 0.5F;
    EXPECT_FALSE(covered());
    s.scene.materials[0].alpha_cut = 0.5F;
    EXPECT_TRUE(covered());
    s.scene.materials[0].opacity = 1;
    s.scene.materials[0].alpha_cut = 1.5F;
    EXPECT_FALSE(covered());
    s.scene.materials[0].opacity = 0; // reaches a cut of 0
    s.scene.materials[0].alpha_cut = 0.0F;
    EXPECT_TRUE(covered());
    s.scene.materials[0].alpha_cut.reset();
    EXPECT_FALSE(covered());
}

// Blended because the user asks for it, it still is there or not.
TEST(GltfMaterials, ACutOfItsOwnDecidesWholeWhereItIsBlended) {
    Shot s = wrapped_square("cut", "auto");
    s.scene.textures = {{"grey", image::Image(1, 1, {255, 255, 255, 150})}};
    s.options.transparency = "exact";
    const auto middle = [&] { return draw(s).at(s.options.width / 2, s.options.height / 2); };
    s.scene.materials[0].alpha_cut = 0.65F;
    EXPECT_EQ(middle(), s.options.background);
    s.scene.materials[0].alpha_cut = 0.55F;
    const image::Rgba8 seen = middle();
    s.scene.textures[0].image.at(0, 0).a = 255;
    EXPECT_EQ(middle(), seen);
}

} // namespace
} // namespace scanout::test
