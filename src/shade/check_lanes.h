// In test builds (SCANOUT_CHECK_LANES), no live lane may hold NaN or infinity after any stage, nor
// may the values that lanes share; the first bad value ends the program with the stage's name.
// Values that a stage clamps to a number are checked before the clamp. Traps of the processor would
// also fire on lanes that a mask discards. In other builds these functions do nothing.
#pragma once

#include "build_options.h"
#include "shade/resolve/resolve.h"
#include "shade/stage.h"

#include <span>
#include <string_view>

namespace scanout::shade {

#ifdef SCANOUT_CHECK_LANES
inline constexpr bool kCheckLanes = true;
void check_lights(const FrameState& frame); // all, whether or not they vary
void check_primitive(const Primitive& primitive, const Attributes& wanted); // set up
void check_triangles(const ShadingSetup& triangles, const Attributes& wanted, int first, int count);
// The live lanes of one register; `first` is the block's lane in its first one.
void check_before_clamp(const float* lanes, int count, int first);
void check_rays(const ShadingBlock& block, const FrameState& frame); // set_rays
void check_lanes(const ShadingBlock& block, const FrameState& frame, const Stage& stage);
void check_sums(const PixelSums& sums, std::size_t count); // of all blocks, to be resolved
// Values that are no lanes of a block: the first one not finite is named as `what` of `stage`.
void check_values(std::span<const float> values, std::string_view what, std::string_view stage);
#else
inline constexpr bool kCheckLanes = false;
inline void check_lights(const FrameState&) {}
inline void check_primitive(const Primitive&, const Attributes&) {}
inline void check_triangles(const ShadingSetup&, const Attributes&, int, int) {}
inline void check_before_clamp(const float*, int, int) {}
inline void check_rays(const ShadingBlock&, const FrameState&) {}
inline void check_lanes(const ShadingBlock&, const FrameState&, const Stage&) {}
inline void check_sums(const PixelSums&, std::size_t) {}
inline void check_values(std::span<const float>, std::string_view, std::string_view) {}
#endif

} // namespace scanout::shade
