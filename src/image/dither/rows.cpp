// With and without ordered dither. The arithmetic is in image/dither.h.
#include "rows.h"

#include "image/dither.h"

namespace scanout::image::dither {

constinit const Dither none{{"dither", "none", "the nearest code: half a code wrong, in bands",
                             "Roberts 1962, without his noise", Kind::rung},
                            false};

constinit const Dither bayer{
    {"dither",
     "bayer",
     "8x8 thresholds: up to a code wrong at a pixel, 1/128 on average",
     "Bayer 1973",
     Kind::rung,
     false,
     {"none", "a pixel is off by more, so that the mean of several is right"}},
    true};

} // namespace scanout::image::dither
