#include "textbook/assemble.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace scanout::textbook {
namespace {

// From near to beyond the farthest vertex: pseudo-depth wants a far plane, and nothing is lost.
std::pair<double, double> near_and_far(const geom::Mesh& mesh, const scene::View& view) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Vec3& position : mesh.position) {
        const double distance = -in_view(view, position).z;
        least = std::min(least, distance);
        most = std::max(most, distance);
    }
    const bool perspective = view.projection == scene::Projection::perspective;
    const double n = perspective ? view.near_distance : std::max(least, view.cut_near);
    const double f =
        std::max(most, n) + (std::max(most, n) - n) * 0x1p-20 + view.near_distance + 0x1p-30;
    return {n, std::min(f, view.cut_far)};
}

Vertex vertex_of(const geom::Mesh& mesh, const scene::View& view, const Projection& projection,
                 std::uint32_t i) {
    Vertex v;
    const DVec3 place = in_view(view, mesh.position[i]);
    v.clip = projection.clip_of(place);
    const DVec3 normal = view.normal * DVec3(mesh.normal[i]);
    const DVec2 uv = mesh.uv.empty() ? DVec2(0) : mesh.uv_of(i);
    const DVec3 colour = mesh.colour.empty() ? DVec3(1) : DVec3(mesh.colour[i]);
    v.values = {place.x, place.y, place.z,  normal.x, normal.y, normal.z,
                uv.x,    uv.y,    colour.x, colour.y, colour.z};
    return v;
}

DVec3 part(const Vertex& v, std::size_t first) {
    return {v.values[first], v.values[first + 1], v.values[first + 2]};
}

// By the distance from the eye's plane, which is linear in all that a vertex has: what the caller
// cuts off, whichever way the rest is cut.
Polygon between_cuts(Polygon polygon, const scene::View& view) {
    constexpr std::size_t z = kPlace + 2;
    if (std::isfinite(view.cut_near))
        polygon =
            clip_by_side(polygon, [&](const Vertex& v) { return -v.values[z] - view.cut_near; });
    if (std::isfinite(view.cut_far))
        polygon =
            clip_by_side(polygon, [&](const Vertex& v) { return view.cut_far + v.values[z]; });
    return polygon;
}

// All normals of a face together, to the side that the eye sees.
void turn_to_eye(std::array<Vertex, 3>& t, bool perspective) {
    const DVec3 at = part(t[0], kPlace);
    const DVec3 face = cross3(part(t[1], kPlace) - at, part(t[2], kPlace) - at);
    const double faces_eye = perspective ? -dot3(face, at) : face.z;
    double least = 0, most = 0;
    for (const Vertex& v : t) {
        least = std::min(least, dot3(part(v, kNormal), face));
        most = std::max(most, dot3(part(v, kNormal), face));
    }
    if ((faces_eye < 0) == (least + most < 0)) return;
    for (Vertex& v : t)
        for (std::size_t i = kNormal; i < kNormal + 3; ++i)
            v.values[i] = -v.values[i];
}

// One face's way through the pipeline: cut, divide, cut on the screen, and keep what shows.
class Assembler {
public:
    Assembler(const geom::Mesh& mesh, const Projection& projection, const Look& look, Clip clip,
              bool mirrored)
        : mesh_(mesh), projection_(projection), planes_(projection.planes()), look_(look),
          clip_(clip), mirrored_(mirrored) {}

    void add(const std::array<Vertex, 3>& t, std::uint32_t source,
             std::vector<Triangle>& out) const {
        const auto divided = [&](const std::array<Vertex, 3>& part_of_it) {
            const auto corner = [&](std::size_t i) {
                return projection_.on_screen(part_of_it[i], look_.width, look_.height);
            };
            keep({{corner(0), corner(1), corner(2)}, source}, out);
        };
        if (clip_ == Clip::six_planes) {
            for_each_of_fan(clip_six_planes({t.begin(), t.end()}, planes_), divided);
        } else if (clip_ == Clip::four_cases) {
            std::vector<std::array<Vertex, 3>> parts = {t};
            for (const Plane& plane : planes_) {
                std::vector<std::array<Vertex, 3>> next;
                for (const auto& piece : parts)
                    for (const auto& cut : clip_four_cases(piece, plane))
                        next.push_back(cut);
                parts = std::move(next);
            }
            for (const auto& piece : parts)
                divided(piece);
        } else {
            on_the_screen(clip_by_plane({t.begin(), t.end()}, projection_.near_plane()), source,
                          out);
        }
    }

private:
    // Only what lies behind the eye is cut before the division.
    void on_the_screen(const Polygon& polygon, std::uint32_t source,
                       std::vector<Triangle>& out) const {
        const double w = look_.width, h = look_.height;
        std::vector<Corner> corners;
        for (const Vertex& v : polygon)
            corners.push_back(projection_.on_screen(v, look_.width, look_.height));
        corners = clip_sutherland_hodgman(std::move(corners), {{0, 0}, {w, 0}, {w, h}, {0, h}});
        for (std::size_t i = 1; i + 1 < corners.size(); ++i)
            keep({{corners[0], corners[i], corners[i + 1]}, source}, out);
    }

    // [Compendium 9.3]: the sign of the area says which side shows. Files are wound against the
    // clock in front.
    void keep(const Triangle& t, std::vector<Triangle>& out) const {
        const Points p = points_of(t);
        const double area = twice_area(p[0], p[1], p[2]); // above 0: clockwise
        const bool front = (area < 0) != mirrored_;
        if (area != 0 && shows(front, look_, mesh_.material[t.source])) out.push_back(t);
    }

    const geom::Mesh& mesh_;
    const Projection& projection_;
    std::vector<Plane> planes_;
    const Look& look_;
    Clip clip_;
    bool mirrored_;
};

} // namespace

Projection projection_of(const geom::Mesh& mesh, const scene::View& view, const Parts& parts) {
    const auto [n, f] = near_and_far(mesh, view);
    return {view, parts, n, f};
}

std::vector<Triangle> assemble(const geom::Mesh& mesh, const scene::View& view, const Look& look,
                               const Parts& parts) {
    const Projection projection = projection_of(mesh, view, parts);
    const Assembler assembler(mesh, projection, look, parts.clip, view.mirrored);
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        std::array<Vertex, 3> corners;
        for (std::size_t k = 0; k < 3; ++k)
            corners[k] = vertex_of(mesh, view, projection, mesh.index[3 * t + k]);
        if (look.two_sided) turn_to_eye(corners, view.projection == scene::Projection::perspective);
        for_each_of_fan(between_cuts({corners.begin(), corners.end()}, view),
                        [&](const std::array<Vertex, 3>& part_of_it) {
                            assembler.add(part_of_it, static_cast<std::uint32_t>(t), triangles);
                        });
    }
    return triangles;
}

} // namespace scanout::textbook
