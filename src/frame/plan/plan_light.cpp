// Lights, sides, reflection, shadows, and how often they are evaluated.
#include "base/check.h"
#include "frame/facts/map_facts.h"
#include "frame/plan/planner.h"
#include "rows.h"
#include "shade/sides.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace scanout::frame {
namespace {

// Why no light shows on anything; null where some does.
const char* why_unlit(const FramePlan& plan, const SceneFacts& facts) {
    if (facts.triangles == 0) return "nothing is lit: there are no triangles";
    if (!some_light_shines(plan.options)) return kNoLight;
    if (facts.specular_triangles > 0) return nullptr;
    if (facts.brightest <= 0) return "nothing reflects light: Kd and Ks are black everywhere";
    const bool pictures = plan.decision("texture")->on() && plan.source == nullptr;
    if (facts.black_by_maps && pictures)
        return "nothing reflects light: Kd and Ks, or their maps, are black everywhere";
    return nullptr;
}

// One row for each kind of light: on where one shines that is not black, and something is lit.
// Returns the facts of the plan's lights.
std::vector<LightFacts> plan_lights(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                                    const ViewFacts& view, const shade::Stage& shading) {
    const FrameOptions& options = plan.options;
    std::vector<LightFacts> of_lights;
    for (const shade::LightStage* const stage : shade::light::kRows) {
        const scene::LightKind kind = stage->kind;
        std::string names;
        std::vector<scene::Light> shining;
        std::vector<LightFacts> of_shining;
        bool elsewhere = false; // one shines, but not on the model
        for (std::size_t i = 0; i < options.lights.size(); ++i) {
            const scene::Light& light = options.lights[i];
            if (light.kind != kind || is_black(light)) continue;
            if (!view.lights[i].reaches) {
                elsewhere = true;
                continue;
            }
            names += (names.empty() ? "" : ", ") + light.name;
            shining.push_back(light);
            of_shining.push_back(view.lights[i]);
        }
        const char* const unlit = why_unlit(plan, facts);
        const bool lit = unlit == nullptr;
        const std::string because =
            shining.empty() && elsewhere ? "what is lit lies beside the model"
            : shining.empty()            ? fmt::format("there is no {} light", name_of(kind))
            : !lit                       ? unlit
                   : fmt::format("{} light{}: {}", shining.size(), shining.size() == 1 ? "" : "s",
                                 names);
        const bool on = planner.effect(fmt::format("{}_light", name_of(kind)), "on",
                                       lit && !shining.empty(), because);
        if (!on || !lit || shining.empty()) continue;
        plan.lights.insert(plan.lights.end(), shining.begin(), shining.end());
        of_lights.insert(of_lights.end(), of_shining.begin(), of_shining.end());
        // A directional light is the same in all lanes: there is nothing to write.
        if (kind == scene::LightKind::directional) continue;
        if (shading.needs.vertices) {
            plan.vertex_lights.push_back(stage);
            planner.called(*stage, {});
        } else {
            planner.stage(*stage);
        }
    }
    return of_lights;
}

bool is_same(const Technique& a, const Technique& b) {
    return a.axis == b.axis && a.name == b.name;
}

// Which model reflects on each kind of surface.
Result<void> plan_reflection(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                             const shade::Stage& shading) {
    const std::string& asked = plan.options.reflection;
    TRY(const shade::ReflectionStage* const glossy,
        choose(shade::reflection::kRows, asked, shade::reflection::blinn_phong));
    TRY(const shade::ReflectionStage* const physical,
        choose(shade::reflection::kRows, asked, shade::reflection::ggx));
    const std::size_t shiny = facts.specular_triangles, rough = facts.physical_triangles;
    const std::size_t lobes = by_ks_alone(plan) ? facts.by_ks.specular_triangles : shiny;
    const bool highlight = planner.effect(
        "highlight",
        rough == 0 || glossy == physical ? std::string(glossy->card.name)
        : rough == shiny                 ? std::string(physical->card.name)
                         : fmt::format("{} and {}", glossy->card.name, physical->card.name),
        lobes > 0 && glossy->highlight && has_directed_light(plan),
        lobes > 0 && !has_directed_light(plan)
            ? kNoDirection
            : fmt::format(
                  "{} of {} triangles have a highlight (Ks and Ns above 0, with their maps{})",
                  lobes, facts.triangles,
                  rough > 0 ? fmt::format("; {} say Pr or Pm", rough) : std::string()),
        glossy->card.axis);
    // Each model that some surface has, once; lines and points go the way of the matt ones.
    const auto use = [&](scene::Surface surface, const shade::Stage& model, bool used) {
        plan.reflection[static_cast<std::size_t>(surface)] = &model;
        const auto& ran = plan.techniques;
        if (!used || std::any_of(ran.begin(), ran.end(),
                                 [&](const Technique* t) { return is_same(*t, model.card); }))
            return;
        planner.called(model, shading.needs.vertices ? shade::Attributes{} : model.needs);
    };
    plan.physical = rough > 0;
    if (const MaterialSet* calling = materials_calling(facts, plan, "highlight"))
        std::transform(calling->begin(), calling->end(), std::back_inserter(plan.matt),
                       [](bool calls) { return calls ? 0 : 1; });
    const shade::Stage& matt = glossy->matt != nullptr ? *glossy->matt
                               : glossy->highlight     ? shade::reflection::lambert
                                                       : *glossy;
    use(scene::Surface::matt, matt, shiny < facts.triangles || facts.triangles == 0);
    use(scene::Surface::glossy, highlight ? *glossy : matt, shiny > rough);
    use(scene::Surface::physical, highlight ? *physical : matt, rough > 0);
    return {};
}

// Depth in steps that may be as long as the model.
bool is_depth_coarse(const FrameOptions& options) {
    return row_or(raster::depth::kRows, options.depth, raster::depth::reversed).standard;
}

// Why back faces may be visible, or why not, of a mesh whose normals lean to no back.
std::pair<bool, std::string> backs(const SceneFacts& facts, const FrameOptions& options,
                                   const ViewFacts& view) {
    const geom::MeshTopology& topology = facts.topology;
    const Cull cull = options.cull;
    if (cull == Cull::front) return {true, "backs alone are drawn (--cull front)"};
    if (cull == Cull::back) return {false, "backs are left out (--cull back)"};
    const raster::DepthTestRow& test =
        row_or(raster::depth_test::kRows, options.depth_test, raster::depth_test::greater);
    if (!test.shows)
        return {false, fmt::format("--depth-test {} shows nothing", options.depth_test)};
    if (test.test != raster::DepthTest::greater)
        return {true, fmt::format("--depth-test {} may show backs", options.depth_test)};
    if (is_depth_coarse(options))
        return {true, fmt::format("--depth {} may take backs for as near as what hides them",
                                  options.depth)};
    if (topology.inside_out > 0)
        return {true,
                fmt::format("{} of {} triangles are of closed parts that are wound inside out",
                            topology.inside_out, facts.triangles)};
    if (topology.back_to_back)
        return {true, "faces lie back to back: of two at one depth either may be seen"};
    switch (view.backs) {
    case BackFaces::of_open_components:
        return {true, facts.alpha.see_through_triangles() > 0
                          ? fmt::format("backs show through {} of {} triangles that are not opaque",
                                        facts.alpha.see_through_triangles(), facts.triangles)
                          : "the mesh has open edges: backs can be seen"};
    case BackFaces::from_inside:
        return {true, "the eye may be inside of a closed part, and see its backs"};
    case BackFaces::none:
        break;
    }
    return {false, topology.open_triangles > 0
                       ? fmt::format("{} of {} triangles have open edges or let light through: all "
                                     "show their fronts",
                                     topology.open_triangles, facts.triangles)
                       : "the mesh is closed and wound outwards: no back can be seen"};
}

// One-sided or two-sided lighting. Where no back face can be visible, the side that the normals
// point to is the side that the eye sees.
void plan_sides(Planner& planner, FramePlan& plan, const SceneFacts& facts, const ViewFacts& view) {
    const std::size_t leaning = facts.topology.leaning_normals;
    auto [needed, because] =
        why_unlit(plan, facts) != nullptr ? std::pair(false, std::string(why_unlit(plan, facts)))
        : !has_directed_light(plan)       ? std::pair(false, std::string(kNoDirection))
        : leaning > 0
            ? std::pair(true, fmt::format("{} of {} triangles have a normal that leans to "
                                          "their back",
                                          leaning, facts.triangles))
            : backs(facts, plan.options, view);
    const bool on = planner.effect("two_sided", "on", needed, std::move(because));
    const shade::LitSides& lit = needed && !on ? shade::sides::one_sided : shade::sides::two_sided;
    plan.sides = leaning > 0 ? lit.leaning : lit.upright;
    if (on) plan.techniques.push_back(&lit.card);
}

// Does light show on some face that turns away from it? Such a face lies in its own shadow.
bool is_lit_from_behind(const FramePlan& plan, const SceneFacts& facts) {
    const auto leans = [&](shade::Map map) {
        const auto asked = plan.options.effects.find(map_effect(map));
        return facts.mapped_triangles[map] > 0 &&
               (asked == plan.options.effects.end() || asked->second);
    };
    return facts.topology.smooth_triangles > 0 || plan.sides == shade::Sides::file ||
           leans(shade::kNormalMap) || leans(shade::kBumpMap);
}

// From inside, a convex body's near side stands between the lights and its far side.
bool shows_far_side(const FrameOptions& options, const ViewFacts& view) {
    const raster::DepthTestRow& test =
        row_or(raster::depth_test::kRows, options.depth_test, raster::depth_test::greater);
    return options.cull == Cull::front || view.inside || test.test != raster::DepthTest::greater ||
           is_depth_coarse(options);
}

bool shadows_itself(const FramePlan& plan, const SceneFacts& facts, const ViewFacts& view,
                    const std::vector<LightFacts>& of_lights, shade::ShadowBy by) {
    const geom::MeshTopology& topology = facts.topology;
    if (is_lit_from_behind(plan, facts)) return true;
    // Volumes are counted at the depth that is stored: before or behind the plane.
    if (topology.flat) return by == shade::ShadowBy::volumes && is_depth_coarse(plan.options);
    if (topology.convex_components.empty() || shows_far_side(plan.options, view)) return true;
    return !std::all_of(of_lights.begin(), of_lights.end(),
                        [](const LightFacts& light) { return light.shadows_disjoint; });
}

// Some triangle is neither blended in this plan nor invisible.
bool something_throws(const FrameOptions& options, const SceneFacts& facts) {
    const auto asked = options.effects.find("blending");
    const bool cuts =
        row_or(shade::transparency::kRows, options.transparency, shade::transparency::exact).cuts;
    const bool blends =
        !cuts && !blends_nothing(options) && (asked == options.effects.end() || asked->second);
    return facts.alpha.unseen_triangles + (blends ? facts.alpha.blended_triangles : 0) <
           facts.triangles;
}

// The lights that cast.
struct Casting {
    std::string names;
    int lights = 0, sized = 0;
    int outside = 0; // of a closed mesh
    bool directional = false;
    std::vector<raster::Facing> in_maps; // ShadowPlan

