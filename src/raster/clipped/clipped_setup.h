// Set-up of a clipped triangle, shared by all tiles that draw it: its edge functions in integers of
// up to 126 bits, their ranges, and its depth.
#pragma once

#include "image/image.h"
#include "raster/clipped/clipped_triangle.h"
#include "raster/screen/sample_pattern.h"

#include <cstdint>

namespace scanout::raster {

// How far the edge functions in a square of pixels may lie below and above those at its corner.
struct EdgeExtent {
    Int128 lowest[3], highest[3];
    EdgeExtent(const ExactEdges& edges, const SampleExtent& extent, int side); // pixels
};

struct ClippedSetup {
    ClippedTriangle triangle;
    ExactEdges edges;
    EdgeExtent of_tile, of_block;
    double a[3], b[3];      // of the edges, rounded
    double depth_factor[3]; // depth is the sum of E_i depth_factor_i
    double per_x, per_y;    // of depth, 1/256 pixel
    double terms = 0;       // bound of the terms that may cancel in these slopes
    double least, most;     // depth of the vertices
    image::Rect box;        // pixels that it may touch, of a picture of any size
    SampleExtent extent;    // holds the patterns of all these tiles
    ClippedSetup(const ClippedTriangle& triangle, const SampleExtent& extent);

    double depth_of(const double (&e)[3]) const {
        return (e[0] * depth_factor[0] + e[1] * depth_factor[1]) + e[2] * depth_factor[2];
    }
};

} // namespace scanout::raster
