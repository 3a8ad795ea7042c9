// Lines and points that measure a mesh: its bounding box, a grid on the ground,
// its axes, its vertices and their normals. Lengths are in the file's unit and
// round: 1, 2 or 5 times a power of ten.
#pragma once

#include "geom/mesh.h"

namespace scanout::geom {

// The largest 1, 2 or 5 times a power of ten that is no more than x > 0.
double round_step(double x);
// The side of the grid's squares for a box of this size: 8 to 20 go along its
// longest side.
double grid_spacing(const DVec3& box_size);
inline constexpr double kNormalLength = 1.0 / 16; // of a line along a normal, bounding radii

// A direction along an axis of the file.
struct AxisDirection {
    int axis;  // 0 x, 1 y, 2 z
    bool down; // towards lower coordinates
};

// Each appends to `out`, which has vertices of its own; its line_faces must be
// empty.
void add_box_lines(const Mesh& mesh, Mesh& out);
// The plane is the lowest of the box. Lines stand at whole multiples of the
// spacing, and go past the box by two squares or more on each side.
void add_grid_lines(const Mesh& mesh, const AxisDirection& up, Mesh& out);
void add_axis_line(const Mesh& mesh, int axis, Mesh& out);
void add_normal_lines(const Mesh& mesh,
                      Mesh& out); // of each position and normal of a face once
void add_vertex_points(const Mesh& mesh,
                       Mesh& out); // each position of a face once

} // namespace scanout::geom
