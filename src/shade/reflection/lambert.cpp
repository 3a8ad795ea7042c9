// Lambert's cosine law: colour = 0.15 Kd + sum over lights of light * Kd * max(n.l, 0). Lambert
// 1760, [A 11.1], [B ch.6], [C 7]. No 1/pi, as MTL means it (DESIGN 1).
#include "shade/reflection/diffuse.h"
#include "shade/stage.h"

namespace scanout::shade::reflection {

extern const Stage lambert;
constinit const Stage lambert{{.axis = "reflection",
                               .name = "lambert",
                               .blurb = "matt: light by the cosine of its angle",
                               .source = "Lambert 1760, [A 11.1]",
                               .kind = Kind::model,
                               .needs = {.normal = true}},
                              diffuse};

} // namespace scanout::shade::reflection
