#include "app/picture/reference.h"
#include "support/scenes.h"
#include "trace/render.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include <gmock/gmock.h>

namespace scanout::app {
namespace {

using test::Shot;

image::Image traced(const Shot& s) {
    const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                                       s.options.height);
    const auto plan = frame::plan(s.options, frame::facts(s.scene), *view);
    const auto look = look_of(*plan);
    EXPECT_TRUE(look) << (look ? "" : look.error().what);
    if (!look) return {};
    Jobs jobs(2);
    auto made = trace::render(s.scene, *view, *look, jobs);
    EXPECT_TRUE(made) << (made ? "" : made.error().what);
    return made ? std::move(made->image) : image::Image();
}

// Nothing changes much in a pixel and those about it.
bool smooth(const image::Image& picture, int x, int y) {
    std::array<int, 3> low{255, 255, 255}, high{};
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, picture.height() - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, picture.width() - 1); ++u) {
            const image::Rgba8& p = picture.at(u, v);
            const std::array<int, 3> code{p.r, p.g, p.b};
            for (std::size_t c = 0; c < 3; ++c) {
                low[c] = std::min(low[c], code[c]);
                high[c] = std::max(high[c], code[c]);
            }
        }
    return high[0] - low[0] < 12 && high[1] - low[1] < 12 && high[2] - low[2] < 12;
}

int largest(const image::Rgba8& a, const image::Rgba8& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

// Where the renderer takes many samples, it draws what rays find: to a code, but at edges.
// What glTF's materials ask for: edges of a texture by axis, no light, a cut of their own.
// Two equal screens in the light, alpha 0.6: one shows by its cut and casts, one does neither.
Shot own_cuts_over_a_floor() {
    Shot s = test::shot("own_cut_shadow");
    s.scene.textures = {{"grey", image::Image(1, 1, {255, 255, 255, 153})}};
    s.scene.materials = {test::plain(Vec3(0.7F)), test::textured(0), test::textured(0)};
    s.scene.materials[1].alpha_cut = 0.5F;
    s.scene.materials[2].alpha_cut = 0.7F;
    const auto flat = [&](float x0, float x1, float y, float z, int material) {
        test::add_quad(s.scene.mesh, {{{x0, y, z}, {x1, y, z}, {x1, y, -z}, {x0, y, -z}}},
                       {0, 1, 0}, material);
    };
    flat(-1, 1, -0.5F, 1, 0);
    flat(-0.7F, -0.2F, 0.2F, 0.4F, 1);
    flat(0.2F, 0.7F, 0.2F, 0.4F, 2);
    s.camera.elevation_degrees = 30;
    s.camera.distance = 2.5;
    scene::Light lamp = test::light_of(scene::LightKind::directional, 0.9);
    lamp.casts = true;
    lamp.towards = {0.1, 1, 0.2};
    s.options.lights = {lamp, test::light_of(scene::LightKind::ambient, 0.15)};
    s.options.shadow = "map";
    s.options.shadow_size = 1024;
    return s;
}

std::vector<Shot> gltf_shots() {
    std::vector<Shot> shots;
    for (const auto& [name, u, v] :
         {std::tuple("mirror_clamp", scene::Wrap::mirror, scene::Wrap::clamp),
          {"clamp_repeat", scene::Wrap::clamp, scene::Wrap::repeat},
          {"repeat_mirror", scene::Wrap::repeat, scene::Wrap::mirror}}) {
        shots.push_back(test::wrapped_square(name, "auto"));
        shots.back().scene.materials[0].map_diffuse.edit().wrap_u = u;
        shots.back().scene.materials[0].map_diffuse.edit().wrap_v = v;
    }
    shots.push_back(test::wrapped_square("unlit", "auto"));
    shots.back().scene.materials[0].unlit = true;
    shots.push_back(test::wrapped_square("own_cut", "auto"));
    shots.back().scene.materials[0].alpha_cut = 0.75F;
    shots.back().options.alpha_cut = 0.1;
    image::Image& picture = shots.back().scene.textures[0].image;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            picture.at(x, y).a = static_cast<std::uint8_t>(255 * x / picture.width());
    shots.push_back(own_cuts_over_a_floor());
    shots.push_back(test::bowl("one_sided", frame::Cull::material)); // and a square of two
    shots.back().scene.materials[0].one_sided = true;
    shots.back().scene.materials.push_back(test::plain({0.9F, 0.3F, 0.2F}));
    test::add_square(shots.back().scene.mesh, 0.4F, 0.1F, 1);
    return shots;
}

// Between planes, through windows that are not about the middle, sheared.
std::vector<Shot> cut_shots() {
    std::vector<Shot> shots;
    for (const bool flat : {false, true}) {
        Shot s = test::solids(flat ? "cut_flat" : "cut");
        s.camera.projection =
            flat ? scene::Projection::orthographic : scene::Projection::perspective;
        s.camera.distance = 3;
        s.camera.near = 2.7;
        s.camera.far = 3.1;
        const double unit = flat ? 1 : 0.9;
        s.camera.window =
            scene::Window{s.camera.projection, -0.5 * unit, 0.9 * unit, -0.7 * unit, 0.3 * unit};
        s.model.steps.push_back({scene::shear(0, 0.3, -0.2), DVec3(0.1, 0, 0), {}});
        shots.push_back(std::move(s));
    }
    return shots;
}

TEST(Reference, IsWhatTheRendererDrawsAtItsBest) {
    std::vector<Shot> shots = {test::solids("solids"), test::bowl("bowl", frame::Cull::none),
                               test::bowl("bowl_culled", frame::Cull::back)};
    for (const char* model :
         {"lambert", "toon", "phong", "blinn_phong", "blinn_phong_normalised", "ggx"})
        shots.push_back(test::glossy(model, model));
    for (const char* tone : {"filmic", "shoulder"}) {
        shots.push_back(test::solids(tone));
        shots.back().options.tone = tone;
        shots.back().options.exposure = 1;
    }
    shots.push_back(test::shadowed("shadowed", "volume", scene::LightKind::directional, 0));
    shots.push_back(test::shadowed("by_a_lamp", "volume", scene::LightKind::point, 0));
    for (Shot& s : gltf_shots())
        shots.push_back(std::move(s));
    for (Shot& s : cut_shots())
        shots.push_back(std::move(s));
    for (Shot& s : shots) {
        SCOPED_TRACE(s.name);
        s.options.width = 60;
        s.options.height = 40;
        s.options.aa = "supersampling_4";
        const image::Image drawn = test::draw(s), found = traced(s);
        int compared = 0;
        double sum = 0;
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 60; ++x) {
                const int difference = largest(drawn.at(x, y), found.at(x, y));
                sum += difference;
                if (!smooth(found, x, y)) continue;
                ++compared;
                EXPECT_LE(difference, 1) << x << " " << y;
            }
        EXPECT_GT(compared, 1000);
        const double most = s.scene.textures.empty() ? 0.6 : 0.8; // checks have edges, too
        EXPECT_LT(sum / 2400, most) << "codes; at edges 4 x 4 samples are off by more";
    }
}

