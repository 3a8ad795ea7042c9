// A lane's own triangle: set up once a lane instead of once a triangle, many side by side. Cheaper
// where triangles show in few pixels, and where pixels are shared by many; nothing is kept from
// lane to lane, so that neither order nor number of triangles matters. The same operations as
// shade/primitives.cpp, and so the same bits.
#pragma once

#include "raster/screen.h"
#include "shade/stage.h"

#include <cstdint>

namespace scanout::shade {

struct GatherInput;

// Of lanes of a block; their vertices are in canonical order.
struct LaneTriangles {
    // Set by the gatherer: the triangle, with all its vertices on the screen; and from the pixel's
    // centre to a sample that shows it (1/256 pixel), where it is shaded if it does not cover the
    // centre.
    std::uint32_t id[kRoom];
    std::int32_t sample_x[kRoom], sample_y[kRoom];

    // Set up. weight: opposite areas times 1/w, none is negative. side: what normals are multiplied
    // by (Sides). The rest as in Primitive, [component][vertex].
    alignas(64) float weight[3][kRoom];
    alignas(64) float side[kRoom];
    alignas(64) float facing[3][kRoom];
    alignas(64) float normal[3][3][kRoom], uv[2][3][kRoom], colour[3][3][kRoom];
    alignas(64) float position[3][3][kRoom];
    alignas(64) float slope[4][kRoom]; // u_x, v_x, u_y, v_y of the block
};

// What the frame's triangles are made of.
struct TriangleSource {
    const std::uint32_t* index; // three a triangle
    const raster::ScreenVertex* vertex;
    const float *position, *normal, *uv, *colour; // of vertices; null where the mesh has none
    double linear[3][3], translation[3], scale;   // to view space: (linear p + translation) scale
    bool perspective, mirrored;
    Sides sides;
    Attributes wanted;

    bool wants_facing() const { return sides == Sides::eye || wanted.facing; }
};
TriangleSource triangle_source(const GatherInput& input);

// Of lanes first to first + count, which lie at the centres of their pixels: sets up their
// triangles, and moves those lanes that their triangles do not cover there.
void set_up_lanes(const TriangleSource& source, LaneTriangles& triangles, Block& block, int first,
                  int count);

// Do all vertices stand on the screen? Else it is drawn in pieces, which no lane has.
inline bool is_whole(const TriangleSource& s, std::uint32_t triangle) {
    const std::uint32_t* v = s.index + std::size_t{triangle} * 3;
    return s.vertex[v[0]].on_screen() && s.vertex[v[1]].on_screen() && s.vertex[v[2]].on_screen();
}

} // namespace scanout::shade
