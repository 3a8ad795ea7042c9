// The surface of a PolygonMesh as the diagnosis reads it: places (geom/place.h), the edges of its
// faces, and their triangles. Faces that cannot be drawn are left out.
#pragma once

#include "base/jobs.h"
#include "geom/diagnose/same_faces.h"
#include "geom/framing.h"
#include "geom/polygon_mesh.h"
#include "geom/usable.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::geom {

inline constexpr std::uint32_t kNoPlace = 0xffffffff;

class Surface {
public:
    struct Triangle {
        std::array<std::uint32_t, 3> place;
        std::uint32_t face;
    };
    // A face's edge from a corner to the next one.
    struct EdgeUse {
        std::uint32_t low, high; // places, low < high
        std::uint32_t corner;    // of the mesh: where the edge begins
        std::uint32_t face;
        bool forward; // from low to high
    };

    // Keeps a reference to the mesh, whose indices must lie within its arrays. `framing`: of the
    // model, where the mesh is a part of it.
    Surface(Jobs& jobs, const PolygonMesh& mesh, const Framing* framing = nullptr);

    const PolygonMesh& mesh() const { return mesh_; }
    const Usable& usable() const { return usable_; }
    const Framing& framing() const { return framing_; }
    Jobs& jobs() const { return jobs_; }

    std::size_t places() const { return at_.size(); }
    // The file's coordinates of the first position there, times 2^-exponent of the framing: exact
    // but for denormals. The radius of the model is 0.5 to 1.
    const DVec3& at(std::uint32_t place) const { return at_[place]; }
    double unit() const; // file units in a length of 1
    std::uint32_t place_of(std::size_t position) const { return place_[position]; }
    std::uint32_t position_of(std::uint32_t place) const { return position_[place]; } // the first
    const std::vector<Triangle>& triangles() const { return triangles_; }
    // Can be drawn, and some of its triangles has an area.
    bool has_area(std::size_t face) const { return has_area_[face]; }
    const std::vector<bool>& faces_with_area() const { return has_area_; }
    // By face. A face is turned only where no earlier one repeats it.
    const std::vector<SameFace>& same_faces() const { return same_faces_; }
    // Sorted by low, high, face. Left out: those whose ends are one place, and those of faces that
    // repeat others or stand on two places.
    const std::vector<EdgeUse>& edges() const { return edges_; }
    // Calls visit(uses) for each edge, with all its uses.
    template <class Visit>
    void for_each_edge(Visit&& visit) const {
        for (std::size_t begin = 0, end = 0; begin < edges_.size(); begin = end) {
            while (end < edges_.size() && edges_[end].low == edges_[begin].low &&
                   edges_[end].high == edges_[begin].high)
                ++end;
            visit(std::span(edges_).subspan(begin, end - begin));
        }
    }
    std::uint32_t corner_place(std::size_t corner) const {
        return place_[static_cast<std::size_t>(mesh_.corners[corner].position)];
    }
    // The corner behind it in its face.
    std::size_t next_corner(std::size_t face, std::size_t corner) const {
        return corner + 1 < mesh_.face_end(face) ? corner + 1 : mesh_.face_begin[face];
    }
    bool has_corner_at(std::size_t face, std::uint32_t place) const;
    DVec3 normal(std::size_t face) const; // Newell's, twice the area, of at()

private:
    void find_places();
    void find_triangles();
    bool stands_on_two_places(std::size_t face) const; // or on one
    void find_areas();
    void find_edges();

    Jobs& jobs_;
    const PolygonMesh& mesh_;
    Usable usable_;
    Framing framing_;
    std::vector<std::uint32_t> place_, position_;
    std::vector<DVec3> at_;
    std::vector<Triangle> triangles_;
    std::vector<bool> has_area_;
    std::vector<SameFace> same_faces_;
    std::vector<EdgeUse> edges_;
};

} // namespace scanout::geom
