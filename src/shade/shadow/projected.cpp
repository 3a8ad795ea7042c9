// Shadows projected onto a plane: every triangle is projected along the light onto the floor, and
// surfaces in the floor under one of them are dark. Exact there; nothing else receives a shadow.
// Blinn 1988, [Primer 10]. Its parts: this stage, the projection (frame/pass/shadow_polygons.h),
// and the count of polygons over each sample (raster/count/stencil_count.h).
#include "shade/shadow/shadow_count.h"
#include "shade/stage.h"

namespace scanout::shade::shadow {

extern const ShadowStage projected;
constinit const ShadowStage projected{
    {{.axis = "shadow",
      .name = "projected",
      .blurb = "triangles thrown onto the floor: right on it, none "
               "elsewhere",
      .source = "Blinn 1988",
      .kind = Kind::rung},
     Pass::shadow,
     {.primitive = true, .facing = true}, // positions come with lights that have one
     shadow_by_counts},
    {.by = ShadowBy::projection}};

} // namespace scanout::shade::shadow
