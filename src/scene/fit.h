// Where the camera stands so that a model just fits the picture: by its vertices as they are
// projected, not by a sphere about them.
#pragma once

#include "geom/mesh.h"
#include "scene/motion/motion.h"
#include "scene/view.h"

namespace scanout::scene {

// Of the picture's half width or height: what a model that fits takes at most. 5 % are left free on
// each side.
inline constexpr double kFitFill = 0.9;

// The camera with the distance and the shift at which the model fits, centred, along the side that
// is narrower for it; unchanged where it stands somewhere already: where it has a distance, or an
// eye and a target. The model is turned as `model` says; what else that says moves it out of the
// fit: its translation and its size, but not the ratios of its scales. turns > 1: it also fits
// when it is turned about the vertical axis by that many even parts of a full turn.
CameraOptions fitted(const geom::Mesh& mesh, const ModelTransform& model,
                     const CameraOptions& camera, double aspect, int turns = 1);
// The same for all of a motion, by sixteen moments of it. The camera is at rest: the motion moves
// it on. Unchanged also where the motion itself says a distance or a place of the eye.
CameraOptions fitted(const geom::Mesh& mesh, const ModelTransform& model,
                     const CameraOptions& camera, double aspect, const Motion& motion);

} // namespace scanout::scene
