// Plans the stencil buffer: whether the frame marks pixels, and which stages remain when the
// picture shows the marks alone.
#include "frame/plan/planner.h"
#include "rows.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::frame {

Result<void> plan_stencil(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    TRY(const Stencil* const found, choose(stencil::kRows, plan.options.stencil, stencil::none));
    const std::string all = fmt::format("{} triangles, {} lines and {} points", facts.triangles,
                                        facts.lines, facts.points);
    std::string because = "an outline or counts come only on request";
    if (found->marks == Stencil::Marks::visible)
        because = fmt::format("{} pixels around the visible part of {}", kOutlineWidth, all);
    else if (found->marks == Stencil::Marks::covering)
        because = fmt::format("counts the surfaces over each pixel of {}", all);
    planner.choice("stencil", found->card.name, plan.options.stencil, std::move(because));
    if (found->marks == Stencil::Marks::nothing) return {};
    plan.stencil = found;
    plan.techniques.push_back(&found->card);
    return {};
}

void plan_counts(FramePlan& plan) {
    FramePlan counts;
    counts.options = plan.options;
    counts.shown_width = plan.shown_width;
    counts.shown_height = plan.shown_height;
    counts.one_sided = std::move(plan.one_sided);
    counts.aa = &aa::none;
    counts.stencil = plan.stencil;
    for (const Technique* card : plan.techniques)
        if (card->axis == "cull" || card->axis == "stencil" || card->axis == "render_scale")
            counts.techniques.push_back(card);
    counts.convolution = plan.convolution;
    if (plan.convolution != nullptr) counts.techniques.push_back(&plan.convolution->card);
    counts.decisions = std::move(plan.decisions);
    for (Decision& d : counts.decisions) {
        if (d.effect == "stencil" || d.effect == "cull" || d.effect == "convolution" ||
            d.effect == "render_scale")
            continue;
        d.technique = "off";
        d.because = "the picture shows counts, at pixels' centres: no colour is found";
        d.needed = false;
        d.forced = d.forced && d.choice; // asked for all the same
    }
    plan = std::move(counts);
}

} // namespace scanout::frame
