// The shadow that a surface throws on itself by facing away: n.l < 0. The reflection has it without
// any pass; here is nothing to run, and nothing throws a shadow on anything else. [Primer 10].
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
