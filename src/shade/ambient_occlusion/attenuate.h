// Takes from the light from everywhere what ambient occlusion keeps off.
#pragma once

#include "shade/stage.h"

namespace scanout::shade::ambient_occlusion {

// The stage of the axis' rungs. An item takes the share of its pixel's centre, or, where that shows
// a surface far behind or before its own, of the neighbour whose distance is nearest to its own.
void attenuate(ShadingBlock& block, const FrameState& frame);

} // namespace scanout::shade::ambient_occlusion
