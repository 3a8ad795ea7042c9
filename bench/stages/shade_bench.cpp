// Each shading stage, texture filter and computed source on one full block of 128 lanes; then the
// way from light to codes. The block is one of a frame's: the benchmark stands in the plan in the
// stage's place, and when the block comes, repeats the stage on it.
#include "base/jobs.h"
#include "bench/meshes/meshes.h"
#include "frame/plan/plan.h"
#include "frame/renderer.h"
#include "rows.h"
#include "scene/view.h"
#include "shade/mip/mip_chain.h"
#include "shade/resolve/output.h"
#include "shade/resolve/resolve.h"
#include "tests/support/random.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

namespace {

using namespace scanout;
using shade::kBlockSize;
using shade::ShadingBlock;

constexpr int kWidth = 960, kHeight = 540, kTexels = 256;

// What a stage may change of what it reads.
class Kept {
public:
    explicit Kept(const ShadingBlock& b) : ambient_(b.ambient), light_(b.light) {
        each(b, *this,
             [](const float* of_block, float* kept) { std::memcpy(kept, of_block, sizeof(Row)); });
    }
    void put_back(ShadingBlock& b) const {
        each(b, *this,
             [](float* of_block, const float* kept) { std::memcpy(of_block, kept, sizeof(Row)); });
        b.ambient = ambient_;
        for (std::size_t i = 0; i < light_.size(); ++i)
            std::memcpy(b.light[i].colour, light_[i].colour, sizeof(light_[i].colour));
    }
    bool same(const ShadingBlock& b) const {
        bool equal = b.ambient == ambient_;
        each(b, *this, [&](const float* of_block, const float* kept) {
            equal = equal && std::memcmp(of_block, kept, kBlockSize * sizeof(float)) == 0;
        });
        for (std::size_t i = 0; i < light_.size(); ++i)
            for (int c = 0; c < 3; ++c)
                equal = equal && std::memcmp(b.light[i].colour[c], light_[i].colour[c],
                                             kBlockSize * sizeof(float)) == 0;
        return equal;
    }

private:
    using Row = float[shade::kPaddedBlock];
    template <class B, class K, class F>
    static void each(B& b, K& kept, F&& f) {
        for (int c = 0; c < 3; ++c) {
            f(b.normal[c], kept.rows_[c]);
            f(b.albedo[c], kept.rows_[3 + c]);
            f(b.colour[c], kept.rows_[6 + c]);
        }
        f(b.alpha, kept.rows_[9]);
    }
    Row rows_[10];
    Vec3 ambient_;
    std::vector<shade::BlockLight> light_;
};

// What is measured. Stages are plain functions, so it stands beside them.
struct Watched {
    benchmark::State* state = nullptr; // null: blocks are only counted
    const shade::Stage* stage = nullptr;
    const shade::Filter* filter = nullptr;
    const shade::Source* source = nullptr;
    int blocks = 0, chosen = 0; // full ones, up to now; the one to measure
    bool changing = false;      // or the first after it that the stage changes
} watched;

// Runs it once, or, on the chosen block, as often as the benchmark asks. A stage that changes what
// it reads would soon work on zeros: it gets its input back each time, and the label says so.
template <class F>
void watch(ShadingBlock& b, F&& run) {
    if (b.count < kBlockSize || watched.blocks++ < watched.chosen || watched.state == nullptr)
        return run();
    const Kept before(b);
    run();
    if (watched.changing && before.same(b)) return;
    benchmark::State& state = *std::exchange(watched.state, nullptr);
    const Kept once(b);
    run();
    const bool repeatable = once.same(b);
    for (auto _ : state) {
        if (!repeatable) before.put_back(b);
        run();
        benchmark::ClobberMemory();
    }
    if (!repeatable) before.put_back(b);
    run();
    state.SetLabel(repeatable ? "" : "its input put back each time");
    state.counters["lanes"] =
        benchmark::Counter(kBlockSize, benchmark::Counter::kIsIterationInvariantRate);
    state.counters["runs"] = b.runs;
}

void watch_stage(ShadingBlock& b, const shade::FrameState& frame) {
    watch(b, [&] { watched.stage->run(b, frame); });
}
void watch_filter(ShadingBlock& b, const shade::BoundMap& map, shade::TexelKind kind) {
    watch(b, [&] { watched.filter->sample(b, map, kind); });
}
void watch_source(ShadingBlock& b) {
    watch(b, [&] { watched.source->sample(b); });
}

image::Image noise(std::uint64_t seed, int levels) {
    image::Image picture(kTexels, kTexels);
    test::Random random(seed);
    const auto code = [&] {
        return static_cast<std::uint8_t>(random.whole(0, levels - 1) * 255 / (levels - 1));
    };
    for (int y = 0; y < kTexels; ++y)
        for (int x = 0; x < kTexels; ++x) {
            const std::uint8_t red = code(), green = code();
            picture.at(x, y) = {red, green, code(), 255};
        }
    return picture;
}

// A mesh whose one material has every map that its kind can have.
enum class Kind { glossy, physical, with_holes };
Kind kind_for(const Technique& card) {
    if (card.name == "opacity") return Kind::with_holes;
    const bool physical =
        card.name == "ggx" || card.name == "roughness" || card.name == "metalness";
    return physical ? Kind::physical : Kind::glossy;
}
Result<scene::Scene> make_scene(const std::string& mesh, Kind kind) {
    scene::Scene scene;
    TRY(scene.mesh, bench::make_mesh(mesh));
    std::fill(scene.mesh.material.begin(), scene.mesh.material.end(), 0);
    scene.textures.push_back({"noise", noise(1, 256)});
    scene.textures.push_back({"holes", noise(2, 2)});
    scene::Material m;
    m.diffuse = {0.7F, 0.6F, 0.5F};
    m.specular = Vec3(0.3F);
    m.shininess = 32;
    if (kind == Kind::physical) {
        m.roughness = 0.4F;
        m.metalness = 0.3F;
    }
    m.emission = Vec3(0.05F);
    for (auto map : {&m.map_diffuse, &m.map_specular, &m.map_shininess, &m.map_emission,
                     &m.map_roughness, &m.map_metalness, &m.map_bump, &m.map_normal}) {
        map->edit().texture = 0;
        map->edit().path = "noise";
    }
    if (kind == Kind::with_holes) {
        m.map_opacity.edit().texture = 1;
        m.map_opacity.edit().path = "holes";
    }
    scene.materials.push_back(m);
    return scene;
}

// One light of each kind, beside the ambient one. In the building they hang in the hall.
std::vector<scene::Light> lights(bool cast, bool directional_alone, double size) {
    scene::Light ambient, sun, point, spot;
    ambient.name = "ambient";
    ambient.kind = scene::LightKind::ambient;
    ambient.power = 0.1;
    sun.name = "sun";
    sun.frame = scene::LightFrame::camera;
    sun.towards = {0.4, 0.7, 0.6};
    point.name = "point";
    point.kind = scene::LightKind::point;
    point.position = {3, 6, -1};
    point.size = size;
    spot.name = "spot";
    spot.kind = scene::LightKind::spot;
    spot.position = {-2, 7, 1};
    spot.target = DVec3(6, 0, 2);
    spot.inner_degrees = 40;
    spot.outer_degrees = 60;
    sun.casts = cast && directional_alone;
    point.casts = spot.casts = cast && !directional_alone;
    ambient.casts = false;
    if (directional_alone) return {ambient, sun};
    return {ambient, sun, point, spot};
}

// What brings a technique into the plan.
frame::FrameOptions options_for(const Technique& card) {
    frame::FrameOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.texture = "trilinear";
    const bool shadow = card.axis == "shadow",
               sun = card.axis == "light" && card.name == "directional";
    options.reflection = kind_for(card) == Kind::physical ? "ggx" : "blinn_phong";
    options.shadow_plane = frame::FilePlane{{0, 1, 0}, 0}; // the hall's floor
    // The map of a point light has six sides.
    options.lights = lights(shadow || sun, sun, card.name == "map_soft" ? 0.2 : 0);
    if (sun) options.shadow = "map";
    if (card.axis == "tone") options.exposure = 0.5; // else there is nothing to do
    frame::ask(options, card.axis, card.name);
    return options;
}

template <class T>
void put(std::vector<const T*>& list, const T* from, const T* to) {
    std::replace(list.begin(), list.end(), from, to);
}

// The plan with the benchmark in the technique's place.
void stand_in(frame::FramePlan& plan, const shade::Stage& stage) {
    static shade::Stage wrapped{};
    wrapped = stage;
    wrapped.run = watch_stage;
    watched.stage = &stage;
    put(plan.stages, &stage, &std::as_const(wrapped));
    put(plan.transparency.stages, &stage, &std::as_const(wrapped));
    std::replace(plan.reflection.begin(), plan.reflection.end(), &stage, &std::as_const(wrapped));
}
void stand_in(frame::FramePlan& plan, const shade::Filter& filter) {
    static shade::Filter wrapped{};
    wrapped = filter;
    wrapped.sample = watch_filter;
    watched.filter = &filter;
    if (plan.filter == &filter) plan.filter = &wrapped;
}
void stand_in(frame::FramePlan& plan, const shade::Source& source) {
    static shade::Source wrapped{};
    wrapped = source;
    wrapped.sample = watch_source;
    watched.source = &source;
    if (plan.source == &source) plan.source = &wrapped;
}

// Scenes are made once each.
Result<const scene::Scene*> scene_of(const std::string& mesh, Kind kind) {
    static std::map<std::pair<std::string, Kind>, scene::Scene> made;
    const auto found = made.find({mesh, kind});
    if (found != made.end()) return &found->second;
    TRY(scene::Scene scene, make_scene(mesh, kind));
    return &made.emplace(std::pair(mesh, kind), std::move(scene)).first->second;
}

// From the middle of the hall slightly down, so that the floor is in the picture's middle: light,
// shadows and slanted textures are there.
scene::CameraOptions camera_for(const std::string& mesh) {
    scene::CameraOptions camera;
    if (mesh != "building") return camera;
    camera.eye = bench::kEyeInBuilding;
    camera.target = bench::kEyeInBuilding + DVec3(1, -0.25, 0.3);
    camera.fov_degrees = 60;
    return camera;
}

template <class T>
Result<void> render(const std::string& mesh, const T& technique, benchmark::State& state) {
    const Technique& card = technique.card;
    TRY(const scene::Scene* const scene, scene_of(mesh, kind_for(card)));
    TRY(const scene::View view,
        scene::make_view(scene->mesh, {}, {}, camera_for(mesh), {}, kWidth, kHeight));
    const frame::FrameOptions options = options_for(card);
    const frame::SceneFacts facts = frame::facts(*scene, options.shadow_plane);
    TRY(frame::FramePlan plan, frame::plan(options, facts, view));
    stand_in(plan, technique);
    Jobs jobs(1);
    frame::Renderer renderer(jobs);
    watched.state = nullptr;
    watched.blocks = 0;
    renderer.render(*scene, view, plan);
    watched.chosen = watched.blocks / 2;      // from the middle of the picture
    watched.changing = card.axis == "shadow"; // light that reaches all lanes is no work for some
    watched.blocks = 0;
    watched.state = &state;
    renderer.render(*scene, view, plan);
    if (std::exchange(watched.state, nullptr) != nullptr)
        return fail(Exit::usage, "no full block of this frame runs it");
    return {};
}

template <class T>
void lanes(benchmark::State& state, const std::string& mesh, const T* technique) {
    const auto done = render(mesh, *technique, state);
    if (!done) state.SkipWithError(done.error().what.c_str());
}

// Light of random pixels, a little of it above white.
struct Pixels {
    std::vector<float> red, green, blue;
    explicit Pixels(std::size_t count) {
        test::Random random(3);
        for (auto* channel : {&red, &green, &blue})
            for (std::size_t i = 0; i < count + shade::kPaddedBlock; ++i)
                channel->push_back(static_cast<float>(random.in(0, 1.1)));
    }
};

void count_pixels(benchmark::State& state, int pixels) {
    state.counters["pixels"] =
        benchmark::Counter(pixels, benchmark::Counter::kIsIterationInvariantRate);
}

void encode(benchmark::State& state, const shade::Encoding* encoding) {
    const Pixels light(kBlockSize);
    std::vector<std::uint32_t> out(shade::kPaddedBlock);
    for (auto _ : state) {
        encoding->encode({light.red.data(), light.green.data(), light.blue.data()}, kBlockSize,
                         out.data());
        benchmark::DoNotOptimize(out.data());
        benchmark::ClobberMemory();
    }
    count_pixels(state, kBlockSize);
}

// A tile's pixels that triangles share. Its sums are used up, so putting them back is in the time.
void resolve(benchmark::State& state) {
    constexpr int kPixels = 64 * 64;
    const Pixels light(kPixels);
    shade::PixelSums full;
    full.reset(kPixels);
    std::copy_n(light.red.begin(), kPixels, full.red.begin());
    std::copy_n(light.green.begin(), kPixels, full.green.begin());
    std::copy_n(light.blue.begin(), kPixels, full.blue.begin());
    std::fill_n(full.alpha.begin(), kPixels, 255);
    for (int i = 0; i < kPixels; i += 4) // at the rim
        full.transmittance[static_cast<std::size_t>(i)] = 0.25F;
    std::vector<std::uint32_t> out(kPixels + shade::kPaddedBlock);
    shade::PixelSums sums = full;
    for (auto _ : state) {
        sums = full;
        shade::resolve_pixels(sums, {}, {48, 51, 56, 255}, nullptr, kPixels, out.data());
        benchmark::DoNotOptimize(out.data());
        benchmark::ClobberMemory();
    }
    count_pixels(state, kPixels);
}
BENCHMARK(resolve);

// All levels of a texture of 1024 x 1024 texels, in memory that is written already.
void mip_chain(benchmark::State& state) {
    constexpr int kSide = 1024;
    image::Image image(kSide, kSide);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            image.row(y)[static_cast<std::size_t>(x)] = {
                static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y),
                static_cast<std::uint8_t>(x * y / 64), static_cast<std::uint8_t>(255 - x / 8)};
    Jobs jobs(1);
    for (auto _ : state)
        benchmark::DoNotOptimize(shade::make_mip_chain(image, shade::TexelKind::colour, jobs));
    count_pixels(state, kSide * kSide);
}
BENCHMARK(mip_chain)->Unit(benchmark::kMillisecond);

const bool kRegistered = [] {
    const auto add = [](const std::string& mesh, const auto* technique) {
        const Technique& card = technique->card;
        const std::string name = std::string(card.axis) + "/" + std::string(card.name) + "/" +
                                 (mesh == "building" ? mesh : "knot_100k");
        benchmark::RegisterBenchmark(
            name.c_str(), [=](benchmark::State& state) { lanes(state, mesh, technique); });
    };
    for (const shade::Stage* stage : shade::stages()) {
        // Names without work of their own.
        if (stage->run == nullptr) continue;
        add("building", stage);
        // What is done once a triangle, where triangles are small.
        if (stage->card.axis == "interpolate" || stage->card.axis == "shading")
            add("knot:100000", stage);
    }
    for (const shade::Filter* filter : shade::texture::kRows)
        add("building", filter);
    for (const shade::Source* source : shade::source::kRows)
        if (source->sample != nullptr) add("building", source);
    for (const shade::Encoding* encoding : shade::encode::kRows)
        benchmark::RegisterBenchmark(("encode/" + std::string(encoding->card.name)).c_str(), encode,
                                     encoding);
    return true;
}();

} // namespace
