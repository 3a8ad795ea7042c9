// frames counts|laws MODEL [options of scanout explain]: one scene's frames for the tests of
// effects, with the plan as it is and with each effect switched, as JSON on standard output.
//
// counts: made to run under callgrind, which collects inside counted(): the frame as it is, then
// one for each effect that the scene does not need, switched off by name. Each is drawn twice, and
// the second time counts: the first makes room. laws: what the frames are: their hashes, their
// light, their memory, their lanes.
#include "app/options/command_line.h"
#include "frame/plan/bytes.h"
#include "frame/renderer.h"
#include "image/hash.h"
#include "io/load.h"
#include "raster/screen/primitive.h"
#include "scene/fit.h"
#include "simd/targets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

namespace {

// What operator new has given out and not got back: the frame's buffers, by their true owner.
std::size_t held_bytes = 0;

// Blocks of powers of two, kept by their size when they come back: what taking one costs does not
// depend on what was given back before, as it does with malloc. All of one size stand at the same
// place in a page, on which the way that the C library copies depends. For one thread.
constexpr std::size_t kHead = 64; // keeps every alignment that is asked for here
constexpr std::size_t kChunk = std::size_t{1} << 24, kPage = 4096;
std::array<std::byte*, 48> given_back{};
std::byte *chunk = nullptr, *chunk_end = nullptr;

std::byte* block_of(std::size_t bytes, std::size_t power) {
    if (std::byte* const block = given_back[power]; block != nullptr) {
        std::memcpy(&given_back[power], block + kHead, sizeof block);
        return block;
    }
    const std::size_t place = std::min(bytes, kPage);
    if (chunk != nullptr) chunk += -std::bit_cast<std::uintptr_t>(chunk) & (place - 1);
    if (chunk == nullptr || chunk > chunk_end ||
        static_cast<std::size_t>(chunk_end - chunk) < bytes) {
        const std::size_t room = std::max(bytes, kChunk);
        chunk = static_cast<std::byte*>(std::aligned_alloc(kPage, room));
        if (chunk == nullptr) throw std::bad_alloc();
        chunk_end = chunk + room;
    }
    return std::exchange(chunk, chunk + bytes);
}

void* take(std::size_t size) {
    const auto power = static_cast<std::size_t>(std::bit_width(size + 2 * kHead - 1));
    std::byte* const block = block_of(std::size_t{1} << power, power);
    std::memcpy(block, &size, sizeof size);
    held_bytes += size;
    return block + kHead;
}
void give_back(void* memory) {
    if (memory == nullptr) return;
    std::byte* const block = static_cast<std::byte*>(memory) - kHead;
    std::size_t size = 0;
    std::memcpy(&size, block, sizeof size);
    held_bytes -= size;
    const auto power = static_cast<std::size_t>(std::bit_width(size + 2 * kHead - 1));
    std::memcpy(block + kHead, &given_back[power], sizeof block);
    given_back[power] = block;
}

} // namespace

