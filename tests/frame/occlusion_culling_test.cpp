// A renderer defers clusters that were occluded in the frames before, in the picture and in its
// shadow maps: what it draws is what a new one draws.
#include "frame/renderer.h"
#include "support/lights.h"
#include "support/scenes.h"

#include <algorithm>

namespace scanout::test {
namespace {

Shot balls_behind_a_wall() {
    Shot s = shot("balls", 160, 120);
    geom::Mesh& mesh = s.scene.mesh;
    add_sphere(mesh, {-0.3F, 0, -0.3F}, 0.4F, 128, 24);
    add_sphere(mesh, {0.4F, 0.1F, -0.2F}, 0.3F, 128, 24);
    add_square(mesh, 0.9F, 0.06F); // both come through it by a little
    Jobs jobs(1);
    mesh.clusters = geom::find_clusters(jobs, mesh);
    return s;
}

// Most frames as the last one but for a step around; some with options that defer nothing.
void ask(frame::FrameOptions& options, int frame) {
    static constexpr struct {
        const char *aa, *stencil, *shadow;
    } kAsked[] = {{"auto", "auto", "auto"},    {"auto", "auto", "map_pcf"},
                  {"auto", "auto", "volume"},  {"samples_4", "auto", "auto"},
                  {"auto", "outline", "auto"}, {"supersampling_2", "auto", "auto"},
                  {"area", "auto", "auto"}};
    const auto& asked = kAsked[frame / 16 % std::size(kAsked)];
    options.aa = asked.aa;
    options.stencil = asked.stencil;
    options.shadow = asked.shadow;
    options.lights.front().casts = options.shadow != "auto";
}

TEST(OcclusionHistory, FramesAreThoseOfANewRenderer) {
    Shot s = balls_behind_a_wall();
    scene::Light light = light_of(scene::LightKind::directional, 1);
    light.towards = {1, 0.2, 0.6};
    s.options.lights = {light};
    Jobs jobs(2);
    frame::Renderer old(jobs);
    const frame::SceneFacts facts = frame::facts(s.scene);
    std::uint64_t drawn = 0, drawn_by_new = 0;
    for (int i = 0; i < 112; ++i) {
        ask(s.options, i);
        s.camera.azimuth_degrees = i * 0.5; // the wall stays in front
        const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {},
                                           s.options.width, s.options.height);
        ASSERT_TRUE(view);
        const auto plan = frame::plan(s.options, facts, *view);
        ASSERT_TRUE(plan) << plan.error().what;
        frame::Renderer fresh(jobs);
        ASSERT_TRUE(old.render(s.scene, *view, *plan) == fresh.render(s.scene, *view, *plan)) << i;
        drawn += old.stats().triangles_drawn;
        drawn_by_new += fresh.stats().triangles_drawn;
    }
    EXPECT_LT(drawn, drawn_by_new * 9 / 10);
}

} // namespace
} // namespace scanout::test