TEST(Reference, SaysWhatItDoesNotDraw) {
    for (const auto& [axis, technique] : {std::pair("depth_test", "greater"),
                                          {"stencil", "outline"},
                                          {"convolution", "low_pass"}}) {
        Shot s = test::solids(axis);
        ASSERT_TRUE(frame::ask(s.options, axis, technique));
        const auto look = look_of(*frame::plan(s.options, frame::facts(s.scene)));
        ASSERT_FALSE(look);
        EXPECT_EQ(look.error().exit, Exit::usage);
        EXPECT_THAT(look.error().what, testing::HasSubstr("--" + frame::option_of(axis)));
    }
}

TEST(Reference, NamesLinesAndPoints) {
    scene::Scene scene;
    EXPECT_TRUE(left_out_of_reference(scene).empty());
    scene.mesh.point_index = {0};
    EXPECT_THAT(left_out_of_reference(scene), testing::ElementsAre(testing::HasSubstr("1 point")));
}

TEST(Reference, SaysWhatMemoryItTakesWhereThatIsTooMuch) {
    Shot s = test::solids("solids");
    s.options.width = s.options.height = 200; // 1.16 MB
    const auto plan = frame::plan(s.options, frame::facts(s.scene), scene::View());
    EXPECT_TRUE(check_reference_fits(s.scene, plan->options.width, plan->options.height, 0));
    EXPECT_TRUE(check_reference_fits(s.scene, plan->options.width, plan->options.height, 1000));
    const auto fits = check_reference_fits(s.scene, plan->options.width, plan->options.height, 1);
    ASSERT_FALSE(fits);
    EXPECT_EQ(fits.error().exit, Exit::unreadable);
    EXPECT_THAT(fits.error().what, testing::HasSubstr("--max-memory is 1"));
}

} // namespace
} // namespace scanout::app