void* operator new(std::size_t size) {
    return take(size);
}
void* operator new(std::size_t size, std::align_val_t) {
    return take(size);
}
void operator delete(void* memory) noexcept {
    give_back(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    give_back(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    give_back(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    give_back(memory);
}

// Outside of any namespace: its name is given to callgrind.
const scanout::image::Image& counted(scanout::frame::Renderer& renderer,
                                     const scanout::scene::Scene& scene,
                                     const scanout::scene::View& view,
                                     const scanout::frame::FramePlan& plan);
[[gnu::noinline]] const scanout::image::Image& counted(scanout::frame::Renderer& renderer,
                                                       const scanout::scene::Scene& scene,
                                                       const scanout::scene::View& view,
                                                       const scanout::frame::FramePlan& plan) {
    const scanout::image::Image& picture = renderer.render(scene, view, plan);
    asm volatile("" ::: "memory"); // a call, not a jump: callgrind has to see it return
    return picture;
}

namespace scanout::test {
namespace {

using Json = nlohmann::ordered_json;

// The scene of the command line.
struct Subject {
    app::Settings settings;
    scene::Scene scene;
    scene::View view;
    frame::SceneFacts facts;

    Result<frame::FramePlan>
    plan(const std::map<std::string, bool, std::less<>>& forced = {}) const {
        frame::FrameOptions options = settings.frame;
        for (const auto& [effect, on] : forced)
            options.effects[effect] = on;
        return frame::plan(options, facts, view);
    }
};

Result<Subject> load(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "explain");
    TRY(const app::CommandLine line, app::parse_command_line(std::move(arguments)));
    Subject s;
    s.settings = line.settings;
    Warnings warnings;
    TRY(s.scene, io::load(s.settings.arguments.at(0), {}, warnings));
    const double aspect = static_cast<double>(s.settings.frame.width) / s.settings.frame.height;
    const scene::CameraOptions camera =
        scene::fitted(s.scene.mesh, s.settings.model, s.settings.camera, aspect);
    TRY(s.view, scene::make_view(s.scene.mesh, s.settings.model, {}, camera, {},
                                 s.settings.frame.width, s.settings.frame.height));
    s.facts = frame::facts(s.scene, s.settings.frame.shadow_plane);
    if (!simd::choose_target(s.settings.target))
        return fail(Exit::usage, "--target {}: not here", s.settings.target);
    return s;
}

Json names(const std::vector<const Technique*>& techniques) {
    Json list = Json::array();
    for (const Technique* t : techniques)
        list.push_back(std::string(t->axis) + "/" + std::string(t->name));
    return list;
}

Json count(const Subject& s, Jobs& jobs, const std::string& label, const frame::FramePlan& plan) {
    frame::Renderer renderer(jobs);
    renderer.render(s.scene, s.view, plan);
    counted(renderer, s.scene, s.view, plan);
    return {{"label", label}, {"techniques", names(plan.techniques)}};
}

Result<Json> counts(const Subject& s, Jobs& jobs) {
    Json frames = Json::array();
    TRY(const frame::FramePlan whole, s.plan());
    frames.push_back(count(s, jobs, "auto", whole));
    for (const frame::Decision& d : whole.decisions) {
        if (d.needed || d.choice) continue;
        TRY(const frame::FramePlan off, s.plan({{d.effect, false}}));
        frames.push_back(count(s, jobs, d.effect + "=off", off));
    }
    return frames;
}

struct Drawn {
    std::string hash;
    shade::LinearPicture light;
    std::size_t held = 0; // by the renderer
    frame::FrameStats stats;
    frame::Visibility visible;
};

Drawn draw(const Subject& s, Jobs& jobs, const frame::FramePlan& plan) {
    Drawn drawn;
    const std::size_t before = held_bytes;
    frame::Renderer renderer(jobs);
    renderer.render(s.scene, s.view, plan);
    drawn.held = held_bytes - before;
    const image::Image& picture =
        renderer.render(s.scene, s.view, plan, &drawn.visible, 64, &drawn.light);
    drawn.hash = image::hash_text(image::frame_hash(picture));
    drawn.stats = renderer.stats();
    return drawn;
}

// Distinct primitives in each pixel, summed, and pixels that show one alone at all samples.
std::pair<std::uint64_t, std::uint64_t> fragments(const frame::Visibility& v) {
    const std::size_t pixels =
        static_cast<std::size_t>(v.width) * static_cast<std::size_t>(v.height);
    std::uint64_t distinct = 0, interior = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        std::set<std::uint32_t> ids;
        bool whole = true;
        for (std::size_t sample = 0; sample < static_cast<std::size_t>(v.samples); ++sample) {
            const std::uint32_t id = v.id[sample * pixels + i];
            whole = whole && id != raster::kNoPrimitive;
            if (id != raster::kNoPrimitive) ids.insert(id);
        }
        distinct += ids.size();
        interior += whole && ids.size() == 1 ? 1U : 0U;
    }
    return {distinct, interior};
}

// A frame of a plan with other decisions, against the one as it is.
Json against(const Drawn& whole, const Drawn& other) {
    return {{"same_picture", whole.hash == other.hash},
            {"same_light", whole.light == other.light},
            {"held", other.held}};
}

Result<Json> laws(const Subject& s, Jobs& jobs) {
    TRY(const frame::FramePlan whole_plan, s.plan());
    const Drawn whole = draw(s, jobs, whole_plan);
    const frame::EffectBytes bytes = frame::bytes_by_effect(s.scene, whole_plan);
    const auto [distinct, interior] = fragments(whole.visible);
    Json effects = Json::array();
    std::map<std::string, bool, std::less<>> all;
    for (const frame::Decision& d : whole_plan.decisions) {
        if (d.choice) continue; // a rung or a model: it has a bound, not a neutral element
        const auto held = bytes.find(d.effect);
        Json row = {{"effect", d.effect},
                    {"on", d.on()},
                    {"needed", d.needed},
                    {"bytes", held == bytes.end() ? 0 : held->second}};
        TRY(const frame::FramePlan off, s.plan({{d.effect, false}}));
        row["off"] = against(whole, draw(s, jobs, off));
        TRY(const frame::FramePlan on, s.plan({{d.effect, true}}));
        row["forced"] = against(whole, draw(s, jobs, on));
        all[d.effect] = true;
        effects.push_back(std::move(row));
    }
    TRY(const frame::FramePlan everything, s.plan(all));
    return Json{{"held", whole.held},
                {"effects", std::move(effects)},
                {"everything", against(whole, draw(s, jobs, everything))},
                {"blended", whole_plan.transparency.blended != nullptr},
                {"lanes", whole.stats.items_shaded},
                {"fragments", distinct},
                {"interior", interior}};
}

Result<void> run(std::vector<std::string> arguments) {
    if (arguments.size() < 2) return fail(Exit::usage, "frames counts|laws MODEL [options]");
    const std::string what = arguments.front();
    arguments.erase(arguments.begin());
    TRY(const Subject subject, load(std::move(arguments)));
    Jobs jobs(1); // counts, and the memory of one worker
    TRY(const Json result, what == "counts" ? counts(subject, jobs) : laws(subject, jobs));
    std::puts(result.dump(1).c_str());
    return {};
}

} // namespace
} // namespace scanout::test

int main(int argc, char** argv) {
    const auto done = scanout::test::run({argv + 1, argv + argc});
    if (!done) std::fprintf(stderr, "frames: %s\n", done.error().what.c_str());
    return done ? 0 : 1;
}
