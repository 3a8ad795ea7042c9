#include "frame/plan.h"

#include "base/check.h"
#include "frame/map_facts.h"
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
                                   std::move(because), needed, is_forced && on != needed, false});
        return on;
    }
    // Notes what was chosen on an axis that is no effect: its own option decides.
    void choice(std::string axis, std::string technique, std::string because, bool needed,
                bool forced) {
        plan_.decisions.push_back(
            {std::move(axis), std::move(technique), std::move(because), needed, forced, true});
    }
    void stage(std::string_view axis, std::string_view name) {
        const shade::Stage* found = shade::find_stage(axis, name);
        CHECK(found != nullptr);
        plan_.stages.push_back(found);
        plan_.techniques.push_back(&found->card);
        plan_.attributes = plan_.attributes | found->needs;
    }
    void filter(const shade::Filter& filter) {
        for (Decision& decision : plan_.decisions)
            if (decision.effect == "texture" && decision.on())
                decision.technique = filter.card.name;
        plan_.filter = &filter;
        const auto first_map = std::find_if(plan_.techniques.begin(), plan_.techniques.end(),
                                            [](const Technique* t) { return t->axis == "map"; });
        plan_.techniques.insert(first_map, &filter.card); // in the order of techniques.h
        plan_.attributes = plan_.attributes | filter.needs;
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
        const Decision* row = plan.decision(name);
        if (row != nullptr && !row->choice) continue;
        if (row != nullptr)
            return fail(Exit::usage, "--effect {0}={1}: {0} is no effect; say --{0} NAME", name,
                        on ? "on" : "off");
        std::string known;
        for (const Decision& d : plan.decisions)
            if (!d.choice) known += " " + d.effect;
        return fail(Exit::usage, "--effect {}={}: there is no such effect; choose one of{}", name,
                    on ? "on" : "off", known);
    }
    return {};
}

} // namespace

