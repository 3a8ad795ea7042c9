// In test builds (SCANOUT_CHECK_LANES), no live lane may hold NaN or infinity after any stage; the
// first that does ends the program with the stage's name. Traps of the processor would fire on
// lanes that a mask discards. Elsewhere it is nothing.
#pragma once

#include "shade/resolve.h"
#include "shade/stage.h"

namespace scanout::shade {

#ifdef SCANOUT_CHECK_LANES
void check_rays(const Block& block, const FrameState& frame); // place_lanes
void check_lanes(const Block& block, const FrameState& frame, const Stage& stage);
void check_sums(const PixelSums& sums, std::size_t count); // of all blocks, to be resolved
#else
inline void check_rays(const Block&, const FrameState&) {}
inline void check_lanes(const Block&, const FrameState&, const Stage&) {}
inline void check_sums(const PixelSums&, std::size_t) {}
#endif

} // namespace scanout::shade
