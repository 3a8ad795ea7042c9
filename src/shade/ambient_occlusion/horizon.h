// The horizons around what each pixel shows: Bavoil et al. 2008, with the integral
// over a horizon, weighted by the cosine, of Jimenez et al. 2016 (GTAO).
//
// A direction on the screen and the ray from the eye span a plane; the surfaces that the steps of
// the direction meet in it raise its horizon, and each counts by its distance for the arc by which
// it does, as in Bavoil. What is hidden is compared with all that could be in the same planes, so
// that few directions are exact where nothing is hidden, and where all is. The normal is the face's
// own: no flat face and no convex body hides light from itself, to the bit.
#pragma once

#include "shade/ambient_occlusion.h"

namespace scanout::shade::ambient_occlusion {

// The directions and steps of a pixel: turned and moved by its place in a tile of 4 x 4 pixels, of
// which blur.h takes the mean (Jimenez et al. 2016).
struct HorizonPattern {
    static constexpr int kTile = 4, kRegister = 16; // columns repeat over a register
    int pairs = 0, steps = 0;
    float cosine[kMaxDirections / 2][kTile][kRegister], sine[kMaxDirections / 2][kTile][kRegister];
    float move[kTile][kRegister]; // of the steps, in steps
};
HorizonPattern horizon_pattern(const OcclusionTraits& of);

// Sets `open` of the rows from y0 on, up to y1: rows of `stride` floats.
void find_horizons(const SurfaceImage& image, const HorizonPattern& pattern, int y0, int y1,
                   float* open);

} // namespace scanout::shade::ambient_occlusion
