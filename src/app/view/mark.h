// The mark at a place of the picture that the viewer points out.
#pragma once

#include "app/view/pixel_place.h"
#include "image/image.h"

namespace scanout::app {

// A cross with a gap around the place; `scale`: font pixels, as of the text.
void draw_mark(image::Image& picture, PixelPlace at, int scale);

} // namespace scanout::app
