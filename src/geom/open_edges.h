// The open edges of a PolygonMesh, found by hashes of places alone: in a fraction of the time and
// memory that a Surface takes, so that every model can be asked while it is loaded.
#pragma once

#include "base/jobs.h"
#include "geom/framing.h"
#include "geom/polygon_mesh.h"
#include "geom/usable.h"

#include <cstdint>
#include <vector>

namespace scanout::geom {

struct OpenEdge {
    std::uint32_t face, corner; // of the mesh: the edge begins there
    friend bool operator==(const OpenEdge&, const OpenEdge&) = default;
};

// odd: may leave out edges that are used an even number of times, those of a face and its turned
// twin. A closed model costs one pass then, and one with few open edges three.
enum class OpenEdgeSearch : std::uint8_t { complete, odd };

// Edges that one face alone uses, its repetitions and turned twins not counted, in the order of
// corners. Faces on one or two places do not count (geom/place.h). `framing`: of the mesh.
std::vector<OpenEdge> open_edges(Jobs& jobs, const PolygonMesh& mesh, const Usable& usable,
                                 const Framing& framing,
                                 OpenEdgeSearch search = OpenEdgeSearch::complete);

} // namespace scanout::geom
