// More of a texture than there is: pictures of any size that look like a sample without repeating
// it. By pixel (Efros and Leung 1999), each the sample's pixel whose neighbourhood fits best; by
// patch (Efros and Freeman 2001), overlapping squares cut along the cheapest seam. [Primer 9.3.2].
//
// Distances are sums of whole numbers and choices are drawn in one order: the same bits on every
// machine and for every number of threads.
#pragma once

#include "base/jobs.h"
#include "image/image.h"
#include "signal/progress.h"

#include <cstdint>

namespace scanout::signal {

enum class SynthesisBy : std::uint8_t { pixel, patch };

struct Synthesis {
    int width = 0, height = 0;
    SynthesisBy by = SynthesisBy::patch;
    int window = 0; // pixels a side: of the neighbourhood, odd; or of a patch
    std::uint64_t seed = 1;
};

// What is taken where nobody asks: 11 pixels around a pixel, or a quarter of the sample's shorter
// side, and no more than the sample has.
int default_window(const image::Image& sample, SynthesisBy by);
// The least and the greatest that a sample allows.
inline constexpr int kLeastWindow = 3;
int greatest_window(const image::Image& sample);

// The window fits into the sample; of by pixel it is odd.
image::Image synthesised(const image::Image& sample, const Synthesis& how, Jobs& jobs,
                         const Progress& progress = {});

} // namespace scanout::signal
