// A mesh cut by a plane: what lies in front of it goes, triangles that it crosses are cut in two,
// and where the surface is closed the cut is capped with faces, so that a solid stays one.
#pragma once

#include "base/jobs.h"
#include "geom/mesh.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace scanout::geom {

// The points p of the mesh's space with dot(normal, p) = offset. The normal is not 0, of any
// length.
struct SectionPlane {
    DVec3 normal{0, 0, 1};
    double offset = 0;
};

struct Section {
    Mesh mesh;
    std::size_t removed = 0;    // triangles in front of the plane
    std::size_t cut = 0;        // triangles cut in two
    std::size_t caps = 0;       // triangles made to cap the cut
    std::size_t edges = 0;      // of the cut
    std::size_t open_edges = 0; // of those, the ones in no closed outline: they have no cap
};

// Nothing where no vertex lies in front of the plane. Which side a vertex is on is found exactly;
// one on the plane bounds the part that is kept, and so does a face in the plane that looks to its
// front. Faces share the bits of the vertices on their edges, as they did before the cut, and caps
// share those of the faces. Normals, uv and colours are interpolated.
//
// Each component of the surface is capped by its own outlines: those wound the other way, of
// cavities, are holes of the outline around them. A cap has the material `cap_material`, is a face
// of its own, and white where vertices have colours. The mesh keeps the framing of the whole one.
std::optional<Section> cut_by_plane(Jobs& jobs, const Mesh& mesh, const SectionPlane& plane,
                                    std::int32_t cap_material);

} // namespace scanout::geom
