// The set-up of clipped triangles for shading, one by one: few triangles are clipped. Unclipped
// ones are set up side by side (triangle_setup-inl.h).
#pragma once

#include "math/vec.h"
#include "raster/clipped/clipped_triangle.h"
#include "shade/stage.h"

#include <cstdint>

namespace scanout::shade {

struct GatherInput;

// From the very points that are drawn: where a vertex has snapped to, its attributes stand; those
// of a cut are the only ones that are computed. primitive: its id is set; all is set but `clipped`,
// `across` and `step`.
void set_up_clipped(const GatherInput& input, const raster::ClippedTriangle& clipped,
                    Primitive& primitive);

// A vertex's normal for light at vertices or faces: unit, in view space. own: the mesh's, on the
// side that the frame's `sides` choose.
DVec3 vertex_normal(const FrameState& frame, const DVec3& own);

// The component of a vertex's attribute: [component][vertex].
inline void set_attribute(float (&attribute)[3][3], std::size_t vertex, const DVec3& value) {
    for (int c = 0; c < 3; ++c)
        attribute[c][vertex] = static_cast<float>(value[c]);
}

// Never outside the range of its ends.
float between(double from, double to, double t);

} // namespace scanout::shade
