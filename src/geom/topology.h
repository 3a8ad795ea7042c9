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

// A connected component is what hangs together by vertices at one place; places within 2^-22 of
// each other are one. It is closed where every edge is used as often in one direction as in the
// other, and nothing lets light through: from outside, the backs of its faces lie behind their
// fronts.
struct MeshTopology {
    static constexpr std::size_t kMaxBoxes = 64, kMaxConvex = 16;

    bool closed = false;        // all components are
    std::size_t inside_out = 0; // triangles of closed components that hold no volume, or less
    bool back_to_back = false; // faces at one place look in opposite directions: either may be seen
    // Triangles with a normal that does not lie clearly on the side from which they wind counter-
    // clockwise; those without an area, too, but for collapsed ones.
    std::size_t leaning_normals = 0;
    bool flat = false; // all triangles lie in one plane
    // Where no component throws a shadow on itself, the components' boxes: each lies in one plane,
    // or is closed, wound outwards, and nothing of it rises above any of its (few) planes. None of
    // many components.
    std::vector<Box> convex_components;
    // Of a flat mesh and of convex components: triangles with a normal that is not the face's own.
    // These normals let light show on faces that turn away from it.
    std::size_t smooth_triangles = 0;
    std::size_t open_triangles = 0; // of the other components
    PlaneSet open_planes;           // in which those lie: before all of them no back is seen
    // Of the closed components; the last is of all that come after it, too.
    std::vector<Box> closed_boxes;

    // From outside of every component the backs lie behind fronts, all of them; but for components
    // that pass through themselves and so turn some of their inside out, which is not looked for.
    bool fronts_hide_backs() const { return closed && inside_out == 0 && !back_to_back; }
};
// Two of the triangle's corners stand at one place: it is never drawn.
bool is_collapsed(const Mesh& mesh, std::size_t triangle);
// lets_through: for each triangle; empty where none does.
MeshTopology topology(const Mesh& mesh, const std::vector<bool>& lets_through = {});

} // namespace scanout::geom
