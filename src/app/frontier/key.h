// What a measured frontier depends on, as text: where two are equal, one measurement serves both.
#pragma once

#include "frame/options.h"
#include "scene/scene.h"
#include "scene/view.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scanout::app {

// Lines "name value": the content of the scene (scene/content.h), options, size, view, axes that
// are free, threads, instruction set, processor, program. No line end is in a value.
std::string frontier_key(std::uint64_t scene_content, const scene::View& view,
                         const frame::FrameOptions& options, const std::vector<std::string>& axes,
                         int threads);

} // namespace scanout::app
