// What the user or the model asked for and a frame cannot show: one line each, with the reason.
#pragma once

#include "frame/plan/plan.h"

#include <string>
#include <vector>

namespace scanout::frame {

// Of effects that are forced on, techniques and numbers that nothing in this frame reads, and of
// maps that have no place on the model.
std::vector<std::string> ignored_options(const FramePlan& plan);

} // namespace scanout::frame
