// How long a frame takes now: for a quick look whether a time that was measured earlier still
// holds.
#pragma once

#include "base/jobs.h"
#include "frame/plan/plan.h"
#include "measure/paired.h"
#include "scene/scene.h"
#include "scene/view.h"

namespace scanout::measure {

// The median of some frames after the first, which makes room. Takes about as long as is said, and
// 4 frames in any case.
Cost frame_cost(const scene::Scene& scene, const scene::View& view, const frame::FramePlan& plan,
                Jobs& jobs, double seconds);

} // namespace scanout::measure
