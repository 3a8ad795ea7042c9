// The reference (src/trace) of what a plan draws: its choices without its rungs.
#pragma once

#include "base/jobs.h"
#include "base/result.h"
#include "frame/plan/plan.h"
#include "measure/oracle.h"
#include "scene/scene.h"
#include "trace/look.h"
#include "trace/render.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace scanout::app {

// Fails (Exit::usage) where the plan draws what the reference knows nothing of: another depth test
// or blend than the usual ones, computed textures, a stencil, a filter over the finished picture.
Result<trace::Look> look_of(const frame::FramePlan& plan);

// Fails (Exit::unreadable) where the model's hierarchy and the pixels do not fit into what memory
// is available, or into --max-memory (MB; 0: no such limit).
Result<void> check_reference_fits(const scene::Scene& scene, int width, int height,
                                  int max_memory_mb);

// The look of the reference that rungs are measured against: of what is asked for, but for them.
// Fails as above, and (Exit::usage) where rungs gain nothing, for there is no triangle.
Result<trace::Look> look_of_rungs(const scene::Scene& scene, const frame::SceneFacts& facts,
                                  const scene::View& view, const frame::FrameOptions& options,
                                  int max_memory_mb);

// Its picture. Fails as check_shows_a_difference, and soon after `stop` says so.
Result<trace::Reference> reference_of_rungs(const scene::Scene& scene, const scene::View& view,
                                            const trace::Look& look, Jobs& jobs,
                                            const trace::Effort& effort,
                                            const std::function<void(double)>& progress,
                                            const std::function<bool()>& stop = {});

// Fails (Exit::usage) where all pixels of the reference have one colour: rungs gain nothing then.
Result<void> check_shows_a_difference(const scene::Scene& scene, const image::Image& reference);

// Rays of the reference as the oracle of the axes' own measures. What is named outlives it. Fails
// like trace::Probe::create.
Result<std::unique_ptr<measure::Oracle>>
oracle_of(const scene::Scene& scene, const scene::View& view, const trace::Look& look);

// What of the scene is not in the reference, a line each.
std::vector<std::string> left_out_of_reference(const scene::Scene& scene);

} // namespace scanout::app
