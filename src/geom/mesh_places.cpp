#include "geom/mesh_places.h"

#include "geom/disjoint_sets.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace scanout::geom {

MeshPlaces find_places(const Mesh& mesh) {
    const auto key = [&](std::uint32_t v) {
        const Vec3& p = mesh.position[v];
        return std::tie(p.x, p.y, p.z);
    };
    std::vector<std::uint32_t> order(mesh.position.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return key(a) < key(b) || (key(a) == key(b) && a < b);
    });
    MeshPlaces places;
    places.of_vertex.resize(order.size());
    for (const std::uint32_t v : order) {
        if (places.vertex.empty() || key(places.vertex.back()) != key(v))
            places.vertex.push_back(v);
        places.of_vertex[v] = static_cast<std::uint32_t>(places.vertex.size() - 1);
    }
    return places;
}

std::vector<std::uint32_t> find_parts(const Mesh& mesh) {
    const MeshPlaces places = find_places(mesh);
    DisjointSets sets(places.vertex.size());
    const auto place = [&](std::size_t corner) { return places.of_vertex[mesh.index[corner]]; };
    for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
        sets.join(place(i), place(i + 1));
        sets.join(place(i), place(i + 2));
    }
    constexpr std::uint32_t kNone = 0xffffffff;
    std::vector<std::uint32_t> number(places.vertex.size(), kNone), parts;
    parts.reserve(mesh.triangles());
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
        std::uint32_t& part = number[sets.root(place(i))];
        if (part == kNone) part = count++;
        parts.push_back(part);
    }
    return parts;
}

} // namespace scanout::geom
