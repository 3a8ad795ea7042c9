// The viewer's present view as options of the command line: K prints it, screenshots hold it.
#pragma once

#include "app/view/viewer.h"

#include <string>

namespace scanout::app {

// "--samples 8 --camera 30,20,2.4 --rotate 0,45,0 ...": what the command line said of picture and
// model, and with what the model appears in the picture as it does now, to a thousandth of a pixel;
// for a shell, quoted where it needs that. Lights moved by keys are not included. A rolled or
// shifted camera is expressed by a model that is rolled or shifted, so lights fixed to the world
// then light another side of it. Empty where nothing can be seen.
std::string view_options(const Viewer& viewer, const Settings& settings, const geom::Mesh& mesh);

// The whole command, for a shell: `path` is quoted where the shell needs it.
std::string view_command(const std::string& path, const std::string& options);

} // namespace scanout::app
