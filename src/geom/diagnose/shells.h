// The shells of a surface: faces that are connected by edges, and whether they are closed, wound
// alike, and inside out.
#pragma once

#include "geom/diagnose/surface.h"
#include "geom/topology.h"

#include <cstdint>
#include <vector>

namespace scanout::geom {

struct Shell {
    std::uint32_t first_face = 0;
    std::size_t faces = 0, triangles = 0;
    bool closed = true;   // each edge has two uses
    bool alike = true;    // ... in opposite directions
    double volume = 0;    // six times, about a point of its own, of at()
    Box box;              // of at()
    bool flipped = false; // closed, wound alike, of negative volume, and no cavity
};

struct Shells {
    std::vector<std::uint32_t> of_face; // kNoPlace of faces that cannot be drawn
    std::vector<Shell> shells;          // by their first face
};

// A closed shell within the box of another one may be a cavity, which is wound inwards: it is not
// called flipped.
Shells find_shells(const Surface& surface);

} // namespace scanout::geom