    Casting(const FramePlan& plan, const std::vector<LightFacts>& of_lights) {
        in_maps.assign(plan.lights.size(), raster::Facing::any);
        for (std::size_t i = 0; i < in_maps.size(); ++i) {
            const scene::Light& light = plan.lights[i];
            if (!light.casts || light.kind == scene::LightKind::ambient) continue;
            names += (names.empty() ? "" : ", ") + light.name;
            ++lights;
            sized += light.size > 0 ? 1 : 0;
            directional = directional || light.kind == scene::LightKind::directional;
            if (!of_lights[i].only_front_faces) continue;
            ++outside;
            in_maps[i] = raster::Facing::front;
        }
    }
    // The faces that shadow maps are drawn of, where back faces can be left out.
    std::string why_fronts() const {
        if (outside == 0) return {};
        const std::string of =
            outside == lights ? "maps" : fmt::format("the maps of {} of {}", outside, lights);
        return fmt::format("; the mesh is closed and wound outwards: {} hold fronts alone", of);
    }
};

// Shadows: on where a light that shines casts them. A light with a size throws soft ones; those of
// a point are sharp, and the filtered map is the cheapest that shows no steps.
Result<void> plan_shadows(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                          const ViewFacts& view, const std::vector<LightFacts>& of_lights,
                          const shade::Stage& shading) {
    const Casting casting(plan, of_lights);
    TRY(const shade::ShadowStage* const stage,
        choose(shade::shadow::kRows, plan.options.shadow,
               casting.sized > 0 ? shade::shadow::map_soft : shade::shadow::map_pcf));
    const bool attached = stage->by == shade::ShadowBy::facing;
    const bool floor = stage->by != shade::ShadowBy::projection || facts.shadow_plane.triangles > 0;
    const bool falls = attached || shadows_itself(plan, facts, view, of_lights, stage->by);
    const bool at_pixels = attached || !shading.needs.vertices;
    const bool throws = attached || something_throws(plan.options, facts);
    std::string because =
        why_unlit(plan, facts) != nullptr ? why_unlit(plan, facts)
        : casting.lights == 0             ? "no light that reaches anything casts shadows"
        : !throws ? "every triangle is blended or clear, and those throw none"
        : !falls && facts.topology.convex_components.size() > 1
            ? fmt::format("its {} parts, flat or convex, stand clear of one another in the light: "
                          "they throw none",
                          facts.topology.convex_components.size())
        : !falls     ? "the model is flat or convex: it throws none on itself"
        : !at_pixels ? fmt::format("they need light at pixels, and --shading {} has it not",
                                   shading.card.name)
        : !floor && facts.shadow_plane.by_user
            ? "no triangle lies in the plane of --shadow-plane, to project shadows onto"
        : !floor ? "no triangle lies flat on a side of the model's box, to project shadows onto"
                 : fmt::format("{} light{}: {}", casting.lights,
                               casting.lights == 1 ? " casts" : "s cast", casting.names);
    const bool possible = casting.lights > 0 && throws && floor && at_pixels; // it can be forced on
    const bool called = possible && falls;
    if (called && casting.sized > 0) because += fmt::format("; {} with a size", casting.sized);
    if (called && facts.alpha.blended_triangles > 0)
        because += fmt::format("; {} blended triangles throw none", facts.alpha.blended_triangles);
    if (called && stage->by == shade::ShadowBy::maps) because += casting.why_fronts();
    if (!planner.effect("shadow", stage->card.name, called, std::move(because), stage->card.axis) ||
        !possible)
        return {};
    if (attached) {
        plan.techniques.push_back(&stage->card);
        return {};
    }
    // A directional light now differs from lane to lane, too.
    if (casting.directional) planner.stage(shade::light::directional);
    planner.stage(*stage);
    plan.shadow.stage = stage;
    plan.shadow.plane = facts.shadow_plane;
    plan.shadow.in_maps = casting.in_maps;
    return {};
}

} // namespace

