#include "frame/plan.h"

#include "base/check.h"
#include "frame/techniques.h"
#include "raster/sample_pattern.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::frame {
namespace {

// What the user asked for on an axis, or the automatic choice, when the axis has it.
Result<std::string> choose(std::string_view axis, const std::string& asked,
                           std::string_view automatic) {
    const std::string_view name = asked == "auto" ? automatic : std::string_view(asked);
    for (const Technique* technique : techniques())
        if (technique->axis == axis && technique->name == name) return std::string(name);
    return fail(Exit::usage, "--{} {}: there is no such technique; choose auto{}", axis, asked,
                names_of(axis));
}

Result<void> check_numbers(const FrameOptions& o) {
    if (o.width < 1 || o.height < 1 || o.width > kMaxSide || o.height > kMaxSide)
        return fail(Exit::usage,
                    "a picture of {}x{} pixels is not possible: each side must be 1 to {}", o.width,
                    o.height, kMaxSide);
    if (raster::sample_pattern(o.samples).empty())
        return fail(Exit::usage, "--samples {}: choose 1, 2, 4, 8 or 16", o.samples);
    if (o.lights.size() > scene::kMostLights)
        return fail(Exit::usage, "--light: {} lights; there may be {}", o.lights.size(),
                    scene::kMostLights);
    if (o.shadow_size < kLeastShadowSize || o.shadow_size > kMostShadowSize)
        return fail(Exit::usage, "--shadow-size {}: choose {} to {}", o.shadow_size,
                    kLeastShadowSize, kMostShadowSize);
    if (o.shadow_filter < 1 || o.shadow_filter > kMostShadowFilter)
        return fail(Exit::usage, "--shadow-filter {}: choose 1 to {}", o.shadow_filter,
                    kMostShadowFilter);
    return {};
}

} // namespace

const Decision* FramePlan::decision(std::string_view effect) const {
    const auto found = std::find_if(decisions.begin(), decisions.end(),
                                    [&](const Decision& d) { return d.effect == effect; });
    return found == decisions.end() ? nullptr : &*found;
}

std::string to_string(const Decision& d) {
    return fmt::format("{} {}: {}{}", d.effect, d.technique, d.because,
                       d.forced ? " (forced)" : "");
}

namespace {

// Builds a plan row by row.
class Planner {
public:
    Planner(const FrameOptions& options, FramePlan& plan) : options_(options), plan_(plan) {}

