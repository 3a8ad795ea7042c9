// Plans what is drawn over the shading, which comes only on request.
#include "frame/edges.h"
#include "frame/plan/planner.h"
#include "geom/ruler.h"
#include "rows.h"

#include <fmt/format.h>

namespace scanout::frame {

std::string size_text(Annotation annotation, const DVec3& box_size) {
    if (annotation == Annotation::box)
        return fmt::format("{:.6g} x {:.6g} x {:.6g}", box_size.x, box_size.y, box_size.z);
    if (annotation == Annotation::grid)
        return fmt::format("squares of {:g}", geom::grid_spacing(box_size));
    return {};
}

// What is asked for, with lengths in the file's unit.
static std::string describe(const Annotations& annotations, const DVec3& box_size) {
    std::string text;
    for (std::size_t i = 0; i < kAnnotationNames.size(); ++i) {
        const auto annotation = static_cast<Annotation>(i);
        if (!annotations.has(annotation)) continue;
        const std::string size = size_text(annotation, box_size);
        text += fmt::format("{}{}{}{}", text.empty() ? "" : ", ", kAnnotationNames[i],
                            size.empty() ? "" : " of ", size);
    }
    return text + " (in the file's unit)";
}

// Lines of no technique: rows of the plan alone say them.
static void plan_marks(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    const Annotations asked = plan.options.annotations;
    const bool some = facts.triangles + facts.lines + facts.points > 0;
    planner.choice("annotate", asked.empty() ? "none" : to_string(asked),
                   asked.empty() ? "auto" : to_string(asked),
                   asked.empty() ? "annotations come only on request"
                   : some        ? describe(asked, facts.box_size)
                                 : "there is no model",
                   !asked.empty() && some);
    if (some) plan.annotations.annotations = asked;
}

Result<void> plan_annotations(Planner& planner, FramePlan& plan, const SceneFacts& facts) {
    plan_marks(planner, plan, facts);
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