bool some_light_shines(const FrameOptions& options) {
    return !std::all_of(options.lights.begin(), options.lights.end(), scene::is_black);
}

bool by_ks_alone(const FramePlan& plan) {
    return !row_or(shade::reflection::kRows, plan.options.reflection, shade::reflection::ggx)
                .physical;
}

bool has_directed_light(const FramePlan& plan) {
    return std::any_of(plan.lights.begin(), plan.lights.end(), [](const scene::Light& light) {
        return light.kind != scene::LightKind::ambient;
    });
}

Result<void> plan_light(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                        const ViewFacts& view) {
    const std::string& asked = plan.options.shading;
    TRY(const shade::ShadingStage* const shading,
        choose(shade::shading::kRows, asked, shade::shading::per_pixel));
    const std::vector<LightFacts> of_lights = plan_lights(planner, plan, facts, view, *shading);
    plan_sides(planner, plan, facts, view);
    TRY_VOID(plan_reflection(planner, plan, facts, *shading));
    TRY_VOID(plan_shadows(planner, plan, facts, view, of_lights, *shading));
    const bool directed = has_directed_light(plan);
    const bool lit = why_unlit(plan, facts) == nullptr;
    planner.choice("shading", lit ? shading->card.name : "off", asked,
                   !lit        ? why_unlit(plan, facts)
                   : !directed ? kNoDirection
                               : fmt::format("{} triangles are lit", facts.triangles),
                   lit);
    planner.stage(*shading);
    // Nothing reads them, unless highlights are forced on.
    const bool normals = directed || plan.decision("highlight")->on() || shading->needs.vertices;
    plan.attributes.normal = plan.attributes.normal && normals;
    plan.vertex_normals = normals && shading->unit_vertex_normals;
    return {};
}

void plan_casters(FramePlan& plan, const SceneFacts& facts) {
    if (plan.shadow.stage == nullptr) return;
    const std::vector<raster::AlphaMode>& modes = plan.transparency.alpha_modes;
    bool all = true;
    for (std::size_t i = 0; i < modes.size(); ++i) {
        const AlphaClass alpha = facts.alpha.of_material[i];
        raster::AlphaMode mode = modes[i];
        if (mode == raster::AlphaMode::blended)
            mode = alpha == AlphaClass::opaque    ? raster::AlphaMode::opaque
                   : alpha == AlphaClass::cut_out ? raster::AlphaMode::cut_out
                                                  : raster::AlphaMode::nothing;
        all = all && mode == raster::AlphaMode::opaque;
        plan.shadow.casters.push_back(mode);
    }
    if (all) plan.shadow.casters.clear();
}

} // namespace scanout::frame
