// Lights, sides, reflection, and how often they are evaluated.
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
            shining.empty() && elsewhere ? "its light falls beside the model"
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
            ? kNoHighlight
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

// Why back faces may be visible, or why not, of a mesh whose faces have normals on their fronts.
std::pair<bool, std::string> backs(const SceneFacts& facts, const FrameOptions& options,
                                   const ViewFacts& view, bool by_material) {
    const geom::MeshTopology& topology = facts.topology;
    const Cull cull = options.cull;
    if (cull == Cull::front) return {true, "backs alone are drawn (--cull front)"};
    if (cull == Cull::back)
        return {false, by_material ? "backs are left out: every material is one-sided"
                                   : "backs are left out (--cull back)"};
    const raster::DepthTestRow& test =
        row_or(raster::depth_test::kRows, options.depth_test, raster::depth_test::less);
    if (!test.shows)
        return {false, fmt::format("--depth-test {} shows nothing", options.depth_test)};
    if (test.test != raster::DepthTest::less)
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
    const std::size_t reversed = facts.topology.reversed_triangles;
    auto [needed, because] =
        why_unlit(plan, facts) != nullptr ? std::pair(false, std::string(why_unlit(plan, facts)))
        : !normals_matter(plan)           ? std::pair(false, std::string(kNoDirection))
        : reversed > 0 ? std::pair(true, fmt::format("the normals of {} of {} triangles point to "
                                                     "their back",
                                                     reversed, facts.triangles))
                       : backs(facts, plan.options, view, planner.asked().cull == Cull::material);
    const bool on = planner.effect("two_sided", "on", needed, std::move(because));
    const shade::LitSides& lit = needed && !on ? shade::sides::one_sided : shade::sides::two_sided;
    plan.sides = reversed > 0 ? lit.reversed : lit.others;
    if (on) plan.techniques.push_back(&lit.card);
}

} // namespace

const char* why_unlit(const FramePlan& plan, const SceneFacts& facts) {
    if (facts.triangles == 0) return "nothing is lit: there are no triangles";
    const auto emission = plan.options.effects.find("emission"); // off, it lights the unlit, too
    const bool as_lit = emission != plan.options.effects.end() && !emission->second;
    if (facts.all_unlit && !as_lit) return "nothing is lit: every material is unlit";
    if (!some_light_shines(plan.options)) return kNoLight;
    if (facts.specular_triangles > 0) return nullptr;
    if (facts.brightest <= 0) return "nothing reflects light: Kd and Ks are black everywhere";
    const bool pictures = plan.decision("texture")->on() && plan.source == nullptr;
    if (facts.black_by_maps && pictures)
        return "nothing reflects light: Kd and Ks, or their maps, are black everywhere";
    return nullptr;
}

bool is_depth_coarse(const FrameOptions& options) {
    return row_or(raster::depth::kRows, options.depth, raster::depth::reversed).standard;
}

bool some_light_shines(const FrameOptions& options) {
    return !std::all_of(options.lights.begin(), options.lights.end(), scene::is_black);
}

bool by_ks_alone(const FramePlan& plan) {
    return !row_or(shade::reflection::kRows, plan.options.reflection, shade::reflection::ggx)
                .physical;
}

bool has_directed_light(const FramePlan& plan) {
    return std::any_of(plan.lights.begin(), plan.lights.end(),
                       [](const scene::Light& light) { return !is_ambient(light.kind); });
}

bool normals_matter(const FramePlan& plan) {
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
    TRY_VOID(plan_ambient_occlusion(planner, plan, facts, view, *shading));
    const bool directed = normals_matter(plan);
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

} // namespace scanout::frame
