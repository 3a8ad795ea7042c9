// Plans ambient occlusion: on where it is asked for, some light comes from everywhere, and some
// surface may keep it off another one.
#include "frame/plan/planner.h"
#include "rows.h"
#include "shade/ambient_occlusion.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::frame {
namespace {

bool has_ambient_light(const FramePlan& plan) {
    return std::any_of(plan.lights.begin(), plan.lights.end(),
                       [](const scene::Light& light) { return is_ambient(light.kind); });
}

// Of two boxes, the square of the least distance.
double square_between(const geom::Box& a, const geom::Box& b) {
    double square = 0;
    for (int c = 0; c < 3; ++c) {
        const double gap = std::max({a.low[c] - b.high[c], b.low[c] - a.high[c], 0.0});
        square += gap * gap;
    }
    return square;
}

// Flat and convex parts that are seen from outside keep no light off themselves; another one does,
// within the radius.
bool stands_clear(const FramePlan& plan, const SceneFacts& facts, const ViewFacts& view) {
    if (facts.topology.flat) return true;
    const std::vector<geom::Box>& parts = facts.topology.convex_components;
    if (parts.empty() || view.inside || plan.options.cull == Cull::front) return false;
    const double reach = shade::kOcclusionRadius * facts.radius;
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (square_between(parts[i], parts[k]) < reach * reach) return false;
    return true;
}

} // namespace

Result<void> plan_ambient_occlusion(Planner& planner, FramePlan& plan, const SceneFacts& facts,
                                    const ViewFacts& view, const shade::Stage& shading) {
    const std::string& asked = plan.options.ambient_occlusion;
    TRY(const shade::AmbientOcclusion* const found,
        choose(shade::ambient_occlusion::kRows, asked, shade::ambient_occlusion::none));
    if (found->directions == 0) {
        planner.choice("ambient_occlusion", found->card.name, asked,
                       "ambient occlusion comes only on request");
        return {};
    }
    const raster::DepthTestRow& test =
        row_or(raster::depth_test::kRows, plan.options.depth_test, raster::depth_test::less);
    const char* const why_not =
        why_unlit(plan, facts) != nullptr ? why_unlit(plan, facts)
        : !has_ambient_light(plan)        ? "no light comes from everywhere"
        : shading.needs.vertices ? "it needs light at pixels, and --shading has it at vertices"
        : test.test != raster::DepthTest::less
            ? "it needs the nearest surfaces, and --depth-test may show others"
            : nullptr;
    const bool clear = stands_clear(plan, facts, view);
    const bool on = planner.effect(
        "ambient_occlusion", found->card.name, why_not == nullptr && !clear,
        why_not != nullptr ? std::string(why_not)
        : clear ? std::string("the model's parts are flat or convex, and far from each other: "
                              "they keep no light off")
                : fmt::format("within {} of the model's radius, in {} directions of {} steps",
                              shade::kOcclusionRadius, found->directions, found->steps),
        found->card.axis);
    if (!on || why_not != nullptr) return {};
    planner.stage(*found);
    plan.occlusion = found;
    return {};
}

} // namespace scanout::frame
