// A view without a camera, for tests that place vertices themselves.
#pragma once

#include "scene/view.h"

namespace scanout::test {

// Mesh x, y are pixels of a picture of this size (y up from the bottom), z is depth.
inline scene::View pixel_view(int width, int height) {
    scene::View view;
    view.projection = scene::Projection::orthographic;
    view.half_width = width / 2.0;
    view.half_height = height / 2.0;
    view.translation = {-width / 2.0, -height / 2.0, 0};
    return view;
}

} // namespace scanout::test
