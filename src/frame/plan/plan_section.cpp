// Says how a plane cut the mesh. That is done before the frame: shadows, transparency and the
// reference have the same mesh.
#include "frame/plan/planner.h"

#include <fmt/format.h>

namespace scanout::frame {

void plan_section(Planner& planner, const SceneFacts& facts) {
    const std::optional<scene::SceneSection>& s = facts.section;
    std::string because = "the model is whole";
    if (s)
        because = !s->cuts ? "nothing of the model lies in front of the plane"
                  : s->empty
                      ? "all of the model lies in front of the plane"
                      : fmt::format("of {} triangles {} are cut away and {} cut in two; {} cap the "
                                    "cut",
                                    s->triangles, s->removed, s->cut, s->caps);
    if (s && s->open_edges > 0)
        because += fmt::format(", {} of whose {} edges close no outline", s->open_edges, s->edges);
    planner.choice("section", s ? s->plane : "none", s ? s->plane : "auto", std::move(because),
                   s && s->cuts);
}

} // namespace scanout::frame
