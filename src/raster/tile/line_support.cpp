#include "raster/tile/line_support.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scanout::raster {

// By position: faces that share a position need not share the vertex.
bool LineSupport::has_vertex_at(std::uint32_t triangle, const Vec3& at) const {
    const std::uint32_t* index = mesh_->index.data() + std::size_t{triangle} * 3;
    return mesh_->position[index[0]] == at || mesh_->position[index[1]] == at ||
           mesh_->position[index[2]] == at;
}

// Does the point lie in the triangle's plane, up to the rounding of its floats? A coordinate
// stands for all numbers that round to it; the bound is how far these can move (p - a) . normal.
bool LineSupport::in_plane_of(std::uint32_t triangle, const Vec3& point) const {
    const std::uint32_t* index = mesh_->index.data() + std::size_t{triangle} * 3;
    const DVec3 a(mesh_->position[index[0]]), b(mesh_->position[index[1]]),
        c(mesh_->position[index[2]]), p(point);
    const auto size = [](const DVec3& v) {
        return DVec3(std::abs(v.x), std::abs(v.y), std::abs(v.z));
    };
    const auto larger = [](const DVec3& u, const DVec3& v) {
        return DVec3(std::max(u.x, v.x), std::max(u.y, v.y), std::max(u.z, v.z));
    };
    // Half a step of each axis' largest coordinate at both ends of a difference.
    const DVec3 error = larger(larger(size(a), size(b)), larger(size(c), size(p))) * 0x1p-23;
    const DVec3 e = b - a, f = c - a, d = p - a, normal = cross3(e, f), sum = size(e) + size(f);
    const DVec3 cross_error(sum.y * error.z + sum.z * error.y, sum.z * error.x + sum.x * error.z,
                            sum.x * error.y + sum.y * error.x);
    return std::abs(dot3(d, normal)) <= dot3(size(d), cross_error) + dot3(size(normal), error);
}

// Is the triangle part of one of these faces? They are given by their first triangles, ascending.
bool LineSupport::is_of(std::uint32_t triangle, std::span<const std::uint32_t> first) const {
    if (first.empty()) return false;
    const std::uint32_t face = mesh_->face[triangle];
    const auto found =
        std::lower_bound(first.begin(), first.end(), face,
                         [&](std::uint32_t t, std::uint32_t f) { return mesh_->face[t] < f; });
    return found != first.end() && mesh_->face[*found] == face;
}

LineSupport::Contact LineSupport::contact(std::uint32_t triangle, std::uint32_t primitive) const {
    if (mesh_ == nullptr) return Contact::none;
    const std::size_t line = primitive - first_line_;
    if (line >= lines_->lines()) {
        const std::uint32_t point = lines_->point_index[line - lines_->lines()];
        return in_plane_of(triangle, lines_->position[point]) ? Contact::holds : Contact::none;
    }
    const std::uint32_t* index = lines_->line_index.data() + line * 2;
    const std::array end = {lines_->position[index[0]], lines_->position[index[1]]};
    const std::span<const std::uint32_t> faces = lines_->line_faces.of(line); // first triangles
    if (is_of(triangle, faces) || (in_plane_of(triangle, end[0]) && in_plane_of(triangle, end[1])))
        return Contact::holds;
    const bool beside = std::any_of(faces.begin(), faces.end(), [&](std::uint32_t first) {
        return continues(triangle, first, end);
    });
    return beside ? Contact::beside : Contact::none;
}

namespace {

DVec3 position(const ClipVertex& v) {
    return {v.x, v.y, v.w};
}

// Six times the signed volume of triangle and eye: its sign is the winding on the screen where the
// triangle is visible, for all signs of w.
double winding(const std::array<ClipVertex, 3>& v) {
    return dot3(position(v[0]), cross3(position(v[1]), position(v[2])));
}

} // namespace

std::array<ClipVertex, 3> LineSupport::vertices_of(std::uint32_t triangle) const {
    std::array<ClipVertex, 3> out;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t vertex = mesh_->index[std::size_t{triangle} * 3 + i];
        const ScreenVertex& v = vertices_[vertex];
        out[i] = v.on_screen()
                     ? ClipVertex{v.x / double{kSubpixel}, v.y / double{kSubpixel}, v.depth, 1}
                     : transform_->to_clip(mesh_->position[vertex]);
    }
    return out;
}

// Do the triangle and a face, given by its first triangle, have the same winding and share a
// vertex? end: the ends of the line on the face. For a large polygon only the line's own ends are
// tested, not all its vertices.
bool LineSupport::continues(std::uint32_t triangle, std::uint32_t first,
                            const std::array<Vec3, 2>& end) const {
    constexpr std::uint32_t kMax = 8; // triangles of a face
    if ((winding(vertices_of(triangle)) > 0) != (winding(vertices_of(first)) > 0)) return false;
    if (has_vertex_at(triangle, end[0]) || has_vertex_at(triangle, end[1])) return true;
    bool meet = false;
    std::uint32_t t = first;
    for (; t < mesh_->triangles() && mesh_->face[t] == mesh_->face[first]; ++t) {
        if (t - first == kMax) return false;
        for (std::size_t k = 0; k < 3; ++k)
            meet = meet ||
                   has_vertex_at(triangle, mesh_->position[mesh_->index[std::size_t{t} * 3 + k]]);
    }
    return meet;
}

bool LineSupport::faces_are_culled(std::uint32_t segment) const {
    const std::span<const std::uint32_t> faces = lines_->line_faces.of(segment - first_line_);
    return !faces.empty() && std::all_of(faces.begin(), faces.end(), [&](std::uint32_t first) {
        const auto material = static_cast<std::size_t>(mesh_->material[first] + 1);
        return (one_sided_.empty() || one_sided_[material] != 0) &&
               (winding(vertices_of(first)) > 0) == (*hidden_ == Winding::clockwise);
    });
}

bool LineSupport::covers(std::uint32_t triangle, double x, double y) const {
    if (mesh_ == nullptr) return false;
    const std::array<ClipVertex, 3> v = vertices_of(triangle);
    const double whole = winding(v);
    const ClipVertex at{x, y, 0, 1};
    const double e[3] = {winding({at, v[1], v[2]}), winding({v[0], at, v[2]}),
                         winding({v[0], v[1], at})};
    return whole > 0 ? e[0] > 0 && e[1] > 0 && e[2] > 0 : e[0] < 0 && e[1] < 0 && e[2] < 0;
}

// depth = per_x x + per_y y + c at all three vertices, before the divide: Cramer's rule.
DepthSlope LineSupport::slope(std::uint32_t triangle) const {
    if (mesh_ == nullptr) return {};
    const std::array<ClipVertex, 3> v = vertices_of(triangle);
    std::array<ClipVertex, 3> x_replaced = v, y_replaced = v;
    DepthSlope out{0, 0, 1, 0};
    for (std::size_t i = 0; i < 3; ++i) {
        x_replaced[i].x = v[i].z;
        y_replaced[i].y = v[i].z;
        // A triangle that passes the near plane counts as no nearer than that plane.
        const double depth = v[i].w >= transform_->box.near_w ? v[i].z / v[i].w : 1;
        out.lowest = std::min(out.lowest, depth);
        out.highest = std::max(out.highest, depth);
    }
    const double whole = winding(v);
    const double per_x = winding(x_replaced) / whole, per_y = winding(y_replaced) / whole;
    if (!std::isfinite(per_x) || !std::isfinite(per_y)) return out;
    out.per_x = per_x;
    out.per_y = per_y;
    return out;
}

} // namespace scanout::raster
