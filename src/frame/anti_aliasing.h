// Anti-aliasing techniques (axis `aa`): how a pixel's colour is computed from the samples or areas
// in and around the pixel's box, and what each technique asks of the frame [Primer 6]. The error of
// each: HARD-CASES L1.
#pragma once

#include "base/technique.h"

#include <span>
#include <string_view>

namespace scanout::frame {

struct AntiAliasing {
    Technique card;
    int samples = 1;    // coverage samples of each drawn pixel; a primitive is shaded once
    int scale = 1;      // drawn pixels for one pixel, on each side: all are shaded
    bool exact = false; // areas instead of samples
    // The filter of weighted area sampling: the weight of a sample by its distance from the pixel's
    // centre along one axis, in pixels, up to 1.5; both axes are multiplied. Null: a box filter, in
    // which all of the pixel counts alike.
    double (*weight)(double distance) = nullptr;

    // A pixel is the plain mean of its own samples: no supersampling, no areas, no filter weights.
    bool is_counted() const { return scale == 1 && !exact && weight == nullptr; }
    bool takes_one() const { return is_counted() && samples == 1; }
};

} // namespace scanout::frame
