#include "geom/mend_seams.h"

#include "geom/diagnose/seams.h"
#include "geom/diagnose/surface.h"
#include "geom/open_edges.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanout::geom {
namespace {

// A corner between two others of a face: texture coordinate and normal are interpolated.
Corner corner_between(PolygonMesh& m, const Corner& a, const Corner& b, double along,
                      std::uint32_t position) {
    Corner corner;
    corner.position = static_cast<std::int32_t>(position);
    if (a.uv >= 0 && b.uv >= 0) {
        const DVec2 from = m.uvs[static_cast<std::size_t>(a.uv)];
        const DVec2 to = m.uvs[static_cast<std::size_t>(b.uv)];
        corner.uv = static_cast<std::int32_t>(m.uvs.size());
        m.uvs.push_back(from + along * (to - from));
    }
    if (a.normal >= 0 && b.normal >= 0) {
        if (a.normal == b.normal) {
            corner.normal = a.normal;
            return corner;
        }
        const DVec3 from(m.normals[static_cast<std::size_t>(a.normal)]);
        const DVec3 to(m.normals[static_cast<std::size_t>(b.normal)]);
        const DVec3 between = from + along * (to - from);
        const double length = std::sqrt(dot3(between, between));
        corner.normal = static_cast<std::int32_t>(m.normals.size());
        m.normals.push_back(Vec3(length > 0 ? between / length : between));
    }
    return corner;
}

// The faces at the open edges of a mesh, a mesh themselves. Holds the positions, texture
// coordinates and normals of the whole one while it lives.
class FacesAtOpenEdges {
public:
    FacesAtOpenEdges(PolygonMesh& whole, const std::vector<OpenEdge>& open) : whole_(whole) {
        for (const OpenEdge& edge : open) {
            if (faces_.empty() || faces_.back() != edge.face) add(edge.face);
            const std::size_t in_face = edge.corner - whole.face_begin[edge.face];
            open_[part_.face_begin.back() + in_face] = 1;
        }
        swap_arrays();
    }
    ~FacesAtOpenEdges() { swap_arrays(); }
    FacesAtOpenEdges(const FacesAtOpenEdges&) = delete;
    FacesAtOpenEdges& operator=(const FacesAtOpenEdges&) = delete;

    void split(Jobs& jobs, const Framing& framing, double tolerance, TVertices which,
               SplitEdges& out) {
        constexpr int kRounds = 8; // a new corner bends its edge a little, towards others
        for (int round = 0; round < kRounds && !out.crowded; ++round)
            if (!split_once(jobs, framing, tolerance, which, out)) return;
    }

    // Puts the faces back, with their new corners.
    void write_back() {
        std::vector<Corner> corners;
        corners.reserve(whole_.corners.size() + part_.corners.size());
        std::size_t next = 0; // of faces_
        std::vector<std::uint32_t> begins(whole_.faces());
        for (std::size_t f = 0; f < whole_.faces(); ++f) {
            begins[f] = static_cast<std::uint32_t>(corners.size());
            const bool is_part = next < faces_.size() && faces_[next] == f;
            const PolygonMesh& from = is_part ? part_ : whole_;
            const std::size_t face = is_part ? next++ : f;
            corners.insert(corners.end(), from.corners.begin() + from.face_begin[face],
                           from.corners.begin() + static_cast<std::ptrdiff_t>(from.face_end(face)));
        }
        whole_.corners = std::move(corners);
        whole_.face_begin = std::move(begins);
    }

private:
    void add(std::uint32_t face) {
        faces_.push_back(face);
        part_.face_begin.push_back(static_cast<std::uint32_t>(part_.corners.size()));
        part_.face_material.push_back(-1);
        for (std::size_t c = whole_.face_begin[face]; c < whole_.face_end(face); ++c)
            part_.corners.push_back(whole_.corners[c]);
        open_.resize(part_.corners.size());
    }

    void swap_arrays() {
        std::swap(part_.positions, whole_.positions);
        std::swap(part_.uvs, whole_.uvs);
        std::swap(part_.normals, whole_.normals);
    }

    bool split_once(Jobs& jobs, const Framing& framing, double tolerance, TVertices which,
                    SplitEdges& out) {
        const Surface surface(jobs, part_, &framing);
        Seams seams = find_seams(surface, tolerance * framing.radius, open_);
        out.crowded = seams.crowded;
        if (which == TVertices::seams)
            std::erase_if(seams.t_vertices, [](const TVertex& t) { return !t.on_seam; });
        if (seams.t_vertices.empty()) return false;
        std::vector<Corner> corners;
        std::vector<std::uint8_t> open;
        corners.reserve(part_.corners.size() + seams.t_vertices.size());
        open.reserve(corners.capacity());
        std::vector<std::uint32_t> begins(part_.faces());
        auto next = seams.t_vertices.begin();
        for (std::size_t f = 0; f < part_.faces(); ++f) {
            begins[f] = static_cast<std::uint32_t>(corners.size());
            for (std::size_t c = part_.face_begin[f]; c < part_.face_end(f); ++c) {
                corners.push_back(part_.corners[c]);
                open.push_back(open_[c]);
                for (; next != seams.t_vertices.end() && next->corner == c; ++next) {
                    corners.push_back(corner_between(
                        part_, part_.corners[c], part_.corners[surface.next_corner(f, c)],
                        next->along, surface.position_of(next->place)));
                    open.push_back(open_[c]);
                    out.farthest = std::max(out.farthest, next->distance * surface.unit());
                }
            }
        }
        out.corners += seams.t_vertices.size();
        part_.corners = std::move(corners);
        part_.face_begin = std::move(begins);
        open_ = std::move(open);
        return true;
    }

    PolygonMesh& whole_;
    PolygonMesh part_;
    std::vector<std::uint32_t> faces_; // of the whole mesh
    std::vector<std::uint8_t> open_;   // by corner of the part
};

} // namespace

SplitEdges split_t_vertices(Jobs& jobs, PolygonMesh& mesh, double tolerance, TVertices which) {
    SplitEdges out;
    const Usable usable(jobs, mesh);
    const Framing framing = framing_of(jobs, mesh.positions, usable.position);
    const std::vector<OpenEdge> open =
        open_edges(jobs, mesh, usable, framing,
                   which == TVertices::seams ? OpenEdgeSearch::odd : OpenEdgeSearch::complete);
    if (open.empty()) return out;
    if (which == TVertices::seams && open.size() > kMostOpenEdges) {
        out.unsearched = open.size();
        return out;
    }
    FacesAtOpenEdges faces(mesh, open);
    faces.split(jobs, framing, tolerance, which, out);
    if (out.crowded && out.corners == 0) out.unsearched = open.size();
    if (out.corners > 0) faces.write_back();
    return out;
}

} // namespace scanout::geom
