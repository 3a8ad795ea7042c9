// The error bounds of `--interpolate adaptive` in a scene: 1/256 texel, and half a code of colour.
#pragma once

#include "frame/plan/plan.h"
#include "scene/scene.h"
#include "shade/setup/interpolation_step.h"

namespace scanout::frame {

shade::StepLimits step_limits(const scene::Scene& scene, const FramePlan& plan);

} // namespace scanout::frame
