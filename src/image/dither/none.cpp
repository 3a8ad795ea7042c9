#include "image/dither.h"

namespace scanout::image::dither {

extern const Dither none;
constinit const Dither none{{.axis = "dither",
                             .name = "none",
                             .blurb = "the nearest code: half a code wrong, in bands",
                             .source = "[A ch.2]",
                             .kind = Kind::rung},
                            false};

} // namespace scanout::image::dither
