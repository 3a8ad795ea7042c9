// What both sides drew, as pictures that can be compared.
#pragma once

#include "bench/peers/compare.h"
#include "bench/peers/ours.h"
#include "bench/peers/theirs.h"

namespace scanout::bench {

// Of the frame that both drew last, of this view. Depth alone becomes grey: nearer is brighter,
// and all of it is brighter than the background.
PicturePair pictures_of(const Ours& ours, const Theirs& theirs, const Load& load,
                        const scene::View& view);

} // namespace scanout::bench