namespace {

// How the maps that the plan's stages read are filtered, and which textures have mipmaps.
Result<void> plan_filter(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                         const scene::View& view) {
    const FrameOptions& options = plan.options;
    TRY(const std::string name, choose("texture", options.texture, "trilinear"));
    const shade::Filter* filter = shade::find_filter(name);
    CHECK(filter != nullptr);
    const bool automatic = options.texture == "auto", any = plan.attributes.maps != 0;
    double most = 0; // texels a pixel
    for (const TexturedSurface& surface : facts.textured_surfaces) {
        if ((plan.attributes.maps & shade::bit_of(surface.map)) == 0) continue;
        const double texels =
            texels_per_pixel(surface, view, options.width, options.height, plan.mapped);
        most = std::max(most, texels);
        // A filter that the user names is drawn as it is; else what is not minified needs no
        // mipmaps.
        if (automatic && texels * kMostSlant <= 1) continue;
        if (std::find(plan.mips.begin(), plan.mips.end(), surface.texture) == plan.mips.end())
            plan.mips.push_back(surface.texture);
    }
    const bool mipmaps = planner.effect(
        "mipmaps", "on", filter->needs.footprint && !plan.mips.empty(),
        any ? fmt::format("textures show up to {:.3g} texels a pixel, {:.3g} where they slant",
                          most, most * kMostSlant)
            : "no texture is read");
    if (!mipmaps || !filter->needs.footprint) plan.mips.clear();
    if (!any) return {};
    if (filter->needs.footprint && plan.mips.empty()) filter = shade::find_filter("bilinear");
    planner.filter(*filter);
    return {};
}

// What lies beyond textures' edges: what each map says, unless the user does.
Result<void> plan_wrap(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    const std::string& asked = plan.options.wrap;
    TRY(const std::string name, choose("wrap", asked, "repeat"));
    std::size_t maps = 0, clamped = 0;
    for (const TexturedSurface& surface : facts.textured_surfaces) {
        if ((plan.attributes.maps & shade::bit_of(surface.map)) == 0) continue;
        ++maps;
        if (surface.clamp) ++clamped;
    }
    if (asked != "auto") plan.wrap = shade::find_wrapping(name)->wrap;
    planner.choice("wrap",
                   maps == 0         ? "off"
                   : asked != "auto" ? name
                   : clamped == 0    ? "repeat"
                   : clamped == maps ? "clamp"
                                     : "repeat and clamp",
                   maps == 0 ? "no texture is read"
                             : fmt::format("{} of {} maps say -clamp on", clamped, maps),
                   maps > 0, asked != "auto");
    return {};
}

// The maps that the plan reads before light falls: which stages, in order.
std::vector<std::string_view> plan_maps(Planner& planner, const FramePlan& plan,
                                        const SceneFacts& facts, bool highlight) {
    std::vector<std::string_view> stages;
    const FrameOptions& options = plan.options;
    const bool textured = facts.textured_triangles > 0, computed = plan.source != nullptr;
    if (planner.effect("texture", options.texture == "auto" ? "bilinear" : options.texture,
                       textured || computed,
                       computed   ? fmt::format("--source {} for all triangles", options.source)
                       : textured ? fmt::format("{} of {} triangles have a readable map_Kd",
                                                facts.textured_triangles, facts.triangles)
                                  : "no triangle has a readable map_Kd") &&
        (textured || computed))
        stages.push_back("diffuse");
    const struct {
        shade::Map map;
        std::string_view stage, what;
        bool shown;
    } rows[] = {
        {shade::kNormalMap, "normal", "a norm that is not flat", true},
        {shade::kBumpMap, "bump", "a map_bump of more than one height", true},
        {shade::kSpecularMap, "specular", "a highlight and a map_Ks that is not white", highlight},
        {shade::kShininessMap, "gloss", "a highlight and a map_Ns that is not white", highlight}};
    for (const auto& row : rows) {
        const std::size_t triangles = facts.mapped_triangles[row.map];
        const bool on =
            planner.effect(std::string(map_effect(row.map)), "on", triangles > 0 && row.shown,
                           row.shown ? fmt::format("{} of {} triangles have {}", triangles,
                                                   facts.triangles, row.what)
                                     : "no highlight is drawn");
        if (on && row.shown && (facts.readable_maps & shade::bit_of(row.map)) != 0)
            stages.push_back(row.stage);
    }
    return stages;
}

// Where u and v come from: the model, unless it has none or the user asks otherwise.
Result<void> plan_mapping(Planner& planner, FramePlan& plan, const SceneFacts& facts, bool read) {
    const std::string& asked = plan.options.mapping;
    TRY(std::string name, choose("mapping", asked, facts.uv ? "uv" : "box"));
    const bool impossible = name == "uv" && !facts.uv;
    if (impossible) name = "box";
    plan.mapped = read && name != "uv";
    if (plan.mapped) planner.stage("mapping", name);
    planner.choice("mapping", read ? name : "off",
                   !read       ? "nothing reads coordinates"
                   : !facts.uv ? "the model has no uv"
                               : "the model has uv",
                   read, asked != "auto" && !impossible);
    return {};
}

// What the material's colours, normals and lights are made of; returns whether surfaces give off
// light, which is added last.
Result<bool> plan_textures(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                           const scene::View& view, bool highlight) {
    const FrameOptions& options = plan.options;
    TRY(const std::string source, choose("source", options.source, "image"));
    const shade::Source* computed = shade::find_source(source);
    CHECK(computed != nullptr);
    if (computed->sample != nullptr && facts.triangles > 0) plan.source = computed;
    const std::vector<std::string_view> stages = plan_maps(planner, plan, facts, highlight);
    const bool emission = planner.effect("emission", "on", facts.emitting_triangles > 0,
                                         fmt::format("{} of {} triangles have Ke above 0",
                                                     facts.emitting_triangles, facts.triangles)) &&
                          facts.emitting_triangles > 0;
    const bool glowing_map =
        emission && (facts.readable_maps & shade::bit_of(shade::kEmissionMap)) != 0;
    const bool diffuse = std::find(stages.begin(), stages.end(), "diffuse") != stages.end();
    if (!diffuse) plan.source = nullptr;
    planner.choice("source", diffuse ? source : "off",
                   plan.source != nullptr ? "the user asks for it"
                   : diffuse              ? "the materials name pictures"
                                          : "no texture is read",
                   diffuse, plan.source != nullptr);
    TRY_VOID(plan_mapping(planner, plan, facts, !stages.empty() || glowing_map));
    for (const std::string_view stage : stages)
        planner.stage("map", stage);
    if (glowing_map)
        plan.attributes = plan.attributes |
                          shade::Attributes{.uv = true, .maps = shade::bit_of(shade::kEmissionMap)};
    if (plan.source != nullptr) {
        plan.attributes = plan.attributes | plan.source->needs;
        plan.attributes.maps &= static_cast<shade::MapBits>(~shade::bit_of(shade::kDiffuseMap));
        plan.techniques.push_back(&plan.source->card);
    }
    TRY_VOID(plan_filter(planner, plan, facts, view));
    TRY_VOID(plan_wrap(planner, plan, facts));
    return emission;
}

} // namespace

Result<FramePlan> plan(const FrameOptions& options, const SceneFacts& facts,
                       const scene::View& view) {
    TRY_VOID(check_numbers(options));
    FramePlan plan;
    plan.options = options;
    Planner planner(options, plan);
    planner.stage("interpolate", "perspective");

    const bool shiny = facts.specular_triangles > 0;
    TRY(const std::string model, choose("reflection", options.reflection, "blinn_phong"));
    const bool highlight =
        planner.effect("highlight", model, shiny && model != "lambert",
                       fmt::format("{} of {} triangles have a highlight (Ks not black, Ns above 0)",
                                   facts.specular_triangles, facts.triangles));
    TRY(const bool emission, plan_textures(planner, plan, facts, view, highlight));
    plan_lights(options, facts, planner, plan);
    planner.stage("reflection", highlight ? model : "lambert");
    if (emission) planner.stage("map", "emission");

    if (planner.effect("vertex_colours", "on", facts.vertex_colours,
                       facts.vertex_colours ? "the file gives them" : "the file gives none"))
        plan.attributes.colour = facts.vertex_colours;
    if (facts.triangles == 0)
        plan.attributes = {.colour = plan.attributes.colour}; // lines and points are unlit
    TRY_VOID(check_effects(options, plan));
    return plan;
}

} // namespace scanout::frame
