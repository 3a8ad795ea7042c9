// Mends what can be mended in a PolygonMesh without a guess. No vertex moves by what a float can
// tell, and every picture of what was right stays: positions that are drawn as one vertex become
// one (unless their colours differ), positions that nothing uses go, faces without an area and
// repeated faces go, T-vertices become corners of the faces on whose edges they lie, and faces are
// turned so that each shell is wound alike; closed ones outwards.
#pragma once

#include "base/jobs.h"
#include "geom/polygon_mesh.h"

#include <cstddef>
#include <functional>

namespace scanout::geom {

struct Mended {
    std::size_t welded = 0;     // positions that were equal to others
    std::size_t unused = 0;     // positions that nothing uses, or that are not finite
    std::size_t degenerate = 0; // faces without an area, or with a corner that is not finite
    std::size_t repeated = 0;   // faces
    std::size_t split = 0;      // corners put into edges
    std::size_t turned = 0;     // faces
    std::size_t one_sided = 0;  // shells that cannot be wound alike (as a Moebius strip)
    bool any() const { return welded + unused + degenerate + repeated + split + turned > 0; }
};

// `tolerance`: of T-vertices, in bounding radii (DiagnoseOptions). Indices must lie within the
// mesh's arrays. Texture coordinates and normals of a new corner are interpolated along its edge.
// `progress` hears the share of the steps that is done; empty: nobody does.
Mended mend(Jobs& jobs, PolygonMesh& mesh, double tolerance,
            const std::function<void(double share)>& progress = {});

} // namespace scanout::geom
