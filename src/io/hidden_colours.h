// The colours that nobody sees: under an alpha of 0 a picture may hold any, and filters and mip
// levels would mix them into what is seen beside it, as a fringe.
#pragma once

#include "image/image.h"

namespace scanout::io {

// Gives texels of alpha 0 the colours of those round about that are seen; alpha stays 0. Nearest
// ones first, at any distance: Gortler et al. 1996 (pull-push). Returns false where there are none.
bool fill_hidden_colours(image::Image& picture);

// An alpha channel of zeros is one that nobody painted: makes it opaque. Returns whether it was
// one.
bool paint_clear_alpha(image::Image& picture);

} // namespace scanout::io
