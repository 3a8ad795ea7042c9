// --renderer and the parts of the textbook renderers: what the command line may ask of them, and
// what of a frame's plan they draw.
#pragma once

#include "app/options/settings.h"
#include "base/result.h"
#include "frame/plan/plan.h"
#include "scene/scene.h"
#include "textbook/render.h"

#include <string>
#include <vector>

namespace scanout::app {

// Fails (Exit::usage) where a part is named and no textbook renderer is, or that has no part in the
// picture, and where an option or an effect is asked for that they lack.
Result<void> check_textbook(const Settings& settings);

// What a plan looks like to them; what is on in it that they lack is left out.
textbook::Look textbook_look_of(const frame::FramePlan& plan);
// What that is, a line each.
std::vector<std::string> left_out_of_textbook(const frame::FramePlan& plan,
                                              const scene::Scene& scene);

} // namespace scanout::app
