// The topology of a mesh: its connected components, whether they are closed (watertight, manifold
// or not) and wound outwards, flat or convex. Gathered once from its triangles.
#pragma once

#include "geom/mesh.h"
#include "geom/planes.h"

#include <cstddef>
#include <vector>

namespace scanout::geom {

struct Box {
    DVec3 low{0}, high{0};
};

// A connected component is a set of triangles connected by vertices at one place; places within
// 2^-22 of each other are one. It is closed where every edge is used as often in one direction as
// in the other, and nothing is translucent: from outside, the backs of its faces lie behind their
// fronts.
struct MeshTopology {
    static constexpr std::size_t kMaxBoxes = 64, kMaxConvex = 16;

    bool closed = false;        // all components are closed
    std::size_t inside_out = 0; // triangles of closed components whose volume is 0 or less
    bool back_to_back = false; // faces at one place look in opposite directions: either may be seen
    // Triangles whose steepest normal, the one nearest to their own, does not clearly point to the
    // side from which they wind counter-clockwise. Those without an area count, unless collapsed.
    std::size_t reversed_triangles = 0;
    bool flat = false; // all triangles lie in one plane
    // If no component casts a shadow on itself, the boxes of the components: each lies in one
    // plane, or is closed, wound outwards, and no part of it rises above any of its planes.
    // Empty for many components, or many planes.
    std::vector<Box> convex_components;
    // In a flat mesh and in convex components: triangles with a normal other than the face's own.
    // Such normals let light show on faces that turn away from it.
    std::size_t smooth_triangles = 0;
    std::size_t open_triangles = 0; // of components that are not closed
    PlaneSet open_planes;           // their planes: an eye in front of all of them sees no back
    // Boxes of the closed components; the last one also holds all further components.
    std::vector<Box> closed_boxes;

    // From outside of every component all back faces lie behind front faces. Not tested: components
    // that intersect themselves and so turn a part inside out.
    bool fronts_hide_backs() const { return closed && inside_out == 0 && !back_to_back; }
};
// Two of the triangle's corners stand at one place: it is never drawn.
bool is_collapsed(const Mesh& mesh, std::size_t triangle);
// lets_through: for each triangle; empty where none does.
MeshTopology topology(const Mesh& mesh, const std::vector<bool>& lets_through = {});

} // namespace scanout::geom
