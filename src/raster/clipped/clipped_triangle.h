// Clipped triangles: the rest, after near clipping, of a triangle that has a vertex off the screen
// (too near, behind the eye, or beyond the guard band). Nothing is cut at the picture's sides, and
// no cut is snapped. One or two triangles remain before the near plane: a vertex on the screen
// keeps its snapped position, as in unclipped triangles, any other stays in homogeneous
// coordinates, to 50 bits. From there on every number is an integer and every sign exact, so an
// edge is the same line for both its neighbours, and edges that meet in a vertex meet there however
// far away it is: watertight, no gap, no double hit (HARD-CASES 3, 8, 12, P7). Edges as homogeneous
// lines: Olano and Greer 1997.
//
// The near plane must still cut: an edge to a vertex behind the eye would turn about it when its
// other end snaps, and move by up to the ratio of their distances from the eye, not by 1/256 pixel.
// The cut point lies before the eye, so the points between it and the other end move less.
#pragma once

#include "image/image.h"
#include "raster/screen/clip.h"
#include "raster/screen/primitive.h"
#include "raster/screen/sample_pattern.h"
#include "raster/screen/screen.h"

#include <array>
#include <cstdint>
#include <span>

namespace scanout::raster {

__extension__ using Int128 = __int128;

// Its place on the screen is (x / w, y / w) 2^23, in 1/256 pixel; w >= 0, |x|, |y|, w <= 2^50. At
// this scale, w has the same precision as x and y on the screen.
struct ExactPoint {
    static constexpr int kBits = 23;
    std::int64_t x, y, w;
    double z;     // depth times w 2^-23
    double depth; // in (0, 1], greater is nearer
    EdgePoint edge_point = {};
};
ExactPoint point_on_screen(const ScreenVertex& vertex, const EdgePoint& edge_point = {});
// w >= the near plane's
ExactPoint point_off_screen(const ClipVertex& vertex, const EdgePoint& edge_point = {});

// The vertices are in canonical order (lowest y, x, w first).
struct ClippedTriangle {
    std::array<ExactPoint, 3> vertex;
    std::uint32_t id;
    bool flipped;   // in this order the interior is on the negative side of the edges
    bool clockwise; // on the screen, in the order in which the vertices were given
};

// The clipped triangles of one triangle; none has area 0.
struct ClippedTriangles {
    std::array<ClippedTriangle, 2> triangle;
    int count = 0;
    auto begin() const { return triangle.begin(); }
    auto end() const { return triangle.begin() + count; }
};
// Clips against the near plane. on_screen: the snapped vertices.
ClippedTriangles clip_triangle(const std::array<ClipVertex, 3>& vertex,
                               const std::array<ScreenVertex, 3>& on_screen, double near_w,
                               std::uint32_t id);
// Splits a polygon of three or four vertices. Neither the diagonal nor the order of the results
// depends on where the polygon begins or which way it winds.
ClippedTriangles split_polygon(std::span<const ExactPoint> polygon, std::uint32_t id);

// E_i = a_i x + b_i y + c_i (x, y in 1/256 pixel), opposite vertex i. A sample is inside where none
// is negative: the top-left rule is in c. |E| < 2^126 within the picture.
struct ExactEdges {
    std::array<Int128, 3> a, b, c;
    Int128 at(std::size_t i, std::int64_t x, std::int64_t y) const {
        return a[i] * x + b[i] * y + c[i];
    }
};
ExactEdges edges_of(const ClippedTriangle& clipped);
bool covers(const ClippedTriangle& clipped, std::int32_t x, std::int32_t y); // 1/256 pixel

// weight_i = a_i x + b_i y + c_i at a sample (x, y in 1/256 pixel): the perspective-correct weight
// of vertex i, up to a common factor. Inside none is negative, but for rounding.
struct ClippedWeights {
    std::array<double, 3> a, b, c;
};
ClippedWeights weights_of(const ClippedTriangle& clipped, bool perspective);

// The vertex of the first of two clipped triangles that is opposite their common edge.
std::size_t opposite_common_edge(const ClippedTriangles& two);

// Twice the area times the three w, always positive; rounded.
double size_of(const ClippedTriangle& clipped);

image::Rect pixel_bounds(const ClippedTriangle& clipped, int width, int height,
                         const SampleExtent& extent);

} // namespace scanout::raster
