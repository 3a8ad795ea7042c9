// While a model turns, nothing is allocated from the view to the picture: not by us, and not by
// oneTBB below us.
#include "base/jobs.h"
#include "frame/catalogue.h"
#include "frame/plan/plan_cache.h"
#include "frame/renderer.h"
#include "io/load.h"
#include "simd/targets.h"
#include "support/allocations.h"
#include "support/meshes.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>

#ifndef SCANOUT_SANITIZED

namespace scanout::frame {
namespace {

constexpr int kTurn = 100; // frames

struct Case {
    const char* name;
    const char* model; // nullptr: balls behind a wall, of which clusters wait
    void (*ask)(FrameOptions&);
};

scene::Scene scene_of(const Case& c) {
    if (c.model != nullptr) {
        Warnings warnings;
        const std::string path = std::string(SCANOUT_SOURCE_DIR "/models/") + c.model;
        return io::load(path, {}, warnings).value();
    }
    scene::Scene scene;
    geom::Mesh& mesh = scene.mesh;
    mesh = test::empty_mesh();
    test::add_sphere(mesh, {-0.3F, 0, -0.3F}, 0.4F, 128, 64);
    test::add_sphere(mesh, {0.4F, 0.1F, -0.2F}, 0.3F, 128, 64);
    test::add_square(mesh, 0.9F, 0.06F);
    Jobs jobs(1);
    mesh.clusters = geom::find_clusters(jobs, mesh);
    return scene;
}

scene::Light sun() {
    scene::Light light;
    light.kind = scene::LightKind::directional;
    light.towards = {-1, 2, 1};
    return light;
}

// Narrow, and beside the model for some of the turn.
scene::Light spot() {
    scene::Light light;
    light.name = "a lamp of a name that is long";
    light.kind = scene::LightKind::spot;
    light.frame = scene::LightFrame::camera;
    light.position = {2, 0, 0};
    light.outer_degrees = 5;
    return light;
}

const Case kCases[] = {
    {"plain", "spot/spot.obj", [](FrameOptions&) {}},
    {"samples", "suzanne/suzanne.obj", [](FrameOptions& o) { o.samples = 4; }},
    {"materials", "cornell_box/cornell_box.obj", [](FrameOptions& o) { o.cull = Cull::back; }},
    {"shadow map", "spot/spot.obj",
     [](FrameOptions& o) {
         o.lights = {sun()};
         o.shadow = "map_pcf";
     }},
    {"shadow volume", "spot/spot.obj",
     [](FrameOptions& o) {
         o.lights = {sun()};
         o.shadow = "volume";
     }},
    {"projected shadow", "cornell_box/cornell_box.obj",
     [](FrameOptions& o) {
         o.lights = {sun()};
         o.shadow = "projected";
     }},
    {"spot", "cornell_box/cornell_box.obj", // its backs and its floor come into view and go
     [](FrameOptions& o) {
         o.lights = {sun(), spot()};
         o.shadow = "map";
     }},
    {"ambient occlusion", "suzanne/suzanne.obj",
     [](FrameOptions& o) {
         o.samples = 4;
         o.ambient_occlusion = "gtao_4";
     }},
    {"overdraw", "spot/spot.obj", [](FrameOptions& o) { o.stencil = "overdraw"; }},
    {"low-pass", "spot/spot.obj", [](FrameOptions& o) { o.convolution = "low_pass"; }},
    {"facets", "angle_block/angle_block.stl", [](FrameOptions& o) { o.aa = "area"; }},
    {"hidden", nullptr, [](FrameOptions&) {}},
};

// A turning model, frame after frame.
class Turn {
public:
    Turn(Jobs& jobs, const scene::Scene& scene, const FrameOptions& options, int frames)
        : scene_(scene), options_(options), frames_(frames), plan_(frame::facts(scene)),
          renderer_(jobs) {}

    // Once around.
    void draw() {
        for (int i = 0; i < frames_; ++i) {
            scene::Pose pose;
            pose.yaw = scene::wrap_angle(std::int64_t{scene::kFullTurn} * i / frames_);
            const scene::View view =
                *scene::make_view(scene_.mesh, {}, pose, {}, {}, options_.width, options_.height);
            renderer_.render(scene_, view, **plan_.plan(options_, view));
        }
    }
    // Blocks that are asked for meanwhile.
    std::size_t allocations() {
        const std::size_t before = test::allocations;
        draw();
        return test::allocations - before;
    }

private:
    const scene::Scene& scene_;
    FrameOptions options_;
    int frames_;
    PlanCache plan_;
    Renderer renderer_;
};

FrameOptions small_picture() {
    FrameOptions options;
    options.width = 160;
    options.height = 120;
    return options;
}

// Blocks that are asked for while the model turns around once: of the turns after `warm` turns the
// fewest. Of at most `turns`, until one has none.
std::size_t allocations_of_a_turn(const Case& c, Jobs& jobs, int warm, int turns = 1) {
    const scene::Scene scene = scene_of(c);
    FrameOptions options = small_picture();
    c.ask(options);
    Turn model(jobs, scene, options, kTurn);
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (int turn = 0; turn < warm + turns && fewest > 0; ++turn) {
        const std::size_t now = model.allocations();
        if (turn >= warm) fewest = std::min(fewest, now);
    }
    return fewest;
}

TEST(Steady, ATurningModelAllocatesNothing) {
    Jobs jobs(1);
    for (const Case& c : kCases)
        EXPECT_EQ(allocations_of_a_turn(c, jobs, 2), 0U) << c.name;
}

// Which worker meets the fullest tile differs from turn to turn, and on a busy machine one may come
// late to its first: buffers may still grow for a while, as may oneTBB's store of tasks. But there
// is a turn that asks for nothing, and soon.
TEST(Steady, OnSeveralThreadsNothingIsAllocatedEither) {
    Jobs jobs(3);
    for (const Case& c : kCases)
        EXPECT_EQ(allocations_of_a_turn(c, jobs, 2, 200), 0U) << c.name;
}

// Of every technique, on its own.
TEST(Steady, NoTechniqueAllocatesWhatItHasHadBefore) {
    Jobs jobs(1);
    const scene::Scene scene = scene_of(kCases[0]);
    for (const Technique* technique : techniques()) {
        FrameOptions options = small_picture();
        options.lights = {sun()};
        if (!ask(options, technique->axis, technique->name)) continue;
        Turn model(jobs, scene, options, 10);
        model.draw();
        model.draw();
        EXPECT_EQ(model.allocations(), 0U) << technique->axis << ' ' << technique->name;
    }
}

TEST(Steady, TheFirstTurnIsSeenToAllocate) {
    Jobs jobs(1);
    EXPECT_GT(allocations_of_a_turn(kCases[0], jobs, 0), 10U);
}

} // namespace
} // namespace scanout::frame

#endif
