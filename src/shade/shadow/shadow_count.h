// The stage of both techniques that count shadow polygons over a tile's samples.
#pragma once

#include "shade/stage.h"

namespace scanout::shade {

// Takes from each light that casts shadows the share of the item's samples that lie in one. A
// triangle that does not receive (TileShadow) keeps its light; one that does and faces away from
// the light gets none.
void shadow_by_counts(ShadingBlock& block, const FrameState& frame);

} // namespace scanout::shade
