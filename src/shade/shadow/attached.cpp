// The attached shadow, on a surface that faces away from the light: n.l < 0. The reflection model
// has it anyway, so no stage runs, and nothing casts a shadow on anything else. [Primer 10].
#include "shade/stage.h"

namespace scanout::shade::shadow {

extern const ShadowStage attached;
constinit const ShadowStage attached{
    {{.axis = "shadow",
      .name = "attached",
      .blurb = "what faces away from the light is dark: no pass at all",
      .source = "Foley et al. 1990, ch. 16",
      .kind = Kind::rung},
     Pass::shadow,
     {},
     nullptr},
    {.by = ShadowBy::facing}};

} // namespace scanout::shade::shadow
