#include "io/gltf/morph.h"

#include <algorithm>
#include <cstdint>

namespace scanout::io::gltf {
namespace {

using Places = std::vector<std::array<float, 3>>;

// base + the targets' differences by their weights.
View sum(const View& base, const PrimitiveData& p, std::optional<View> MorphTarget::*part,
         std::span<const double> weights, Places& room) {
    std::vector<DVec3> places(base.count, DVec3(0));
    for_elements<3>(base,
                    [&](std::uint64_t i, const auto* e) { places[i] = DVec3(e[0], e[1], e[2]); });
    for (std::size_t t = 0; t < std::min(p.targets.size(), weights.size()); ++t) {
        const std::optional<View>& target = p.targets[t].*part;
        if (!target || weights[t] == 0) continue;
        for_elements<3>(*target, [&](std::uint64_t i, const auto* e) {
            places[i] += DVec3(e[0], e[1], e[2]) * weights[t];
        });
    }
    room.resize(base.count);
    for (std::size_t i = 0; i < room.size(); ++i)
        room[i] = {static_cast<float>(places[i].x), static_cast<float>(places[i].y),
                   static_cast<float>(places[i].z)};
    View view;
    view.data = reinterpret_cast<const std::uint8_t*>(room.data());
    view.count = base.count;
    view.stride = sizeof room.front();
    view.rows = 3;
    return view;
}

} // namespace

PrimitiveData morphed(const PrimitiveData& p, std::span<const double> weights, MorphRoom& room) {
    const auto counts = weights.first(std::min(weights.size(), p.targets.size()));
    PrimitiveData out = p;
    if (std::all_of(counts.begin(), counts.end(), [](double weight) { return weight == 0; }))
        return out;
    out.positions = sum(p.positions, p, &MorphTarget::positions, counts, room.positions);
    if (p.normals) out.normals = sum(*p.normals, p, &MorphTarget::normals, counts, room.normals);
    return out;
}

} // namespace scanout::io::gltf
