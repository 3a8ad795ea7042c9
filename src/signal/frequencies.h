// A picture's frequencies: shown as a picture, and some of them dropped. Signal theory as
// [Primer 2.6] has it: a signal is a sum of waves; without some of them and back it is filtered.
//
// Frequencies are fractions of Nyquist's, half a wave a pixel, along each axis; that of a slanting
// wave is the root of the sum of its squares, up to the root of 2 in the corners.
#pragma once

#include "image/image.h"
#include "signal/band.h"
#include "signal/fourier.h"

namespace scanout::signal {

// How much each wave of the luminance has, in linear light: zero frequency in the middle, x to the
// right, y down. Grey is the logarithm of a wave's strength: black is far below the noise of codes
// rounded to 8 bits, white is the strongest.
image::Image spectrum_picture(const image::Image& picture, Jobs& jobs,
                              const Progress& progress = {});

// The picture of the band's waves, mixed in linear light. Without zero frequency there is no mean:
// what is left stands around half the light of white. Alpha stays.
image::Image kept(const image::Image& picture, const Band& band, Jobs& jobs,
                  const Progress& progress = {});

// Memory that the two take beside the pictures.
std::int64_t spectrum_bytes(int width, int height);

} // namespace scanout::signal
