// Plans false colours: what colours say when it is not light, and which stages then remain.
#include "frame/plan/planner.h"
#include "rows.h"

#include <algorithm>
#include <array>

namespace scanout::frame {

Result<void> plan_colours(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    const std::string& asked = plan.options.colour_by;
    TRY(const shade::ColourBy* const found,
        choose(shade::colour_by::kRows, asked, shade::colour_by::light));
    const bool some = facts.triangles > 0;
    const bool light = found->of == shade::ColourByTraits::Of::light;
    planner.choice("colour_by", found->card.name, asked,
                   light  ? "false colours come only on request"
                   : some ? std::string(found->card.blurb)
                          : "the model has no faces",
                   light || some);
    if (!light && some) plan.colours = found;
    return {};
}

void plan_false_colours(FramePlan& plan) {
    constexpr std::array kKept = {"interpolate", "cull",      "section",      "depth",
                                  "depth_test",  "stencil",   "annotate",     "edges",
                                  "aa",          "colour_by", "render_scale", "blend_space",
                                  "encode",      "dither",    "convolution"};
    const auto is_kept = [&](std::string_view axis) {
        return std::find(kKept.begin(), kKept.end(), axis) != kKept.end();
    };
    const auto goes = [&](const Technique* card) { return !is_kept(card->axis); };
    auto& ran = plan.techniques;
    ran.erase(std::remove_if(ran.begin(), ran.end(), goes), ran.end());
    ran.push_back(&plan.colours->card);
    auto& stages = plan.stages;
    stages.erase(
        std::remove_if(stages.begin(), stages.end(),
                       [](const shade::Stage* s) { return s->pass != shade::Pass::interpolation; }),
        stages.end());
    plan.attributes = plan.colours->needs;
    for (const shade::Stage* stage : stages)
        plan.attributes = plan.attributes | stage->needs;
    stages.push_back(plan.colours);
    plan.lights.clear();
    plan.vertex_lights.clear();
    plan.vertex_normals = false;
    plan.shadow = {};
    plan.occlusion = nullptr;
    plan.transparency = {};
    plan.exposure = plan.white = 1;
    plan.wrap.reset();
    plan.source = nullptr;
    plan.mapped = plan.lacks_uv = plan.physical = false;
    plan.matt.clear();
    for (Decision& d : plan.decisions) {
        if (is_kept(d.effect)) continue;
        d.technique = "off";
        d.because = "the picture shows false colours: nothing is lit, nothing is transparent";
        d.needed = false;
        d.forced = d.forced && d.choice; // asked for all the same
    }
}

} // namespace scanout::frame
