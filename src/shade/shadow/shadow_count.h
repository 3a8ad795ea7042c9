// Shadows that were counted over a tile's samples: the stage of both techniques that do so.
#pragma once

#include "shade/stage.h"

namespace scanout::shade {

// Takes from each light that casts the share of the item's samples over which anything was counted.
// A triangle that does not receive (TileShadow) keeps its light; one that does and faces away from
// the light gets none.
void shadow_by_counts(ShadingBlock& block, const FrameState& frame);

} // namespace scanout::shade
