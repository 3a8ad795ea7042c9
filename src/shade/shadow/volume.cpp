// Shadow volumes: a sample is dark where it lies inside the space that a triangle hides from the
// light. The borders of that space are counted behind the sample, so that neither the near plane
// nor an eye inside of it matters. Crow 1977, Everitt and Kilgard 2002, [Primer 10]. Its parts:
// this stage, the volumes (frame/pass/shadow_polygons.h) and the count after visibility
// (raster/count/stencil_count.h).
#include "shade/shadow/shadow_count.h"
#include "shade/stage.h"

namespace scanout::shade::shadow {

extern const ShadowStage volume;
constinit const ShadowStage volume{
    {{.axis = "shadow",
      .name = "volume",
      .blurb = "the space behind each caster, counted at every sample: "
               "exact and hard",
      .source = "Crow 1977, Everitt and Kilgard 2002",
      .kind = Kind::rung,
      .may_err_more = {"map map_pcf map_soft",
                       "its shadows are those of a point of light: where a light has a size, they "
                       "lack the penumbra; and where smooth normals receive a light that the face "
                       "turns away from, they are counted on the face, not on the round surface "
                       "above it"}},
     Pass::shadow,
     {.primitive = true, .facing = true}, // positions come with lights that have one
     shadow_by_counts},
    {.by = ShadowBy::volumes}};

} // namespace scanout::shade::shadow
