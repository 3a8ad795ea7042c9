// Lights every pixel, with interpolated normals that are not normalised: between two vertices they
// are shorter than 1, so a highlight in the middle of a triangle is as dim as Gouraud's. Phong
// 1975, [Primer 7.3] (HARD-CASES L5).
#include "shade/stage.h"

namespace scanout::shade::shading {

extern const ShadingStage per_pixel_raw;
constinit const ShadingStage per_pixel_raw{
    {{.axis = "shading",
      .name = "per_pixel_raw",
      .blurb = "light at every pixel, with normals that are too short between vertices",
      .source = "Phong 1975, with normals as they come",
      .kind = Kind::rung},
     Pass::shading,
     {.normal = true},
     [](ShadingBlock& block, const FrameState& frame) { block.model->run(block, frame); }},
    {.unit_vertex_normals = true}};

} // namespace scanout::shade::shading
