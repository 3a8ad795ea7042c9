// How a pixel's colour is found from what lies in and around its box [Primer 6]: the techniques of
// axis `aa`, and what each asks of the frame. What each errs: HARD-CASES L1.
#pragma once

#include "base/technique.h"

#include <span>
#include <string_view>

namespace scanout::frame {

struct AntiAliasing {
    Technique card;
    int samples = 1;    // of coverage, for every pixel that is drawn; shaded once a primitive
    int scale = 1;      // pixels that are drawn for one, on each side: all are shaded
    bool exact = false; // areas instead of samples
    // Weighted area sampling: how much a sample counts, by its distance from the pixel's centre
    // along one axis, in pixels, up to 1.5; the product of both axes. Null: all of the pixel's box
    // alike.
    double (*weight)(double distance) = nullptr;

    // A pixel is the mean of its samples, and nothing else.
    bool is_counted() const { return scale == 1 && !exact && weight == nullptr; }
    bool takes_one() const { return is_counted() && samples == 1; }
};

} // namespace scanout::frame
