// Seams that do not close: vertices within another face's open edge (T-vertices), and open vertices
// close to each other (cracks). Only open edges count: where two faces share an edge, no
// background can show between them, unless the two are one sheet, back to back.
#pragma once

#include "geom/diagnose/surface.h"

#include <cstdint>
#include <span>
#include <vector>

namespace scanout::geom {

struct TVertex {
    std::uint32_t corner; // the edge begins at this corner of the mesh
    std::uint32_t face;   // whose edge it is
    std::uint32_t place;  // lies within the edge
    double along;         // 0 to 1
    double distance;      // from the edge, of at()
    // An open edge at `place` runs along this one: two surfaces meet there. Else the vertex only
    // touches the edge.
    bool on_seam;
};

struct Crack {
    std::uint32_t place, other; // place < other
    std::uint32_t face;         // of an open edge at `place`
    double distance;            // of at()
};

struct Seams {
    std::vector<TVertex> t_vertices; // by corner, then along the edge
    std::vector<Crack> cracks;       // by place, other
    // So many open places lie near open edges that nothing is known: on a seam each place lies near
    // a few edges, but of a fan of needles every place lies near every edge. Both lists are empty.
    bool crowded = false;
};

// `tolerance`: a length of at(); see DiagnoseOptions. `may_be_open`: by corner, whether the edge
// that begins there may be open, where the surface is a part of a model; empty: each may.
Seams find_seams(const Surface& surface, double tolerance,
                 std::span<const std::uint8_t> may_be_open = {});

} // namespace scanout::geom
