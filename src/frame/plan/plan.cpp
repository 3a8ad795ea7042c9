#include "frame/plan/planner.h"
#include "raster/screen/sample_pattern.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::frame {
namespace {

void sort_stages(std::vector<const shade::Stage*>& stages) {
    std::stable_sort(
        stages.begin(), stages.end(),
        [](const shade::Stage* a, const shade::Stage* b) { return a->pass < b->pass; });
}

// Effects that the user names must exist.
Result<void> check_effects(const FrameOptions& options, const FramePlan& plan) {
    for (const auto& [name, on] : options.effects) {
        const Decision* row = plan.decision(name);
        if (row != nullptr && !row->choice) continue;
        if (row != nullptr)
            return fail(Exit::usage, "--effect {0}={1}: {0} is no effect; say --{2} NAME", name,
                        on ? "on" : "off", option_of(name));
        std::string known;
        for (const Decision& d : plan.decisions)
            if (!d.choice) known += " " + d.effect;
        return fail(Exit::usage, "--effect {}={}: there is no such effect; choose one of{}", name,
                    on ? "on" : "off", known);
    }
    return {};
}

} // namespace

const Decision* FramePlan::decision(std::string_view effect) const {
    const auto found = std::find_if(decisions.begin(), decisions.end(),
                                    [&](const Decision& d) { return d.effect == effect; });
    return found == decisions.end() ? nullptr : &*found;
}

bool draws_alike(const FramePlan& a, const FramePlan& b) {
    // What was asked for is decided: the renderer reads sizes, culling, background and limits of
    // the options alone.
    const auto decided = [](FramePlan plan) {
        plan.decisions.clear();
        plan.options.effects.clear();
        plan.options.lights.clear(); // the plan has those that reach something
        for (const AskedAxis& axis : asked_axes())
            plan.options.*axis.asked = "auto";
        return plan;
    };
    return decided(a) == decided(b);
}

std::string to_string(const Decision& d) {
    return fmt::format("{} {}: {}{}", d.effect, d.technique, d.because,
                       d.forced ? " (forced)" : "");
}

Result<void> check_numbers(const FrameOptions& o) {
    if (o.width < 1 || o.height < 1 || o.width > kMaxSide || o.height > kMaxSide)
        return fail(Exit::usage,
                    "a picture of {}x{} pixels is not possible: each side must be 1 to {}", o.width,
                    o.height, kMaxSide);
    if (raster::sample_pattern(o.samples).empty())
        return fail(Exit::usage, "--samples {}: choose 1, 2, 4, 8 or 16", o.samples);
    if (o.lights.size() > scene::kMaxLights)
        return fail(Exit::usage, "--light: {} lights; there may be {}", o.lights.size(),
                    scene::kMaxLights);
    if (o.shadow_size < kMinShadowSize || o.shadow_size > kMaxShadowSize)
        return fail(Exit::usage, "--shadow-size {}: choose {} to {}", o.shadow_size, kMinShadowSize,
                    kMaxShadowSize);
    if (o.shadow_filter < 1 || o.shadow_filter > kMaxShadowFilter)
        return fail(Exit::usage, "--shadow-filter {}: choose 1 to {}", o.shadow_filter,
                    kMaxShadowFilter);
    return {};
}

static Result<FramePlan> plan_of_seen(const FrameOptions& options, const SceneFacts& facts,
                                      const ViewFacts& view) {
    FramePlan plan;
    plan.options = options;
    if (options.background.a == 0) plan.options.background = {0, 0, 0, 0}; // of no colour
    plan.only_material = facts.only_material;
    plan_culling(plan, facts);
    Planner planner(options, plan);
    const shade::Stage& exact = shade::interpolate::perspective;
    TRY(const shade::Stage* const steps,
        choose(shade::interpolate::kRows, options.interpolate, exact));
    const bool flat = view.orthographic;
    planner.choice("interpolate", steps->card.name, options.interpolate,
                   facts.triangles == 0 ? "along lines, colours are exact under every method"
                   : flat ? "nothing is foreshortened: but for rounding all ways are the same"
                   : steps == &exact ? "a division a pixel is exact at any ratio of distances"
                                     : std::string(steps->card.blurb),
                   facts.triangles > 0 && !flat);
    planner.stage(*steps);

    TRY_VOID(plan_texture(planner, plan, facts));
    TRY_VOID(plan_light(planner, plan, facts, view));
    plan_maps(planner, plan, facts);

    if (planner.effect("vertex_colours", "on", facts.vertex_colours && !facts.white_colours,
                       facts.white_colours    ? "all that the file gives are white"
                       : facts.vertex_colours ? "the file gives them"
                                              : "the file gives none"))
        plan.attributes.colour = facts.vertex_colours;
    TRY_VOID(plan_transparency(planner, plan, facts));
    plan_casters(plan, facts);
    TRY_VOID(plan_merging(planner, plan, facts, view));
    TRY_VOID(plan_stencil(planner, plan, facts));
    plan_section(planner, facts);
    TRY_VOID(plan_annotations(planner, plan, facts));
    TRY_VOID(plan_colours(planner, plan, facts));
    TRY_VOID(plan_tone(options, facts, planner, plan));
    TRY_VOID(plan_size(planner, plan));
    TRY_VOID(plan_edges(options, facts, planner, plan));
    TRY_VOID(plan_output(options, facts, planner, plan));
    TRY_VOID(plan_sampling(planner, plan, facts));
    sort_stages(plan.stages);
    if (facts.triangles == 0)
        plan.attributes = {.colour = plan.attributes.colour}; // lines and points are unlit
    TRY_VOID(check_effects(options, plan));
    if (plan.colours != nullptr) plan_false_colours(plan);
    if (plan.stencil != nullptr && plan.stencil->marks == Stencil::Marks::covering)
        plan_counts(plan);
    return plan;
}

Result<FramePlan> plan_without_filter(const FrameOptions& options, const SceneFacts& facts,
                                      const ViewFacts& view) {
    if (view.in_view) return plan_of_seen(options, facts, view);
    TRY(FramePlan plan, plan_of_seen(options, SceneFacts(), view));
    plan.techniques.clear(); // no pixel is shaded
    for (Decision& d : plan.decisions)
        if (!d.on() || !d.needed) d.because = "nothing of the model is in view";
    return plan;
}

Result<FramePlan> plan(const FrameOptions& options, const SceneFacts& facts,
                       const scene::View& view) {
    TRY_VOID(check_numbers(options));
    TRY(FramePlan plan, plan_without_filter(options, facts, view_facts(options, facts, view)));
    plan_filter(plan, facts, view);
    return plan;
}

const MaterialSet* materials_calling(const SceneFacts& facts, const FramePlan& plan,
                                     std::string_view effect) {
    const auto& by_ks = facts.by_ks.materials_of;
    const auto found = by_ks_alone(plan) ? by_ks.find(effect) : by_ks.end();
    if (found != by_ks.end()) return &found->second;
    const auto other = facts.materials_of.find(effect);
    return other != facts.materials_of.end() ? &other->second : nullptr;
}

} // namespace scanout::frame
