// Plans the shadow pass: whether there is one, its technique, and the triangles that cast shadows.
#include "frame/facts/map_facts.h"
#include "frame/plan/planner.h"
#include "rows.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace scanout::frame {
namespace {

// Does light show on some face that turns away from it, and lies in its own shadow? Smooth normals
// do not count: they let light go over a body's edge as if it were round (shadow/terminator-inl.h).
bool is_lit_from_behind(const FramePlan& plan, const SceneFacts& facts) {
    const auto leans = [&](shade::Map map) {
        const auto asked = plan.options.effects.find(map_effect(map));
        return facts.mapped_triangles[map] > 0 &&
               (asked == plan.options.effects.end() || asked->second);
    };
    return plan.sides == shade::Sides::file || leans(shade::kNormalMap) || leans(shade::kBumpMap);
}

// Seen from inside, a convex body's near side lies between the lights and its far side.
bool shows_far_side(const FrameOptions& options, const ViewFacts& view) {
    const raster::DepthTestRow& test =
        row_or(raster::depth_test::kRows, options.depth_test, raster::depth_test::less);
    return options.cull == Cull::front || view.inside || test.test != raster::DepthTest::less ||
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
    std::vector<raster::Facing> in_maps, inner; // ShadowPlan

    Casting(const FramePlan& plan, const std::vector<LightFacts>& of_lights) {
        in_maps.assign(plan.lights.size(), raster::Facing::any);
        inner = in_maps;
        for (std::size_t i = 0; i < in_maps.size(); ++i) {
            const scene::Light& light = plan.lights[i];
            if (!light.casts || is_ambient(light.kind)) continue;
            names += (names.empty() ? "" : ", ") + light.name;
            ++lights;
            sized += light.size > 0 ? 1 : 0;
            directional = directional || light.kind == scene::LightKind::directional;
            inner[i] = of_lights[i].inner;
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

} // namespace

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
    const bool possible = casting.lights > 0 && throws && floor && at_pixels;
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
    plan.shadow.inner = casting.inner;
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
