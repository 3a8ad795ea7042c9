// The memory that each effect of a frame holds.
#pragma once

#include "frame/plan/plan.h"
#include "scene/scene.h"

#include <cstdint>
#include <map>
#include <string>

namespace scanout::frame {

// Bytes by the effects' names in the plan; an effect that is off or holds nothing has no entry.
using EffectBytes = std::map<std::string, std::uint64_t, std::less<>>;

EffectBytes bytes_by_effect(const scene::Scene& scene, const FramePlan& plan);

} // namespace scanout::frame
