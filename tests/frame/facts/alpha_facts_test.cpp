// What is transparent is told by numbers and texels, never by the presence of a statement.
#include "frame/plan/plan.h"
#include "rows.h"
#include "support/scenes.h"

#include <cmath>

#include <gmock/gmock.h>

namespace scanout::frame {
namespace {

using raster::AlphaMode;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

scene::Texture texels(std::vector<image::Rgba8> row) {
    image::Image image(static_cast<int>(row.size()), 1);
    std::copy(row.begin(), row.end(), image.pixels().begin());
    return {"made by the test", image};
}

scene::Material with_opacity_map(int texture, char channel) {
    scene::Material m = test::plain(Vec3(1));
    m.map_opacity.edit().texture = texture;
    m.map_opacity.edit().path = "made by the test";
    m.map_opacity.edit().channel = channel;
    return m;
}

// A quad for each of the materials, from the default one on.
scene::Scene scene_of(std::vector<scene::Material> materials,
                      std::vector<scene::Texture> textures = {}) {
    scene::Scene scene;
    scene.mesh = test::empty_mesh();
    scene.materials = std::move(materials);
    scene.textures = std::move(textures);
    for (int i = -1; i < static_cast<int>(scene.materials.size()); ++i)
        test::add_square(scene.mesh, 1, 0, i);
    return scene;
}

AlphaClass class_of(const scene::Material& material, std::vector<scene::Texture> textures = {}) {
    return alpha_facts(scene_of({material}, std::move(textures))).of_material[1];
}

scene::Material dissolved(scene::Material material, float d) {
    material.opacity = d;
    return material;
}

TEST(AlphaFacts, AreThoseOfTheData) {
    const scene::Texture solid = texels({{1, 2, 3, 255}, {0, 0, 0, 255}});
    const scene::Texture holes = texels({{1, 2, 3, 255}, {0, 0, 0, 0}});
    const scene::Texture soft = texels({{1, 2, 3, 255}, {0, 0, 0, 254}});
    EXPECT_EQ(class_of(test::plain(Vec3(1))), AlphaClass::opaque);
    EXPECT_EQ(class_of(dissolved(test::plain(Vec3(1)), 0.999F)), AlphaClass::blended);
    EXPECT_EQ(class_of(dissolved(test::plain(Vec3(1)), 0)), AlphaClass::unseen);
    EXPECT_EQ(class_of(test::textured(0), {solid}), AlphaClass::opaque);
    EXPECT_EQ(class_of(test::textured(0), {holes}), AlphaClass::cut_out);
    EXPECT_EQ(class_of(test::textured(0), {soft}), AlphaClass::blended);
    EXPECT_EQ(class_of(dissolved(test::textured(0), 0.5F), {holes}), AlphaClass::blended);
    EXPECT_EQ(class_of(test::textured(-1), {soft}), AlphaClass::opaque); // could not be read
    scene::Scene no_uv = scene_of({test::textured(0)}, {soft});
    no_uv.mesh.uv.clear();
    EXPECT_EQ(alpha_facts(no_uv).of_material[1], AlphaClass::opaque);
}

TEST(AlphaFacts, OfAnOpacityMapAreThoseOfItsChannel) {
    const scene::Texture t = texels({{255, 0, 7, 255}, {255, 255, 255, 255}});
    EXPECT_EQ(class_of(with_opacity_map(0, 'r'), {t}), AlphaClass::opaque);
    EXPECT_EQ(class_of(with_opacity_map(0, 'm'), {t}), AlphaClass::opaque);
    EXPECT_EQ(class_of(with_opacity_map(0, 'g'), {t}), AlphaClass::cut_out);
    EXPECT_EQ(class_of(with_opacity_map(0, 'b'), {t}), AlphaClass::blended);
    EXPECT_EQ(class_of(with_opacity_map(0, 'l'), {t}), AlphaClass::blended);
    const scene::Texture grey = texels({{0, 0, 0, 255}, {255, 255, 255, 255}});
    EXPECT_EQ(class_of(with_opacity_map(0, 'l'), {grey}), AlphaClass::cut_out);
}

TEST(AlphaFacts, CountWhatTrianglesHaveAlone) {
    scene::Scene scene = scene_of({dissolved(test::plain(Vec3(1)), 0.25F), test::plain(Vec3(1)),
                                   dissolved(test::plain(Vec3(1)), 0.5F)});
    scene.mesh.material[6] = scene.mesh.material[7] = 1; // nothing has the last one any more
    const AlphaFacts found = alpha_facts(scene);
    EXPECT_EQ(found.blended_triangles, 2U);
    EXPECT_EQ(found.blended_materials, 1U);
    EXPECT_EQ(found.materials, 3U);
    EXPECT_EQ(found.min_opacity, 0.25F);
    EXPECT_EQ(found.blended_by_maps, 0U);
    EXPECT_EQ(found.of_material[3], AlphaClass::opaque);
}

FramePlan plan_of(const scene::Scene& scene, const FrameOptions& options = {}) {
    auto result = plan(options, facts(scene));
    EXPECT_TRUE(result) << result.error().what;
    return result.value_or(FramePlan());
}

TEST(TransparencyPlan, ChoosesByMaterial) {
    const scene::Scene scene =
        scene_of({test::plain(Vec3(1)), test::textured(0), dissolved(test::plain(Vec3(1)), 0.5F),
                  dissolved(test::plain(Vec3(1)), 0)},
                 {texels({{1, 2, 3, 255}, {0, 0, 0, 0}})});
    const FramePlan p = plan_of(scene);
    EXPECT_THAT(p.transparency.alpha_modes,
                ElementsAre(AlphaMode::opaque, AlphaMode::opaque, AlphaMode::cut_out,
                            AlphaMode::blended, AlphaMode::nothing));
    EXPECT_EQ(p.transparency.cut_out, find_row(shade::transparency::kRows, "cut_out"));
    EXPECT_EQ(p.transparency.blended, find_row(shade::transparency::kRows, "exact"));
    EXPECT_EQ(p.transparency.stages.size(), 2U);
    EXPECT_THAT(to_string(*p.decision("cut_out")),
                StartsWith("cut_out cut_out: 2 of 5 materials (4 of 10 triangles)"));
    EXPECT_THAT(to_string(*p.decision("blending")),
                StartsWith("blending exact: 1 of 5 materials (2 of 10 triangles)"));
    FrameOptions options;
    options.transparency = "sorted";
    EXPECT_THAT(plan_of(scene, options).transparency.alpha_modes,
                ElementsAre(AlphaMode::opaque, AlphaMode::opaque, AlphaMode::blended,
                            AlphaMode::blended, AlphaMode::nothing));
    options.transparency = "cut_out";
    EXPECT_EQ(plan_of(scene, options).transparency.blended, nullptr);
    options.effects = {{"cut_out", false}, {"blending", false}};
    EXPECT_TRUE(plan_of(scene, options).transparency.alpha_modes.empty());
}

// The golden pictures and hashes of --blend none were drawn from sorted lists: they are the same.
TEST(TransparencyPlan, ListsNothingWhereTheNearestIsShownWhole) {
    const scene::Scene scene =
        scene_of({test::plain(Vec3(1)), dissolved(test::plain(Vec3(1)), 0.5F)});
    FrameOptions options;
    options.blend = "none";
    const FramePlan p = plan_of(scene, options);
    EXPECT_EQ(p.transparency.blended, nullptr);
    EXPECT_TRUE(p.transparency.alpha_modes.empty());
    EXPECT_EQ(to_string(*p.decision("blending")),
              "blending off: --blend none shows the nearest surface whole");
    EXPECT_EQ(p.decision("blend")->technique, "none");
    // Where the nearest triangle's order is not that of its samples, lists are needed.
    options.transparency = "sorted";
    EXPECT_NE(plan_of(scene, options).transparency.blended, nullptr);
    options.transparency = "auto";
    options.depth_test = "greater";
    EXPECT_NE(plan_of(scene, options).transparency.blended, nullptr);
}

TEST(TransparencyPlan, SaysWhereAlphaComesFrom) {
    const auto because = [](const std::vector<scene::Material>& materials) {
        const scene::Texture soft = texels({{1, 2, 3, 255}, {0, 0, 0, 254}});
        return plan_of(scene_of(materials, {soft})).decision("blending")->because;
    };
    const scene::Material glass = dissolved(test::plain(Vec3(1)), 0.25F);
    const scene::Material both = dissolved(test::textured(0), 0.5F), leaf = test::textured(0);
    EXPECT_THAT(because({leaf}), EndsWith("alpha between 0 and 1, in maps"));
    EXPECT_THAT(because({glass, both}), EndsWith("alpha between 0 and 1, d from 0.25"));
    EXPECT_THAT(because({both, leaf}),
                EndsWith("alpha between 0 and 1, d from 0.5, and 1 in maps"));
}

TEST(TransparencyPlan, IsEmptyWhereNothingCallsForIt) {
    const FramePlan p = plan_of(scene_of({test::textured(0)}, {test::checkers()}));
    EXPECT_TRUE(p.transparency.alpha_modes.empty());
    EXPECT_TRUE(p.transparency.stages.empty());
    EXPECT_EQ(p.transparency.cut_out, nullptr);
    EXPECT_EQ(p.transparency.blended, nullptr);
    EXPECT_FALSE(p.decision("blending")->on());
    EXPECT_FALSE(p.decision("cut_out")->on());
    // Numbers alone want no stage: nothing is evaluated.
    const FramePlan d = plan_of(scene_of({dissolved(test::plain(Vec3(1)), 0.5F)}));
    EXPECT_FALSE(d.transparency.alpha_modes.empty());
    EXPECT_TRUE(d.transparency.stages.empty());
}

TEST(TransparencyPlan, RefusesWhatDoesNotExist) {
    FrameOptions options;
    options.transparency = "glass";
    const auto refused = plan(options, facts(scene_of({})));
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().what, HasSubstr("cut_out sorted exact"));
    for (const double cut : {-0.1, 1.1, std::nan("")}) {
        FrameOptions bad;
        bad.alpha_cut = cut;
        EXPECT_FALSE(plan(bad, facts(scene_of({}))));
    }
}

} // namespace
} // namespace scanout::frame
