// --texture-file: a picture on what names none.
#pragma once

#include "base/result.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace scanout::app {

// Every material without a map_Kd gets the picture; what the file gives no material then has the
// picture's own colours. Fails like image::load. Where it shows nowhere, a warning says why.
Result<void> put_texture(const std::string& picture, scene::Scene& scene,
                         std::vector<std::string>& warnings);

} // namespace scanout::app
