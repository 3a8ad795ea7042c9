#include "app/picture/reference.h"

#include "base/available_memory.h"
#include "measure/ladder.h"
#include "rows.h"
#include "shade/stage.h"
#include "shade/transparency.h"
#include "trace/bvh.h"
#include "trace/probe.h"
#include "trace/progressive.h"

#include <algorithm>
#include <chrono>

namespace scanout::app {
namespace {

trace::Alpha alpha_of(raster::AlphaMode mode) {
    switch (mode) {
    case raster::AlphaMode::opaque:
        return trace::Alpha::opaque;
    case raster::AlphaMode::cut_out:
        return trace::Alpha::cut_out;
    case raster::AlphaMode::blended:
        return trace::Alpha::blended;
    case raster::AlphaMode::nothing:
        break;
    }
    return trace::Alpha::nothing;
}

std::vector<trace::Alpha> alpha_of(const std::vector<raster::AlphaMode>& modes) {
    std::vector<trace::Alpha> alpha;
    std::transform(modes.begin(), modes.end(), std::back_inserter(alpha),
                   [](raster::AlphaMode mode) { return alpha_of(mode); });
    return alpha;
}

trace::MapsRead maps_read(const frame::FramePlan& plan) {
    const auto reads = [&](shade::Map map) {
        return (plan.attributes.maps & shade::bit_of(map)) != 0;
    };
    const bool alpha_maps = plan.transparency.attributes.maps != 0;
    return {reads(shade::kDiffuseMap),   alpha_maps,
            reads(shade::kNormalMap),    reads(shade::kBumpMap),
            reads(shade::kSpecularMap),  reads(shade::kShininessMap),
            reads(shade::kRoughnessMap), reads(shade::kMetalnessMap),
            reads(shade::kEmissionMap)};
}

trace::Edges edges_of(const std::optional<shade::Wrap>& wrap) {
    if (!wrap) return trace::Edges::as_the_map_says;
    return *wrap == shade::Wrap::repeat   ? trace::Edges::repeat
           : *wrap == shade::Wrap::mirror ? trace::Edges::mirror
                                          : trace::Edges::clamp;
}

bool is_on(const frame::FramePlan& plan, std::string_view effect) {
    const frame::Decision* row = plan.decision(effect);
    return row != nullptr && row->on();
}

// What the reference has no formula for; null where there is nothing of it.
const char* not_traced(const frame::FramePlan& plan) {
    if (plan.depth_rule.test != raster::DepthTest::less)
        return "--depth-test: rays meet the nearest surface first";
    if (plan.stencil != nullptr) return "--stencil: it marks no pixels";
    if (plan.colours != nullptr) return "--colour-by: it shows light";
    if (plan.annotations.any()) return "--edges and --annotate: lines have no area";
    if (plan.convolution != nullptr) return "--convolution: it filters no finished picture";
    if (plan.source != nullptr) return "--source: it computes no textures";
    if (plan.mapped) return "--mapping: it lays no textures on the model";
    if (plan.transparency.blended != nullptr && plan.transparency.blend != &shade::blend::over)
        return "--blend: its surfaces lie over each other";
    return nullptr;
}

class ProbeOracle final : public measure::Oracle {
public:
    explicit ProbeOracle(trace::Probe probe) : probe_(std::move(probe)) {}
    double covered(int x, int y) const override { return probe_.covered(x, y); }
    bool is_inside(int x, int y) const override { return probe_.is_inside(x, y); }
    bool is_seen_through(int x, int y) const override { return probe_.is_seen_through(x, y); }
    std::optional<Place> on_triangle(std::uint32_t triangle, int x, int y) const override {
        const auto place = probe_.on_triangle(triangle, x, y);
        return place ? std::optional(Place{place->distance, place->uv}) : std::nullopt;
    }
    std::optional<bool> is_lit(int x, int y) const override { return probe_.is_lit(x, y); }

private:
    trace::Probe probe_;
};

} // namespace

Result<std::unique_ptr<measure::Oracle>>
oracle_of(const scene::Scene& scene, const scene::View& view, const trace::Look& look) {
    TRY(trace::Probe probe, trace::Probe::create(scene, view, look));
    return std::make_unique<ProbeOracle>(std::move(probe));
}

Result<trace::Look> look_of(const frame::FramePlan& plan) {
    if (const char* const what = not_traced(plan))
        return fail(Exit::usage, "the reference does not know {}", what);
    trace::Look look;
    look.width = plan.shown_width;
    look.height = plan.shown_height;
    look.background = plan.options.background;
    look.left = plan.options.cull == frame::Cull::back    ? trace::Left::backs
                : plan.options.cull == frame::Cull::front ? trace::Left::fronts
                                                          : trace::Left::none;
    look.one_sided = plan.one_sided;
    look.turned_to_eye = plan.sides != shade::Sides::file;
    look.maps = maps_read(plan);
    look.edges = edges_of(plan.wrap);
    look.vertex_colours = plan.attributes.colour;
    look.emission = is_on(plan, "emission");
    for (std::size_t i = 0; i < look.reflection.size(); ++i)
        look.reflection[i] = plan.reflection[i]->card.name;
    look.matt = plan.matt;
    look.alpha = alpha_of(plan.transparency.alpha_modes);
    look.alpha_cut = plan.options.alpha_cut;
    look.lights = plan.lights;
    look.occlusion_radius = plan.occlusion != nullptr ? shade::kOcclusionRadius : 0;
    look.shadows = plan.shadow.stage != nullptr;
    look.casts = alpha_of(plan.shadow.casters);
    look.exposure = double{plan.exposure};
    look.white = double{plan.white};
    look.tone = plan.decision("tone")->technique;
    if (plan.aa->weight != nullptr) look.filter = plan.aa->weight;
    return look;
}

Result<void> check_reference_fits(const scene::Scene& scene, int width, int height,
                                  int max_memory_mb) {
    constexpr std::uint64_t kMega = 1'000'000;
    const std::uint64_t wanted =
        trace::Bvh::bytes(scene.mesh.triangles()) + trace::Progressive::bytes(width, height);
    const std::uint64_t allowed = kMega * static_cast<std::uint64_t>(max_memory_mb),
                        available = available_bytes();
    if (max_memory_mb > 0 && wanted > allowed)
        return fail(Exit::unreadable,
                    "{}: the reference takes about {} MB for {} triangles, and --max-memory is {}",
                    scene.path, wanted / kMega, scene.mesh.triangles(), max_memory_mb);
    if (wanted > available)
        return fail(Exit::unreadable,
                    "{}: the reference takes about {} MB for {} triangles, and {} MB are left",
                    scene.path, wanted / kMega, scene.mesh.triangles(), available / kMega);
    return {};
}

Result<trace::Look> look_of_rungs(const scene::Scene& scene, const frame::SceneFacts& facts,
                                  const scene::View& view, const frame::FrameOptions& options,
                                  int max_memory_mb) {
    if (scene.mesh.triangles() == 0)
        return fail(Exit::usage,
                    "{}: nothing to gain: it has no triangles, and lines and points have no "
                    "reference; name another model",
                    scene.path);
    TRY(const frame::FramePlan plan, frame::plan(measure::without_rungs(options), facts, view));
    TRY(const trace::Look look, look_of(plan));
    TRY_VOID(check_reference_fits(scene, look.width, look.height, max_memory_mb));
    return look;
}

Result<trace::Reference> reference_of_rungs(const scene::Scene& scene, const scene::View& view,
                                            const trace::Look& look, Jobs& jobs,
                                            const trace::Effort& effort,
                                            const std::function<void(double)>& progress,
                                            const std::function<bool()>& stop) {
    constexpr std::chrono::milliseconds kStep{50};
    TRY(const std::unique_ptr<trace::Progressive> traced,
        trace::Progressive::create(scene, view, look, effort));
    while (!traced->finished()) {
        if (progress) progress(traced->share());
        if (stop && stop()) return fail(Exit::usage, "{}: the reference was stopped", scene.path);
        traced->step(jobs, std::chrono::steady_clock::now() + kStep);
    }
    trace::Reference made = traced->take();
    TRY_VOID(check_shows_a_difference(scene, made.image));
    return made;
}

Result<void> check_shows_a_difference(const scene::Scene& scene, const image::Image& reference) {
    const auto pixels = reference.pixels();
    if (std::any_of(pixels.begin(), pixels.end(),
                    [&](const image::Rgba8& p) { return !(p == pixels[0]); }))
        return {};
    return fail(Exit::usage,
                "{}: nothing to gain: every pixel of the picture has one colour, however it is "
                "drawn; turn the camera to the model, or name another one",
                scene.path);
}

std::vector<std::string> left_out_of_reference(const scene::Scene& scene) {
    const std::size_t lines = scene.mesh.lines(), points = scene.mesh.points();
    if (lines + points == 0) return {};
    return {fmt::format("{}: {} lines and {} points have no area: they are not in the reference",
                        scene.path, lines, points)};
}

} // namespace scanout::app
