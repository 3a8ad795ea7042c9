#include "image/dither.h"

namespace scanout::image::dither {

extern const Dither none;
constinit const Dither none{{.axis = "dither",
                             .name = "none",
                             .blurb = "the nearest code: half a code wrong, in bands",
                             .source = "Roberts 1962, without his noise",
                             .kind = Kind::rung},
                            false};

} // namespace scanout::image::dither
