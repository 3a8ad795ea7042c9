// One camera for two models that lie in the same coordinates, as two versions of a part do.
#pragma once

#include "geom/mesh.h"
#include "scene/view.h"

#include <utility>

namespace scanout::scene {

// For each model the camera that shows it where it lies in its file: both pictures show the same
// part of space. Where `camera` says no distance, both models fit (scene/fit.h); a distance, a
// shift, near, far and a window are in bounding radii of the first.
std::pair<CameraOptions, CameraOptions> shared_cameras(const geom::Mesh& first,
                                                       const geom::Mesh& second,
                                                       const CameraOptions& camera, double aspect);

} // namespace scanout::scene
