// A cached plan is the plan: whatever views and options came before.
#include "frame/plan/plan_cache.h"
#include "io/load.h"

#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace scanout::frame {
namespace {

scene::Scene model(const std::string& name) {
    Warnings warnings;
    return io::load(SCANOUT_SOURCE_DIR "/models/" + name, {}, warnings).value();
}

scene::Light lamp(scene::LightKind kind) {
    scene::Light light;
    light.name = "lamp";
    light.kind = kind;
    light.towards = {-1, 2, 1};
    light.frame = scene::LightFrame::camera;
    light.position = {2, 0, 0};
    light.outer_degrees = 5;
    return light;
}

scene::View numbered_view(const scene::Scene& scene, int number, const FrameOptions& options) {
    scene::Pose pose;
    pose.yaw = scene::wrap_angle(std::int64_t{scene::kFullTurn} * number / 24);
    pose.pitch = scene::wrap_angle(std::int64_t{scene::kFullTurn} * number / 60);
    scene::CameraOptions camera;
    if (number % 7 == 3) camera.projection = scene::Projection::orthographic;
    if (number % 5 == 4) camera.distance = 40.0;                     // textures are minified
    if (number % 8 == 5) camera.target = DVec3(1000 * number, 0, 0); // nothing is in view
    return *scene::make_view(scene.mesh, {}, pose, camera, {}, options.width, options.height);
}

// What is fetched, of which a filter adds some.
auto fetched(const shade::Attributes& a) {
    return std::tuple(a.normal, a.uv, a.colour, a.ray, a.position, a.primitive, a.vertices,
                      a.facing, a.footprint, a.object, a.maps);
}

void expect_same(const FramePlan& a, const FramePlan& b) {
    EXPECT_EQ(a.options, b.options);
    EXPECT_EQ(a.decisions, b.decisions);
    EXPECT_EQ(a.techniques, b.techniques);
    EXPECT_EQ(a.stages, b.stages);
    EXPECT_EQ(fetched(a.attributes), fetched(b.attributes));
    EXPECT_EQ(a.filter, b.filter);
    EXPECT_EQ(a.mips, b.mips);
    EXPECT_EQ(a.lights, b.lights);
    EXPECT_EQ(a.aa, b.aa);
    EXPECT_EQ(a.white, b.white);
    EXPECT_EQ(a.sides, b.sides);
    EXPECT_EQ(a.matt, b.matt);
    EXPECT_EQ(a.vertex_lights, b.vertex_lights);
    EXPECT_EQ(a.shadow.stage, b.shadow.stage);
    EXPECT_EQ(a.shadow.in_maps, b.shadow.in_maps);
    EXPECT_EQ(a.transparency.alpha_modes, b.transparency.alpha_modes);
    EXPECT_EQ(a.transparency.filter, b.transparency.filter);
    EXPECT_EQ(fetched(a.transparency.attributes), fetched(b.transparency.attributes));
}

std::vector<FrameOptions> asked() {
    std::vector<FrameOptions> all(6);
    all[1].lights = {lamp(scene::LightKind::directional), lamp(scene::LightKind::spot)};
    all[2].lights = all[1].lights;
    all[2].shadow = "map";
    all[2].texture = "bilinear";
    all[3].effects["mipmaps"] = true;
    all[3].mapping = "box";
    all[4].effects["mipmaps"] = false;
    all[4].background.a = 0; // what a plan changes of its options
    all[5].stencil = "overdraw";
    return all;
}

TEST(PlanCache, IsThePlanOfEveryViewAndAllOptions) {
    for (const char* const name : {"spot/spot.obj", "spider/spider.obj",
                                   "cornell_box/cornell_box.obj", "angle_block/angle_block.stl"}) {
        const scene::Scene scene = model(name);
        const SceneFacts found = facts(scene);
        PlanCache cache(found);
        for (const FrameOptions& options : asked())
            for (int number = 0; number < 60; ++number) {
                SCOPED_TRACE(fmt::format("{}, view {}", name, number));
                const scene::View view = numbered_view(scene, number, options);
                const auto now = cache.plan(options, view);
                ASSERT_TRUE(now) << now.error().what;
                expect_same(**now, *plan(options, found, view));
            }
    }
}

// Of one view after the other, so that what one leaves behind would be seen in the next.
TEST(PlanCache, FollowsOptionsThatChangeWithEveryView) {
    const scene::Scene scene = model("spot/spot.obj");
    const SceneFacts found = facts(scene);
    const std::vector<FrameOptions> all = asked();
    PlanCache cache(found);
    for (int number = 0; number < 60; ++number) {
        const FrameOptions& options = all[static_cast<std::size_t>(number) % all.size()];
        const scene::View view = numbered_view(scene, number / 2, options);
        expect_same(**cache.plan(options, view), *plan(options, found, view));
    }
}

TEST(PlanCache, FailsAsThePlanDoesAndRecovers) {
    const scene::Scene scene = model("spot/spot.obj");
    PlanCache cache(facts(scene));
    FrameOptions wrong;
    wrong.shading = "nonsense";
    FrameOptions dark;
    dark.lights.resize(scene::kMaxLights + 1);
    const scene::View view = numbered_view(scene, 0, wrong);
    ASSERT_TRUE(cache.plan({}, view));
    for (const FrameOptions& options : {wrong, dark, wrong}) {
        const auto refused = cache.plan(options, view);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().what, plan(options, facts(scene), view).error().what);
    }
    ASSERT_TRUE(cache.plan({}, view));
    expect_same(**cache.plan({}, view), *plan({}, facts(scene), view));
}

} // namespace
} // namespace scanout::frame
