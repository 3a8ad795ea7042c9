// Finds the faces on which a mesh's lines lie: faces that have both ends of a line among their
// corners, so the line is an edge or a diagonal.
#pragma once

#include "geom/mesh.h"

namespace scanout::geom {

// Fills mesh.line_faces from the mesh's other arrays. Corners and ends are the same place when
// their positions are equal, whatever their normals and uv. Time and memory grow linearly with the
// file, even for a fan about one hub with all its edges drawn.
void find_line_faces(Mesh& mesh);

} // namespace scanout::geom
