// In test builds (SCANOUT_CHECK_LANES), no live lane may hold NaN or infinity after any stage; the
// first that does ends the program with the stage's name. Traps of the processor would fire on
// lanes that a mask discards. Elsewhere it is nothing.
#pragma once

#include "shade/stage.h"

namespace scanout::shade {

#ifdef SCANOUT_CHECK_LANES
void check_lanes(const Block& block, const FrameState& frame, const Stage& stage);
#else
inline void check_lanes(const Block&, const FrameState&, const Stage&) {}
#endif

} // namespace scanout::shade
