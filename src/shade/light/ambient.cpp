// Ambient light: the same from all directions, on every surface; it approximates the light that
// other surfaces reflect. [Compendium 11.1], [Primer 7].
#include "shade/stage.h"

namespace scanout::shade::light {

extern const LightStage ambient;
constinit const LightStage ambient{
    {{.axis = "light",
      .name = "ambient",
      .blurb = "the same from everywhere",
      .source = "Foley et al. 1990, ch. 16",
      .kind = Kind::effect},
     Pass::light,
     {},
     [](ShadingBlock& block, const FrameState& frame) { block.ambient = frame.ambient; }},
    {scene::LightKind::ambient}};

} // namespace scanout::shade::light
