// Do both sides draw the same thing? A side that draws less must not count as fast.
#pragma once

#include "image/image.h"

namespace scanout::bench {

struct PicturePair {
    image::Image ours, theirs;
};

struct Difference {
    double flip = 0; // mean of the whole picture
    // Pixels that one side alone covers, over those that either does: most of a picture is
    // background, so that a mean hardly sees what a side leaves out of the model.
    double one_sided = 0;
};
// Pixels of any colour but the background's are covered. Pictures of nothing are one-sided as a
// whole: they compare no drawing.
Difference difference(const PicturePair& pair, const image::Rgba8& background);

// The larger of each.
Difference worse(const Difference& a, const Difference& b);

} // namespace scanout::bench
