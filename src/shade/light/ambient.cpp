// Ambient light: the same from everywhere, on every surface: it stands for all light that came
// there by other surfaces. [A 11.1], [C 7].
#include "shade/stage.h"

namespace scanout::shade::light {

extern const Stage ambient;
constinit const Stage ambient{
    {.axis = "light",
     .name = "ambient",
     .blurb = "the same from everywhere",
     .source = "[A 11.1], [C 7]",
     .kind = Kind::effect},
    {},
    [](Block& block, const FrameState& frame) { block.ambient = frame.ambient; }};

} // namespace scanout::shade::light
