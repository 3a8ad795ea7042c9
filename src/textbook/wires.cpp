#include "textbook/wires.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

namespace scanout::textbook {
namespace {

using Place = std::array<float, 3>;
using Ends = std::pair<Place, Place>; // the lesser one first

// By places: where faces meet in a crease or a seam, each has vertices of its own.
Ends ends_of(const Vec3& a, const Vec3& b) {
    const Place from = {a.x, a.y, a.z}, to = {b.x, b.y, b.z};
    return std::minmax(from, to);
}

// Against the clock on the screen, without a division: right for what lies before the eye of a
// face that passes it (Olano and Greer 1997).
bool is_front(const std::array<Vertex, 3>& t, bool mirrored) {
    const auto row = [](const Vertex& v) { return DVec3(v.clip.x, v.clip.y, v.clip.w); };
    return (dot3(row(t[0]), cross3(row(t[1]), row(t[2]))) > 0) != mirrored;
}

std::optional<Wire> wire_between(const Vertex& a, const Vertex& b, const Projection& projection,
                                 const scene::View& view, const Look& look, std::uint32_t source) {
    // Near and far; from one end to the other: two ends are left, or none.
    Vertex from = a, to = b;
    const auto cut_by = [&](auto distance) {
        const double at_from = distance(from), at_to = distance(to);
        if (at_from < 0 && at_to < 0) return false;
        if ((at_from < 0) == (at_to < 0)) return true;
        (at_from < 0 ? from : to) = mix(from, to, at_from / (at_from - at_to));
        return true;
    };
    const Plane near = projection.near_plane();
    constexpr std::size_t z = kPlace + 2;
    if (!cut_by([&](const Vertex& v) { return near.distance(v.clip); }) ||
        !cut_by(
            [&](const Vertex& v) { return -v.values[z] - std::max(view.cut_near, -0x1p900); }) ||
        !cut_by([&](const Vertex& v) { return std::min(view.cut_far, 0x1p900) + v.values[z]; }))
        return std::nullopt;
    const auto point = [&](const Vertex& v) {
        const Corner c = projection.on_screen(v, look.width, look.height);
        return DVec2(c.x - 0.5, c.y - 0.5);
    };
    const Wire wire{point(from), point(to), source};
    const auto is_finite = [](const DVec2& p) { return std::isfinite(p.x) && std::isfinite(p.y); };
    return is_finite(wire.from) && is_finite(wire.to) ? std::optional(wire) : std::nullopt;
}

} // namespace

std::vector<Wire> wires_of(const geom::Mesh& mesh, const scene::View& view, const Look& look,
                           const Parts& parts) {
    const Projection projection = projection_of(mesh, view, parts);
    std::vector<Wire> wires;
    std::set<Ends> drawn;
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        std::array<Vec3, 3> place;
        std::array<Vertex, 3> corner;
        for (std::size_t k = 0; k < 3; ++k) {
            place[k] = mesh.position[mesh.index[3 * t + k]];
            const DVec3 at = in_view(view, place[k]);
            corner[k].clip = projection.clip_of(at);
            corner[k].values[kPlace + 2] = at.z;
        }
        if (!shows(is_front(corner, view.mirrored), look, mesh.material[t])) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            if (!drawn.insert(ends_of(place[k], place[next])).second) continue;
            if (const auto wire = wire_between(corner[k], corner[next], projection, view, look,
                                               static_cast<std::uint32_t>(t)))
                wires.push_back(*wire);
        }
    }
    return wires;
}

} // namespace scanout::textbook
