// The edges of a mesh's faces as line segments, each once: what is drawn over the shading to show
// how a model is built. Diagonals within a polygon of the file are no edges.
#pragma once

#include "geom/mesh.h"

#include <optional>

namespace scanout::geom {

// Appends to `lines` a segment for each edge, between vertices of its own, and the faces that the
// edge is part of (line_faces: of `mesh`; `lines` must have none before). Faces meet at an edge
// where their corners have equal positions, whatever their normals and uv. With a feature angle,
// edges alone are taken that do not have two faces, or whose two faces enclose more than this
// angle, given by its cosine; which way the file winds a face does not matter. In an order that
// depends on positions alone.
void add_edge_lines(const Mesh& mesh, std::optional<double> feature_cosine, Mesh& lines);

} // namespace scanout::geom
