// With and without ordered dither. The arithmetic is in image/dither.h.
#include "rows.h"

#include "image/dither.h"

namespace scanout::image::dither {

namespace {

constexpr Technique card(std::string_view name, std::string_view blurb, std::string_view source) {
    return {"dither", name, blurb, source, Kind::rung};
}

} // namespace

constinit const Dither none{card("none", "the nearest code: half a code wrong, in bands",
                                 "Roberts 1962, without his noise"),
                            false};

constinit const Dither bayer{
    card("bayer", "8x8 thresholds: up to a code wrong at a pixel, 1/128 on average", "Bayer 1973"),
    true};

} // namespace scanout::image::dither
