// While a model turns, nothing is allocated: not by us, and not by oneTBB below us. Every way to
// malloc of this process is counted.
#include "base/jobs.h"
#include "frame/plan.h"
#include "frame/renderer.h"
#include "frame/techniques.h"
#include "io/load.h"
#include "simd/targets.h"
#include "support/meshes.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <limits>

#include <dlfcn.h>
#include <gtest/gtest.h>

#ifndef SCANOUT_SANITIZED

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
}

namespace {

std::atomic<bool> counting = false;
std::atomic<std::size_t> allocations = 0;

void count() {
    if (counting.load(std::memory_order_relaxed)) ++allocations;
}

} // namespace

extern "C" {
void* malloc(std::size_t size) {
    count();
    return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
    count();
    return __libc_calloc(number, size);
}
void* realloc(void* block, std::size_t size) {
    count();
    return __libc_realloc(block, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
    count();
    return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    count();
    return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
    count();
    *block = __libc_memalign(alignment, size);
    return *block == nullptr ? ENOMEM : 0;
}
}

// Without its own allocator oneTBB takes its memory from malloc, as we do.
extern "C" void* dlopen(const char* name, int mode) {
    using Function = void* (*)(const char*, int);
    if (name != nullptr && std::strstr(name, "tbbmalloc") != nullptr) return nullptr;
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, "dlopen"))(name, mode);
}

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
    {"overdraw", "spot/spot.obj", [](FrameOptions& o) { o.stencil = "overdraw"; }},
    {"low-pass", "spot/spot.obj", [](FrameOptions& o) { o.convolution = "low_pass"; }},
    {"facets", "angle_block/angle_block.stl", [](FrameOptions& o) { o.aa = "area"; }},
    {"hidden", nullptr, [](FrameOptions&) {}},
};

struct Frame {
    scene::View view;
    FramePlan plan;
};

// A turn of so many frames.
std::vector<Frame> planned(const scene::Scene& scene, const FrameOptions& options, int count) {
    const SceneFacts facts = frame::facts(scene);
    std::vector<Frame> frames;
    for (int i = 0; i < count; ++i) {
        scene::Pose pose;
        pose.yaw = scene::wrap_angle(std::int64_t{scene::kFullTurn} * i / count);
        const scene::View view =
            *scene::make_view(scene.mesh, {}, pose, {}, {}, options.width, options.height);
        frames.push_back({view, *plan(options, facts, view)});
    }
    return frames;
}

void draw(Renderer& renderer, const scene::Scene& scene, const std::vector<Frame>& frames) {
    for (const Frame& frame : frames)
        renderer.render(scene, frame.view, frame.plan);
}

std::size_t allocations_of(Renderer& renderer, const scene::Scene& scene,
                           const std::vector<Frame>& frames) {
    allocations = 0;
    counting = true;
    draw(renderer, scene, frames);
    counting = false;
    return allocations;
}

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
    const std::vector<Frame> frames = planned(scene, options, kTurn);
    Renderer renderer(jobs);
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (int turn = 0; turn < warm + turns && fewest > 0; ++turn) {
        const std::size_t now = allocations_of(renderer, scene, frames);
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
        const std::vector<Frame> frames = planned(scene, options, 10);
        Renderer renderer(jobs);
        draw(renderer, scene, frames);
        draw(renderer, scene, frames);
        EXPECT_EQ(allocations_of(renderer, scene, frames), 0U)
            << technique->axis << ' ' << technique->name;
    }
}

TEST(Steady, TheFirstTurnIsSeenToAllocate) {
    Jobs jobs(1);
    EXPECT_GT(allocations_of_a_turn(kCases[0], jobs, 0), 10U);
}

} // namespace
} // namespace scanout::frame

#endif
