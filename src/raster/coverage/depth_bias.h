// Depth bias: how far a primitive is moved towards the eye so that it is seen on the surface that
// it lies on (HARD-CASES R19; Microsoft 2015, 15.10; Khronos 2016, "Depth Bias").
#pragma once

namespace scanout::raster {

struct DepthBias {
    double constant = 0;    // steps of the depth's precision
    double slope_scale = 0; // pixels
    double clamp = 0;       // > 0: at most, < 0: at least, 0: no bound
};

// The step r = 2^(exponent of depth - 23), the distance to the next float.
double depth_step(float depth);

// constant * r + slope_scale * max_slope, then clamped. max_depth: the largest |depth| of the
// primitive; max_slope: the larger of |dz/dx| and |dz/dy|, a pixel. With slope_scale 0 there is no
// slope term even for an infinite slope: 0 * infinity is not a depth.
double depth_bias(const DepthBias& bias, float max_depth, double max_slope);

} // namespace scanout::raster
