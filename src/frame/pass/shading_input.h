// Makes the inputs of shading from a plan: everything that stages, the gatherer and the
// transparency pass read of a frame's plan, view and lights.
#pragma once

#include "frame/pass/lights.h"
#include "frame/plan/plan.h"
#include "raster/screen/screen.h"
#include "raster/stage/geometry.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "shade/gather/gather.h"
#include "shade/mip/mip_chain.h"
#include "shade/stage.h"

namespace scanout::frame {

// The state refers to the plan and the lights: both must outlive it. The renderer adds shadows and
// step limits.
shade::FrameState frame_state(const scene::View& view, const FramePlan& plan,
                              const FrameLights& lights);

// The input refers to all arguments: all must outlive it.
shade::GatherInput gather_input(const scene::Scene& scene, const scene::View& view,
                                const FramePlan& plan, const raster::Geometry& geometry,
                                const raster::ScreenTransform& transform,
                                const shade::FrameState& frame, const shade::MipChains& mips);

// frame: of the plan's opaque surfaces. The input refers to the plan, which must outlive it.
shade::TransparencyInput transparency_input(const FramePlan& plan, const shade::FrameState& frame);

} // namespace scanout::frame
