// Ignored options: options of the user or the model that a frame cannot show, with one line each
// that gives the reason.
#pragma once

#include "frame/plan/plan.h"

#include <string>
#include <vector>

namespace scanout::frame {

// Lines about effects that are forced on, techniques and numbers that nothing in this frame reads,
// and maps of a model without texture coordinates.
std::vector<std::string> ignored_options(const FramePlan& plan);

} // namespace scanout::frame
