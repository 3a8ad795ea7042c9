// The model's bounding sphere against the view frustum and against spot lights' cones, before
// anything is drawn.
#pragma once

#include "scene/light.h"
#include "scene/view.h"

namespace scanout::frame {

// The model's sphere in view space; with a margin, as for the width of lines.
struct BoundingSphere {
    DVec3 centre{0};
    double radius = 0;
};
BoundingSphere bounding_sphere(const scene::View& view);

// Frustum test; always true of a view without a near plane, as a plan that knows none has.
bool may_be_visible(const scene::View& view);
// Cone test: whether a spot's cone meets the sphere; all other lights reach everything.
bool may_be_lit(const scene::ViewLight& light, const scene::View& view);

} // namespace scanout::frame
