// Triangle set-up for shading: the triangles of a block, set up side by side in SIMD lanes, once a
// block, so that each pixel of the block reads those of its own. Cheaper than one set-up after the
// other where triangles are small and where edge pixels show many. Nothing is kept from block to
// block, so neither the order nor the number of triangles matters. A triangle with many pixels is
// set up by the same kernel, once a tile (shade/setup/primitive_setup.h): the same bits.
#pragma once

#include "raster/screen/screen.h"
#include "shade/stage.h"

#include <cstdint>

namespace scanout::shade {

struct GatherInput;

// Their vertices are in canonical order.
struct ShadingSetup {
    // Set by the gatherer: the triangles, with all their vertices on the screen; which of them each
    // item shows: from item to item of a run the same or the next one, and any number behind the
    // last item. The block's first items are known to be covered at their pixels' centres; of the
    // others, from there to a sample that shows them (1/256 pixel), where they are shaded if they
    // do not cover the centre.
    int count = 0;
    std::uint32_t id[kPaddedBlock];
    std::int32_t triangle_of[kPaddedBlock];
    int centred = 0;
    std::int32_t sample_x[kPaddedBlock], sample_y[kPaddedBlock];

    // Set up on the way: their vertices, and which face the other way than those are wound.
    alignas(64) std::uint32_t vertex_index[3][kPaddedBlock];
    alignas(64) std::int32_t flipped[kPaddedBlock];

    // Set up, of items. weight: opposite areas times 1/w, none is negative.
    alignas(64) float weight[3][kPaddedBlock];
    alignas(64) float slope[4][kPaddedBlock]; // u_x, v_x, u_y, v_y of the block
    // Opposite the vertices, for slopes of those that fit_int32.
    alignas(64) std::int32_t area[3][kPaddedBlock];

    // Of triangles. x, y: vertex 0, 1/256 pixel. How the areas opposite vertices 1 and 2 change in
    // 1/256 pixel to the right and down; both are 0 at vertex 0, and with the third they add up to
    // twice the triangle. `twice_area` is that modulo 2^32, which is exact where fits_int32
    // (Primitive); exact_twice_area is set where some of a register are not.
    alignas(64) std::int32_t x[kPaddedBlock], y[kPaddedBlock];
    alignas(64) std::int32_t right[2][kPaddedBlock], down[2][kPaddedBlock],
        twice_area[kPaddedBlock];
    alignas(64) std::int32_t fits_int32[kPaddedBlock];
    alignas(64) double exact_twice_area[kPaddedBlock];
    alignas(64) float inverse_w[3][kPaddedBlock];
    // side: what normals are multiplied by (Sides), and have been. The rest as in Primitive,
    // [component][vertex].
    alignas(64) float side[kPaddedBlock];
    alignas(64) float facing[3][kPaddedBlock];
    alignas(64) std::int32_t back[kPaddedBlock]; // with `facing`: 1 where the eye sees the back
    alignas(64) float normal[3][3][kPaddedBlock], uv[2][3][kPaddedBlock];
    alignas(64) float colour[3][3][kPaddedBlock];
    alignas(64) float position[3][3][kPaddedBlock];
    // How u and v lie on it (footprint-inl.h).
    alignas(64) double uv_plane[10][kPaddedBlock];
};

// What the frame's triangles are made of.
struct TriangleSource {
    const std::uint32_t* index;         // three a triangle, in spatial order
    const std::uint32_t* spatial_index; // by triangle id; null: the same as the id
    const raster::ScreenVertex* vertex;
    const float *position, *normal, *uv, *colour; // of vertices; null where the mesh has none
    const DVec2* exact_uv;                        // null where the frame mixes floats
    double linear[3][3], translation[3], scale;   // to view space: (linear p + translation) scale
    bool perspective, mirrored;
    Sides sides;
    Attributes wanted;

    bool wants_facing() const { return sides == Sides::eye || wanted.facing || wanted.vertices; }
    bool wants_normal() const { return wanted.normal || (sides == Sides::eye && wanted.vertices); }
    bool wants_view_position() const { return wanted.position || wanted.vertices; }
    bool wants_position() const { return wants_view_position() || wants_facing(); }
};
TriangleSource triangle_source(const GatherInput& input);

// A block's items from `item` on get their triangles. number: of so many items' triangles in ids,
// from item to item the same or the next one. Reads up to a register behind the last of both.
void assign_triangles(const std::int32_t* number, const std::uint32_t* ids, int count,
                      ShadingSetup& triangles, int item);

// Of items first to first + count of a run, which lie at the centres of their pixels: sets up their
// triangles, and moves those items that their triangles do not cover there.
void set_up_run(const TriangleSource& source, ShadingSetup& triangles, ShadingBlock& block,
                int first, int count);

// A triangle's vertices, read in spatial order: coverage has just brought those of a tile into the
// cache, whereas the file may have them anywhere. The spatial index should be prefetched.
inline const std::uint32_t* vertices_of(const TriangleSource& s, std::uint32_t triangle) {
    return s.index +
           std::size_t{s.spatial_index == nullptr ? triangle : s.spatial_index[triangle]} * 3;
}
inline void prefetch_spatial_index(const TriangleSource& s, std::uint32_t triangle) {
    if (s.spatial_index != nullptr) __builtin_prefetch(s.spatial_index + triangle);
}

// Do all vertices stand on the screen? Else it is drawn clipped, which no item has.
inline bool is_unclipped(const TriangleSource& s, std::uint32_t triangle) {
    const std::uint32_t* v = vertices_of(s, triangle);
    return s.vertex[v[0]].on_screen() && s.vertex[v[1]].on_screen() && s.vertex[v[2]].on_screen();
}

} // namespace scanout::shade
