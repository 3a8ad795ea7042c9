// How seldom a triangle's attributes need a division by w: from error bounds of the straight lines
// in between, which hold for every row of the triangle.
//
// Along a stretch whose ends are at distances of ratio r, a straight line errs by at most (sqrt(r)
// - 1) / (sqrt(r) + 1) of the attribute's change on it; over a whole triangle, of its range
// (HARD-CASES 33: 0.024, 0.17 and 0.52 at r = 1.1, 2 and 10).
#pragma once

#include "shade/stage.h"

namespace scanout::shade {

inline constexpr std::int8_t kAffine = 127; // Primitive::step: not at all

// The largest errors that are allowed, for the attributes that a frame reads.
struct StepLimits {
    Attributes attributes;
    double uv = 0;       // in units of u and v
    double colour = 0;   // in linear light
    double normal = 0;   // length of the error of a unit vector
    double position = 0; // of each coordinate
};

// kAffine, 16, 8, or 0: at every pixel.
std::int8_t step_for(const Primitive& triangle, const StepLimits& limits);

} // namespace scanout::shade
