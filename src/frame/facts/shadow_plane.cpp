#include "frame/facts/shadow_plane.h"

#include "base/check.h"
#include "math/bits.h"
#include "math/transcendental.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace scanout::frame {
namespace {

constexpr double kInPlane = 0x1p-16; // bounding radii: so far off is still in the plane

bool lies_in(const Vec3& position, const ShadowPlane& plane) {
    return std::abs(dot3(plane.normal, DVec3(position)) - plane.offset) <= kInPlane;
}
bool lies_in(const geom::Mesh& mesh, std::size_t triangle, const ShadowPlane& plane) {
    const std::uint32_t* v = &mesh.index[triangle * 3];
    return std::all_of(v, v + 3,
                       [&](std::uint32_t corner) { return lies_in(mesh.position[corner], plane); });
}

} // namespace

ShadowPlane find_shadow_plane(const geom::Mesh& mesh) {
    Vec3 low(INFINITY), high(-INFINITY);
    for (const std::uint32_t v : mesh.index) {
        for (int c = 0; c < 3; ++c) {
            low[c] = std::min(low[c], mesh.position[v][c]);
            high[c] = std::max(high[c], mesh.position[v][c]);
        }
    }
    // Of sides with equal areas, the first wins: the floor where y is up, then the floor where z is
    // up.
    std::array<ShadowPlane, 6> sides;
    std::array<std::int64_t, 6> area{}; // whole numbers: no order of triangles changes the sum
    for (std::size_t k = 0; k < 6; ++k) {
        const int axis = std::array{1, 2, 0}[k % 3];
        sides[k].normal[axis] = 1;
        sides[k].offset = k > 2 ? high[axis] : low[axis];
    }
    const DVec3 size = DVec3(high) - DVec3(low);
    const double extent = std::max({size.x, size.y, size.z});
    if (!(extent > 0)) return {};
    // A bit mask for each vertex: the sides in which it lies. Few vertices lie in any.
    std::vector<std::uint8_t> lies(mesh.position.size(), 0);
    for (std::size_t v = 0; v < lies.size(); ++v)
        for (std::size_t k = 0; k < 6; ++k)
            if (lies_in(mesh.position[v], sides[k])) lies[v] |= 1U << k;
    for (std::size_t i = 0; i < mesh.triangles(); ++i) {
        const std::uint32_t* v = &mesh.index[i * 3];
        for (unsigned rest = lies[v[0]] & lies[v[1]] & lies[v[2]]; rest != 0; rest &= rest - 1) {
            const auto k = static_cast<std::size_t>(std::countr_zero(rest));
            const DVec3 a(mesh.position[v[0]]), b(mesh.position[v[1]]), c(mesh.position[v[2]]);
            const double share =
                std::abs(dot3(cross3((b - a) / extent, (c - a) / extent), sides[k].normal));
            area[k] += static_cast<std::int64_t>(share * 0x1p30); // at most 1: 2^32 triangles fit
            ++sides[k].triangles;
        }
    }
    const auto best = std::max_element(area.begin(), area.end());
    return *best > 0 ? sides[static_cast<std::size_t>(best - area.begin())] : ShadowPlane();
}

ShadowPlane find_shadow_plane(const geom::Mesh& mesh, const FilePlane& by_user) {
    const DVec3& n = by_user.normal;
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    CHECK(largest > 0);
    const DVec3 shorter = n / largest; // squares of any normal are numbers
    const double length = sqrt(dot3(shorter, shorter));
    ShadowPlane plane;
    plane.normal = shorter / length;
    // The offset from the model's centre, in the mesh's units.
    plane.offset =
        scale(by_user.offset / largest / length - dot3(plane.normal, mesh.centre), -mesh.exponent);
    plane.by_user = true;
    for (std::size_t i = 0; i < mesh.triangles(); ++i)
        plane.triangles += lies_in(mesh, i, plane) ? 1 : 0;
    return plane;
}

std::vector<std::uint8_t> in_shadow_plane(const geom::Mesh& mesh, const ShadowPlane& plane) {
    std::vector<std::uint8_t> in(mesh.triangles(), 0);
    for (std::size_t i = 0; i < in.size() && plane.triangles > 0; ++i)
        in[i] = lies_in(mesh, i, plane) ? 1 : 0;
    return in;
}

} // namespace scanout::frame
