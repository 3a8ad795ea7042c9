// How far two pictures are from each other, in figures: of codes, of light, and of what is seen.
// In double, summed in the order of the pixels: the same bits everywhere. Both pictures have the
// same size.
#pragma once

#include "image/image.h"

#include <vector>

namespace scanout::image {

// Of red, green and blue of all pixels; all 0 for equal and for empty pictures. What is transparent
// counts as it shows: over black or over white, whichever makes a channel differ more.
struct Metrics {
    double rmse_codes = 0; // root of the mean square difference of sRGB codes, 0 to 255
    double rmse = 0;       // the same of linear light, 0 to 1
    int max_codes = 0;     // largest difference of a channel
    double share_off = 0;  // of the pixels: some channel is off by more than one code
};
Metrics metrics(const Image& reference, const Image& test);

// Of a root mean square error of light whose white is 1, dB; infinite where the error is 0.
double psnr(double rmse);

// Structural similarity, 1 for equal pictures: Wang et al. 2004, with the paper's constants and its
// Gaussian window of 11 x 11 pixels, on the luma of codes (0.299 R + 0.587 G + 0.114 B); alpha is
// not looked at. Of the window around each pixel, rows from the top; beyond the picture its edge
// repeats.
std::vector<double> ssim_map(const Image& reference, const Image& test);
// The mean over all windows that lie whole in the picture; where a side is shorter than a window,
// over all.
double ssim(const Image& reference, const Image& test);

} // namespace scanout::image
