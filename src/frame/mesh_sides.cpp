#include "frame/mesh_sides.h"

#include <bit>
#include <cstdint>
#include <vector>

namespace scanout::frame {
namespace {

// A number for a place: equal places have equal ones, whatever vertices stand there. Steele, Lea
// and Flood 2014 (SplitMix64).
std::uint64_t mixed(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31);
}
std::uint64_t number_of(const Vec3& p) {
    const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x + 0.0F)}; };
    return mixed((bits(p.x) << 32 | bits(p.y)) * 0x9e3779b97f4a7c15U + bits(p.z));
}

// Counts for an edge in one direction and against it in the other. A sum of 0 over all edges by
// chance has the probability 2^-64; no picture depends on it.
std::uint64_t edge(std::uint64_t from, std::uint64_t to) {
    if (from == to) return 0;
    const std::uint64_t both = mixed(from + to) ^ (from ^ to);
    return from < to ? both : 0 - both;
}

} // namespace

MeshSides mesh_sides(const geom::Mesh& mesh) {
    std::vector<std::uint64_t> number(mesh.position.size());
    for (std::size_t i = 0; i < number.size(); ++i)
        number[i] = number_of(mesh.position[i]);
    MeshSides sides;
    std::uint64_t open = 0;
    double volume = 0; // only its sign counts
    for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
        const std::uint32_t* v = &mesh.index[i];
        const Vec3 &a = mesh.position[v[0]], &b = mesh.position[v[1]], &c = mesh.position[v[2]];
        open += edge(number[v[0]], number[v[1]]) + edge(number[v[1]], number[v[2]]) +
                edge(number[v[2]], number[v[0]]);
        const DVec3 ab = DVec3(b) - DVec3(a), ac = DVec3(c) - DVec3(a), n = cross3(ab, ac);
        volume += dot3(DVec3(a), n);
        // Unit normals mixed in any shares lean to no side where none of the three does, with room
        // for the rounding of floats, and of the face's own normal where it is a sliver.
        const double room = dot3(n, n) * 0x1p-24 + dot3(ab, ab) * dot3(ac, ac) * 0x1p-80;
        for (int k = 0; k < 3; ++k) {
            const double lean = dot3(DVec3(mesh.normal[v[k]]), n);
            if (lean > 0 && lean * lean > room) continue;
            ++sides.leaning;
            break;
        }
    }
    sides.closed = open == 0 && !mesh.index.empty();
    sides.outward = volume > 0;
    return sides;
}

} // namespace scanout::frame
