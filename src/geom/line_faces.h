// Which faces a mesh's lines lie on: those that have both of its ends among their corners, so its
// edges and its diagonals.
#pragma once

#include "geom/mesh.h"

namespace scanout::geom {

// Fills mesh.line_faces from what else the mesh holds. Corners and ends are the same place when
// their positions are equal, whatever normals and uvs stand there. Time and memory grow with the
// file, not with its square: a fan about one hub, all its edges drawn, included.
void find_line_faces(Mesh& mesh);

} // namespace scanout::geom
