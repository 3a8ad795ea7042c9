// What the viewer shows, as options of the command line: K prints it, screenshots hold it.
#pragma once

#include "app/viewer.h"

#include <string>

namespace scanout::app {

// "--camera 30,20,2.4 --rotate 0,45,0 ...": with these options the model stands in the picture as
// it does now, to a thousandth of a pixel. Lights that keys have moved are not among them; a camera
// that was rolled or moved aside is told as a model that was, so that lights which stand in the
// world light another side of it. Empty: nothing can be seen from here.
std::string view_options(const Viewer& viewer, const Settings& settings, const geom::Mesh& mesh);

// The whole command, for a shell: `path` in quotes where it wants them.
std::string view_command(const std::string& path, const std::string& options);

} // namespace scanout::app
