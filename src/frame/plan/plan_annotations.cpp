// Plans what is drawn over the shading, which comes only on request.
#include "frame/edges.h"
#include "frame/plan/planner.h"
#include "rows.h"

namespace scanout::frame {

Result<void> plan_annotations(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    const FrameOptions& o = plan.options;
    TRY(const Edges* const found, choose(edges::kRows, o.edges, edges::none));
    const bool some = facts.triangles > 0;
    std::string because = "edges come only on request";
    if (found->of == Edges::Of::faces)
        because = fmt::format("the edges of the faces of {} triangles", facts.triangles);
    else if (found->of == Edges::Of::features)
        because = fmt::format("edges of {} triangles with one face, or more than two, or a bend of "
                              "more than {} degrees",
                              facts.triangles, o.edge_angle);
    if (!some) because = "the model has no faces";
    planner.choice("edges", found->card.name, o.edges, std::move(because), some);
    if (found->of == Edges::Of::nothing || !some) return {};
    plan.annotations.edges = found;
    plan.annotations.edge_angle = found->of == Edges::Of::features ? o.edge_angle : 0;
    plan.techniques.push_back(&found->card);
    return {};
}

} // namespace scanout::frame
