// Where a model's transform puts it, in the world.
#pragma once

#include "scene/view.h"

namespace scanout::scene {

// World place = linear p + offset, of a place of the file turned by up_rotation, in bounding radii
// from the model's centre.
struct Placement {
    DMat3 linear{1};
    DVec3 offset{0};
};
Placement placement_of(const ModelTransform& model, const geom::Mesh& mesh, UpAxis up);

} // namespace scanout::scene
