// What the plan makes of a technique that a key has asked for.
#pragma once

#include "frame/plan/plan.h"

#include <string>
#include <string_view>

namespace scanout::app {

// " (map_pcf)" where the plan chooses, " (changes nothing: ...)" where it cannot run here; empty
// where what was asked for runs.
std::string switch_note(const frame::FramePlan& plan, std::string_view axis);

} // namespace scanout::app
