// Phong shading: lights every pixel, with the normal interpolated between the vertices and
// normalised, which every rung of interpolation does for a whole block at once. Phong 1975, [Primer
// 7.3].
#include "shade/stage.h"

namespace scanout::shade::shading {

extern const ShadingStage per_pixel;
constinit const ShadingStage per_pixel{
    {{.axis = "shading",
      .name = "per_pixel",
      .blurb = "light at every pixel, with unit normals",
      .source = "Phong 1975",
      .kind = Kind::rung},
     Pass::shading,
     {.normal = true},
     [](ShadingBlock& block, const FrameState& frame) { block.model->run(block, frame); }},
    {}};

} // namespace scanout::shade::shading
