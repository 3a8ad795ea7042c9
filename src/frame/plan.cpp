#include "frame/plan.h"

#include "base/check.h"
#include "frame/techniques.h"
#include "raster/sample_pattern.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::frame {
namespace {

// The command line's name of an axis.
std::string option_of(std::string_view axis) {
    std::string name(axis);
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

// What the user asked for on an axis, or the automatic choice, when the axis has it.
Result<std::string> choose(std::string_view axis, const std::string& asked,
                           std::string_view automatic) {
    const std::string_view name = asked == "auto" ? automatic : std::string_view(asked);
    for (const Technique* technique : techniques())
        if (technique->axis == axis && technique->name == name) return std::string(name);
    return fail(Exit::usage, "--{} {}: there is no such technique; choose auto{}", option_of(axis),
                asked, names_of(axis));
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
    // Decides what no scene calls for, on an axis of its own: what the user asks for, and no row
    // where that is the usual. Returns the name of what runs.
    std::string choice(std::string_view axis, std::string asked, std::string_view usual) {
        const auto switched = options_.effects.find(axis);
        if (asked == usual) return asked;
        const bool on = switched == options_.effects.end() || switched->second;
        plan_.decisions.push_back(
            {std::string(axis), on ? asked : "off",
             fmt::format("--{} {}; as a rule it is {}", option_of(axis), asked, usual), false, on});
        return on ? asked : std::string(usual);
    }
    void stage(std::string_view axis, std::string_view name) {
        const shade::Stage* found = shade::find_stage(axis, name);
        CHECK(found != nullptr);
        plan_.stages.push_back(found);
        plan_.techniques.push_back(&found->card);
        plan_.attributes = plan_.attributes | found->needs;
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

// How much of the scene is of one kind: "3 of 14 materials (120 of 900 triangles)".
std::string part(std::size_t materials, std::size_t triangles, const SceneFacts& facts) {
    return fmt::format("{} of {} materials ({} of {} triangles)", materials, facts.alpha.materials,
                       triangles, facts.triangles);
}

// Which materials are cut out or blended, and how alpha is found.
Result<void> plan_transparency(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                               const std::string& filter) {
    const FrameOptions& o = plan.options;
    const AlphaFacts& a = facts.alpha;
    TRY(const std::string cut_name, choose("transparency", o.transparency, "cut_out"));
    TRY(const std::string blend_name, choose("transparency", o.transparency, "exact"));
    if (!(o.alpha_cut >= 0 && o.alpha_cut <= 1))
        return fail(Exit::usage, "--alpha-cut {}: choose 0 to 1", o.alpha_cut);
    const bool cuts = a.cut_out_triangles + a.unseen_triangles > 0;
    const bool blends = a.blended_triangles > 0;
    const bool cut = planner.effect(
        "cut_out", cut_name, cuts,
        cuts ? fmt::format("{} have alpha 0 in places, and else 1",
                           part(a.cut_out_materials + a.unseen_materials,
                                a.cut_out_triangles + a.unseen_triangles, facts))
             : "no triangle's alpha is 0 anywhere without being between 0 and 1 elsewhere");
    const bool blend = planner.effect(
        "blending", blend_name, blends,
        blends ? fmt::format("{} have alpha between 0 and 1, d from {}",
                             part(a.blended_materials, a.blended_triangles, facts), a.least_d)
               : "no triangle's alpha is between 0 and 1");
    if (facts.triangles == 0 || !(cut || blend)) return {};
    TransparencyPlan& t = plan.transparency;
    const auto layer_by = [&](const std::string& name) {
        const shade::Transparency* found = shade::find_transparency(name);
        CHECK(found != nullptr);
        (found->cuts ? t.cut_out : t.blended) = found;
        return found->cuts ? raster::Layer::cut_out : raster::Layer::blended;
    };
    const raster::Layer cut_layer = cut ? layer_by(cut_name) : raster::Layer::opaque;
    const raster::Layer blend_layer = blend ? layer_by(blend_name) : raster::Layer::opaque;
    // Forced on where nothing calls for it: opaque triangles take that way, and look the same.
    t.opaque_blended = blend && !blends && blend_layer == raster::Layer::blended;
    const raster::Layer opaque_layer =
        blend && !blends ? blend_layer : (cut && !cuts ? cut_layer : raster::Layer::opaque);
    const raster::Layer layer_of_class[] = {opaque_layer, cut_layer, blend_layer,
                                            cut ? raster::Layer::nothing : raster::Layer::opaque};
    for (const AlphaClass c : a.of_material)
        t.layers.push_back(layer_of_class[static_cast<std::size_t>(c)]);
    t.alpha = a.maps;
    for (const shade::Transparency* technique : {t.cut_out, t.blended})
        if (technique != nullptr) plan.techniques.push_back(&technique->card);
    const bool mapped = std::any_of(a.maps.begin(), a.maps.end(), [](const auto& maps) {
        return maps.diffuse_map || maps.opacity_map;
    });
    if (!mapped) return {};
    for (const auto& [axis, name] : {std::pair("interpolate", "perspective"), {"map", "opacity"}}) {
        t.stages.push_back(shade::find_stage(axis, name));
        CHECK(t.stages.back() != nullptr);
        t.attributes = t.attributes | t.stages.back()->needs;
    }
    plan.techniques.push_back(&t.stages.back()->card);
    t.filter = shade::find_filter(filter);
    CHECK(t.filter != nullptr);
    if (plan.filter == nullptr) plan.techniques.push_back(&t.filter->card);
    t.attributes = t.attributes | t.filter->needs;
    return {};
}

} // namespace

namespace {

// Which surfaces are seen, and how they are mixed: choices of the user's.
Result<void> plan_output(Planner& planner, FramePlan& plan) {
    const FrameOptions& o = plan.options;
    TRY(const std::string depth, choose("depth", o.depth, "reversed"));
    TRY(const std::string test, choose("depth_test", o.depth_test, "greater"));
    TRY(const std::string blend, choose("blend", o.blend, "over"));
    const auto* format = raster::find_depth_format(planner.choice("depth", depth, "reversed"));
    const auto* compare = raster::find_depth_test(planner.choice("depth_test", test, "greater"));
    const auto* mix = shade::find_blend(planner.choice("blend", blend, "over"));
    CHECK(format != nullptr && compare != nullptr && mix != nullptr);
    plan.visible = {compare->test, format->standard, format->steps};
    plan.transparency.blend = mix;
    constexpr std::string_view kSides[] = {"none", "back", "front"};
    const std::string_view cull = kSides[static_cast<std::size_t>(o.cull)];
    if (planner.choice("cull", std::string(cull), "none") == "none") plan.options.cull = Cull::none;
    if (format->card.name != "reversed") plan.techniques.push_back(&format->card);
    if (compare->card.name != "greater") plan.techniques.push_back(&compare->card);
    if (mix->card.name != "over") plan.techniques.push_back(&mix->card);
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
    TRY_VOID(plan_transparency(planner, plan, facts, filter));
    TRY_VOID(plan_output(planner, plan));
    if (facts.triangles == 0)
        plan.attributes.normal = plan.attributes.uv = false; // lines and points are unlit
    TRY_VOID(check_effects(options, plan));
    return plan;
}

} // namespace scanout::frame
