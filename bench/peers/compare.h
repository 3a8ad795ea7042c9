// Do both sides draw the same thing? A side that draws less must not count as fast.
#pragma once

#include "bench/peers/ours.h"
#include "bench/peers/theirs.h"
#include "image/image.h"

namespace scanout::bench {

struct PicturePair {
    image::Image ours, theirs;
};

// Of the frame that both drew last, of this view. Depth alone becomes grey: nearer is brighter.
PicturePair pictures_of(const Ours& ours, const Theirs& theirs, const Load& load,
                        const scene::View& view);

} // namespace scanout::bench
