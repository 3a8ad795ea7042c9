// What can be told of a view from the model's bounding sphere alone, before anything is drawn.
#pragma once

#include "scene/light.h"
#include "scene/view.h"

namespace scanout::frame {

// Of the model, in view space; with a margin, as for the width of lines.
struct BoundingSphere {
    DVec3 centre{0};
    double radius = 0;
};
BoundingSphere bounding_sphere(const scene::View& view);

// A view without a near plane, as of a plan that knows none, is anywhere.
bool may_be_visible(const scene::View& view);
// Whether a spot's cone meets the model; all other lights reach everything.
bool may_be_lit(const scene::ViewLight& light, const scene::View& view);

} // namespace scanout::frame
