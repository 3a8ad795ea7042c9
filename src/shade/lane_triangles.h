// Triangles of a block's lanes: set up once a block, many side by side, whence each lane takes its
// own's. Cheaper than one by one where triangles show in few pixels, and where pixels are shared by
// many; nothing is kept from block to block, so that neither order nor number of triangles matters.
// The same operations as shade/primitives.cpp, and so the same bits.
#pragma once

#include "raster/screen/screen.h"
#include "shade/stage.h"

#include <cstdint>

namespace scanout::shade {

struct GatherInput;

// Their vertices are in canonical order.
struct LaneTriangles {
    // Set by the gatherer: the triangles, with all their vertices on the screen; which of them each
    // lane shows: from lane to lane of a run the same or the next one, and any number behind the
    // last lane. The block's first lanes are known to be covered at their pixels' centres; of the
    // others, from there to a sample that shows them (1/256 pixel), where they are shaded if they
    // do not cover the centre.
    int count = 0;
    std::uint32_t id[kPaddedBlock];
    std::int32_t of_lane[kPaddedBlock];
    int centred = 0;
    std::int32_t sample_x[kPaddedBlock], sample_y[kPaddedBlock];

    // Set up on the way: their vertices, and which face the other way than those are wound.
    alignas(64) std::uint32_t corner[3][kPaddedBlock];
    alignas(64) std::int32_t turned[kPaddedBlock];

    // Set up, of lanes. weight: opposite areas times 1/w, none is negative.
    alignas(64) float weight[3][kPaddedBlock];
    alignas(64) float slope[4][kPaddedBlock]; // u_x, v_x, u_y, v_y of the block
    // Opposite the vertices, for slopes of whole ones.
    alignas(64) std::int32_t area[3][kPaddedBlock];

    // Of triangles. x, y: vertex 0, 1/256 pixel. How the areas opposite vertices 1 and 2 change in
    // 1/256 pixel to the right and down; both are 0 at vertex 0, and with the third they add up to
    // twice the triangle. `twice` is that modulo 2^32, which is exact for those that are `whole`
    // (Primitive); exact_twice is set where some of a register are not.
    alignas(64) std::int32_t x[kPaddedBlock], y[kPaddedBlock];
    alignas(64) std::int32_t right[2][kPaddedBlock], down[2][kPaddedBlock], twice[kPaddedBlock];
    alignas(64) std::int32_t whole[kPaddedBlock];
    // x and y, right and down, modulo 2^16, in the halves of a number.
    alignas(64) std::int32_t place[kPaddedBlock], step[2][kPaddedBlock];
    alignas(64) double exact_twice[kPaddedBlock];
    alignas(64) float inverse_w[3][kPaddedBlock];
    // side: what normals are multiplied by (Sides), and have been. The rest as in Primitive,
    // [component][vertex].
    alignas(64) float side[kPaddedBlock];
    alignas(64) float facing[3][kPaddedBlock];
    alignas(64) float normal[3][3][kPaddedBlock], uv[2][3][kPaddedBlock];
    alignas(64) float colour[3][3][kPaddedBlock];
    alignas(64) float position[3][3][kPaddedBlock];
    // How u and v lie on it (footprint-inl.h).
    alignas(64) double uv_plane[10][kPaddedBlock];
};

// What the frame's triangles are made of.
struct TriangleSource {
    const std::uint32_t* index; // three a triangle, by place
    const std::uint32_t* place; // of triangles by number; null: places are numbers
    const raster::ScreenVertex* vertex;
    const float *position, *normal, *uv, *colour; // of vertices; null where the mesh has none
    double linear[3][3], translation[3], scale;   // to view space: (linear p + translation) scale
    bool perspective, mirrored;
    Sides sides;
    Attributes wanted;

    bool wants_facing() const { return sides == Sides::eye || wanted.facing; }
    bool wants_position() const { return wanted.position || wants_facing(); }
};
TriangleSource triangle_source(const GatherInput& input);

// A block's lanes from `lane` on get their triangles. number: of so many lanes' triangles in ids,
// from lane to lane the same or the next one. Reads up to a register behind the last of both.
void take_lanes(const std::int32_t* number, const std::uint32_t* ids, int count,
                LaneTriangles& triangles, int lane);

// Of lanes first to first + count of a run, which lie at the centres of their pixels: sets up their
// triangles, and moves those lanes that their triangles do not cover there.
void set_up_lanes(const TriangleSource& source, LaneTriangles& triangles, Block& block, int first,
                  int count);

// A triangle's vertices. By place: coverage has just read those of a tile there, and the file may
// have them anywhere; then the place alone is waited for, and should be asked for ahead.
inline const std::uint32_t* vertices_of(const TriangleSource& s, std::uint32_t triangle) {
    return s.index + std::size_t{s.place == nullptr ? triangle : s.place[triangle]} * 3;
}
inline void prefetch_place(const TriangleSource& s, std::uint32_t triangle) {
    if (s.place != nullptr) __builtin_prefetch(s.place + triangle);
}

// Do all vertices stand on the screen? Else it is drawn in pieces, which no lane has.
inline bool is_whole(const TriangleSource& s, std::uint32_t triangle) {
    const std::uint32_t* v = vertices_of(s, triangle);
    return s.vertex[v[0]].on_screen() && s.vertex[v[1]].on_screen() && s.vertex[v[2]].on_screen();
}

} // namespace scanout::shade
