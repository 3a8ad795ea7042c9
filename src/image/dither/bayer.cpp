#include "image/dither.h"

namespace scanout::image::dither {

extern const Dither bayer;
constinit const Dither bayer{
    {.axis = "dither",
     .name = "bayer",
     .blurb = "8x8 thresholds: up to a code wrong at a pixel, 1/128 on average",
     .source = "Bayer 1973",
     .kind = Kind::rung},
    true};

} // namespace scanout::image::dither
