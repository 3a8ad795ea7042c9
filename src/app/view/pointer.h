// The mouse pointer: a console has no compositor that would draw one.
#pragma once

#include "image/image.h"

namespace scanout::app {

// The pixels that the pointer with its tip at (x, y) covers, cut to the picture.
image::Rect pointer_area(int x, int y, int width, int height);
void draw_pointer(image::Image& picture, int x, int y);

} // namespace scanout::app