    // Decides an effect: on when the scene needs it, unless the user forces it. Returns whether.
    bool effect(std::string name, std::string technique, bool needed, std::string because) {
        const auto forced = options_.effects.find(name);
        const bool is_forced = forced != options_.effects.end();
        const bool on = is_forced ? forced->second : needed;
        plan_.decisions.push_back({std::move(name), on ? std::move(technique) : "off",
                                   std::move(because), needed, is_forced && on != needed});
        return on;
    }
    void stage(std::string_view axis, std::string_view name) {
        const shade::Stage* found = shade::find_stage(axis, name);
        CHECK(found != nullptr);
        plan_.stages.push_back(found);
        plan_.techniques.push_back(&found->card);
        plan_.attributes = plan_.attributes | found->needs;
    }
    // It runs without a stage.
    void technique(std::string_view axis, std::string_view name) {
        const shade::Stage* found = shade::find_stage(axis, name);
        CHECK(found != nullptr);
        plan_.techniques.push_back(&found->card);
    }
    void filter(std::string_view name) {
        plan_.filter = shade::find_filter(name);
        CHECK(plan_.filter != nullptr);
        plan_.techniques.push_back(&plan_.filter->card);
        plan_.attributes = plan_.attributes | plan_.filter->needs;
    }

private:
    const FrameOptions& options_;
    FramePlan& plan_;
};

// One row for each kind of light: on where one shines that is not black, and something is lit.
void plan_lights(const FrameOptions& options, const SceneFacts& facts, Planner& planner,
                 FramePlan& plan) {
    for (const auto kind : {scene::LightKind::ambient, scene::LightKind::directional,
                            scene::LightKind::point, scene::LightKind::spot}) {
        std::string names;
        std::vector<scene::Light> shining;
        for (const scene::Light& light : options.lights) {
            if (light.kind != kind || is_black(light)) continue;
            names += (names.empty() ? "" : ", ") + light.name;
            shining.push_back(light);
        }
        const bool lit = facts.triangles > 0;
        const std::string because = shining.empty()
                                        ? fmt::format("there is no {} light", name_of(kind))
                                    : !lit ? "nothing is lit: there are no triangles"
                                           : fmt::format("{} light{}: {}", shining.size(),
                                                         shining.size() == 1 ? "" : "s", names);
        const bool on = planner.effect(fmt::format("{}_light", name_of(kind)), "on",
                                       lit && !shining.empty(), because);
        if (!on || !lit || shining.empty()) continue;
        plan.lights.insert(plan.lights.end(), shining.begin(), shining.end());
        // A directional light is the same in all lanes: there is nothing to write.
        if (kind != scene::LightKind::directional) planner.stage("light", name_of(kind));
    }
}

// Shadows: on where a light that shines casts them. A light with a size throws soft ones; those of
// a point are sharp, and the filtered map is the cheapest that shows no steps.
Result<void> plan_shadows(const FrameOptions& options, const SceneFacts& facts, Planner& planner,
                          FramePlan& plan) {
    std::string names;
    int casting = 0, sized = 0;
    bool directional = false;
    for (const scene::Light& light : plan.lights) {
        if (!light.casts || light.kind == scene::LightKind::ambient) continue;
        names += (names.empty() ? "" : ", ") + light.name;
        ++casting;
        sized += light.size > 0 ? 1 : 0;
        directional = directional || light.kind == scene::LightKind::directional;
    }
    TRY(const std::string name,
        choose("shadow", options.shadow, sized > 0 ? "map_soft" : "map_pcf"));
    const bool floor = name != "projected" || facts.ground.triangles > 0;
    std::string because =
        facts.triangles == 0 ? "nothing is lit: there are no triangles"
        : casting == 0       ? "no light that reaches anything casts shadows"
        : !floor
            ? "no triangle lies flat on a side of the model's box, to project shadows onto"
            : fmt::format("{} light{}: {}", casting, casting == 1 ? " casts" : "s cast", names);
    if (casting > 0 && sized > 0) because += fmt::format("; {} with a size", sized);
    const bool possible = casting > 0 && facts.triangles > 0 && floor;
    if (!planner.effect("shadow", name, possible, std::move(because)) || !possible) return {};
    if (name == "attached") {
        planner.technique("shadow", name);
        return {};
    }
    // A directional light now differs from lane to lane, too.
    if (directional) planner.stage("light", "directional");
    planner.stage("shadow", name);
    plan.shadow = plan.stages.back();
    plan.ground = facts.ground;
    return {};
}

// Effects that the user names must exist.
Result<void> check_effects(const FrameOptions& options, const FramePlan& plan) {
    for (const auto& [name, on] : options.effects) {
        if (plan.decision(name) != nullptr) continue;
        std::string known;
        for (const Decision& d : plan.decisions)
            known += " " + d.effect;
        return fail(Exit::usage, "--effect {}={}: there is no such effect; choose one of{}", name,
                    on ? "on" : "off", known);
    }
    return {};
}

} // namespace

Result<FramePlan> plan(const FrameOptions& options, const SceneFacts& facts) {
    TRY_VOID(check_numbers(options));
    FramePlan plan;
    plan.options = options;
    Planner planner(options, plan);
    planner.stage("interpolate", "perspective");

    TRY(const std::string filter, choose("texture", options.texture, "bilinear"));
    const bool textured = facts.textured_triangles > 0;
    if (planner.effect("texture", filter, textured,
                       textured ? fmt::format("{} of {} triangles have a readable map_Kd",
                                              facts.textured_triangles, facts.triangles)
                                : "no triangle has a readable map_Kd and texture coordinates") &&
        facts.triangles > 0 && facts.uv) {
        planner.filter(filter);
        planner.stage("map", "diffuse");
    }

    plan_lights(options, facts, planner, plan);
    TRY_VOID(plan_shadows(options, facts, planner, plan));

    const bool shiny = facts.specular_triangles > 0;
    TRY(const std::string model, choose("reflection", options.reflection, "blinn_phong"));
    const bool highlight =
        planner.effect("highlight", model, shiny && model != "lambert",
                       fmt::format("{} of {} triangles have a highlight (Ks not black, Ns above 0)",
                                   facts.specular_triangles, facts.triangles));
    planner.stage("reflection", highlight ? model : "lambert");

    if (planner.effect("vertex_colours", "on", facts.vertex_colours,
                       facts.vertex_colours ? "the file gives them" : "the file gives none"))
        plan.attributes.colour = facts.vertex_colours;
    if (facts.triangles == 0)
        plan.attributes.normal = plan.attributes.uv = false; // lines and points are unlit
    TRY_VOID(check_effects(options, plan));
    return plan;
}

} // namespace scanout::frame
