#include "geom/diagnose/shells.h"

#include "geom/disjoint_sets.h"

#include <algorithm>

namespace scanout::geom {
namespace {

void grow(Box& box, const DVec3& p) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
}

bool within(const Box& inner, const Box& outer) {
    return inner.low.x >= outer.low.x && inner.low.y >= outer.low.y && inner.low.z >= outer.low.z &&
           inner.high.x <= outer.high.x && inner.high.y <= outer.high.y &&
           inner.high.z <= outer.high.z;
}

void number_shells(const Surface& surface, Shells& out) {
    const PolygonMesh& m = surface.mesh();
    DisjointSets sets(m.faces());
    surface.for_each_edge([&](std::span<const Surface::EdgeUse> uses) {
        for (std::size_t i = 1; i < uses.size(); ++i)
            sets.join(uses[0].face, uses[i].face);
    });
    out.of_face.assign(m.faces(), kNoPlace);
    for (std::uint32_t f = 0; f < m.faces(); ++f) {
        if (!surface.usable().face[f]) continue;
        const std::uint32_t root = sets.root(f); // the lowest: it has its number already
        if (root == f) {
            const DVec3 p = surface.at(surface.corner_place(m.face_begin[f]));
            out.of_face[f] = static_cast<std::uint32_t>(out.shells.size());
            out.shells.push_back({.first_face = f, .box = {p, p}});
        } else {
            out.of_face[f] = out.of_face[root];
        }
        ++out.shells[out.of_face[f]].faces;
    }
}

void measure_volumes(const Surface& surface, Shells& out) {
    const PolygonMesh& m = surface.mesh();
    for (const Surface::Triangle& t : surface.triangles()) {
        Shell& shell = out.shells[out.of_face[t.face]];
        const DVec3 origin = surface.at(surface.corner_place(m.face_begin[shell.first_face]));
        const DVec3 a = surface.at(t.place[0]), b = surface.at(t.place[1]),
                    c = surface.at(t.place[2]);
        shell.volume += dot3(a - origin, cross3(b - origin, c - origin));
        ++shell.triangles;
        for (const DVec3& p : {a, b, c})
            grow(shell.box, p);
    }
}

} // namespace

Shells find_shells(const Surface& surface) {
    Shells out;
    number_shells(surface, out);
    measure_volumes(surface, out);
    surface.for_each_edge([&](std::span<const Surface::EdgeUse> uses) {
        Shell& shell = out.shells[out.of_face[uses[0].face]];
        if (uses.size() != 2) shell.closed = false;
        if (uses.size() == 2 && uses[0].forward == uses[1].forward) shell.alike = false;
    });
    std::vector<Shell*> by_size;
    for (Shell& shell : out.shells)
        if (shell.closed) by_size.push_back(&shell);
    // Only some of the largest may be what holds a cavity: many small parts hold none.
    constexpr std::size_t kHolders = 64;
    std::stable_sort(by_size.begin(), by_size.end(), [](const Shell* a, const Shell* b) {
        const DVec3 s = a->box.high - a->box.low, t = b->box.high - b->box.low;
        return s.x * s.y * s.z > t.x * t.y * t.z;
    });
    const std::size_t holders = std::min(by_size.size(), kHolders);
    for (Shell* shell : by_size) {
        if (!shell->alike || !(shell->volume < 0)) continue;
        shell->flipped = std::none_of(
            by_size.begin(), by_size.begin() + static_cast<std::ptrdiff_t>(holders),
            [&](const Shell* other) { return other != shell && within(shell->box, other->box); });
    }
    return out;
}

} // namespace scanout::geom
