// Can the back of a face be seen? Facts about a mesh's winding and normals, gathered once from its
// triangles, and what they say of a view, without drawing it.
#pragma once

#include "frame/planes.h"
#include "geom/mesh.h"
#include "scene/view.h"

#include <cstddef>
#include <vector>

namespace scanout::frame {

struct Box {
    DVec3 low{0}, high{0};
};

// A part is what hangs together by vertices at one place; places within 2^-22 of each other are
// one. It is closed where every edge is used as often in one direction as in the other, and nothing
// lets light through: from outside, the backs of its faces lie behind their fronts.
struct MeshSides {
    static constexpr std::size_t kMostBoxes = 64, kMostBodies = 16;

    bool closed = false;       // all parts are
    std::size_t inward = 0;    // triangles of closed parts that hold no volume, or less: inside out
    bool back_to_back = false; // faces at one place look in opposite directions: either may be seen
    // Triangles with a normal that does not lie clearly on the side from which they wind counter-
    // clockwise; those without an area, too, but for collapsed ones.
    std::size_t leaning = 0;
    bool flat = false; // all triangles lie in one plane
    // Where no part throws a shadow on itself, the parts' boxes: each lies in one plane, or is
    // closed, wound outwards, and nothing of it rises above any of its (few) planes. None of many
    // parts.
    std::vector<Box> bodies;
    std::size_t open = 0;          // triangles of the other parts
    PlaneSet open_planes;          // in which those lie: before all of them no back is seen
    std::vector<Box> closed_boxes; // of the closed parts; the last of all that come after it, too

    // From outside of every part the backs lie behind fronts, all of them; but for parts that pass
    // through themselves and so turn some of their inside out, which is not looked for.
    bool fronts_hide_backs() const { return closed && inward == 0 && !back_to_back; }
};
// Two of the triangle's corners stand at one place: it is never drawn.
bool is_collapsed(const geom::Mesh& mesh, std::size_t triangle);
// lets_through: for each triangle; empty where none does.
MeshSides mesh_sides(const geom::Mesh& mesh, const std::vector<bool>& lets_through = {});

// Whether the eye may be inside of a closed part; not in a view that is not known.
bool may_be_inside(const MeshSides& sides, const scene::View& view);
// What of a mesh may show its back in a view. That other triangles hide it all is not known before
// they are drawn.
enum class Backs : std::uint8_t { none, of_open_parts, from_inside };
Backs backs_in_view(const MeshSides& sides, const scene::View& view);
// Of each triangle: it turns its back to the eye, whatever hides it.
std::vector<bool> turned_away(const geom::Mesh& mesh, const scene::View& view);

} // namespace scanout::frame
