// In test builds (SCANOUT_CHECK_LANES), no live lane may hold NaN or infinity after any stage, nor
// what lanes share; the first that does ends the program with the stage's name. What a stage clamps
// to a number is looked at before. Traps of the processor would fire on
// lanes that a mask discards. Elsewhere it is nothing.
#pragma once

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
// Of a register whose first lane is that of the block: the live ones.
void check_before_clamp(const float* lanes, int count, int first);
void check_rays(const ShadingBlock& block, const FrameState& frame); // set_rays
void check_lanes(const ShadingBlock& block, const FrameState& frame, const Stage& stage);
void check_sums(const PixelSums& sums, std::size_t count); // of all blocks, to be resolved
// What is no lane of a block: the first that is not finite is named as `what` of `stage`.
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
