// Places: positions that are one vertex when they are drawn. All who join positions by where they
// stand ask here (diagnose/surface.h, open_edges.h).
#pragma once

#include "geom/join_table.h"
#include "geom/polygon_mesh.h"
#include "math/vec.h"

#include <bit>
#include <cstddef>
#include <cstdint>

namespace scanout::geom {

// A position as floats, but near 0 no finer than near the model's border: there exporters leave
// rounding of 1e-17, which no picture shows. Positions alike as drawn are one place.
inline Vec3 place_as_drawn(const DVec3& normalised) {
    constexpr double kSteps = 0x1.8p52 * 0x1p-26; // x + kSteps - kSteps: a multiple of 2^-26
    return {(normalised.x + kSteps) - kSteps, (normalised.y + kSteps) - kSteps,
            (normalised.z + kSteps) - kSteps};
}

inline std::uint64_t hash_of_place(const Vec3& place) {
    const auto bits = [](float x) {
        return std::uint64_t{std::bit_cast<std::uint32_t>(x + 0.0F)}; // no -0
    };
    return mix_bits(mix_bits(bits(place.x) << 32 | bits(place.y)) + bits(place.z));
}

// Whether a face's corners stand on at most two places: it covers nothing, and the edge between the
// two is no neighbour's. place_of(corner): any name of its place.
template <class PlaceOf>
bool stands_on_two_places(const PolygonMesh& mesh, std::size_t face, const PlaceOf& place_of) {
    const auto first = place_of(mesh.face_begin[face]);
    auto second = first;
    for (std::size_t c = mesh.face_begin[face] + std::size_t{1}; c < mesh.face_end(face); ++c) {
        const auto place = place_of(c);
        if (place == first || place == second) continue;
        if (second != first) return false;
        second = place;
    }
    return true;
}

} // namespace scanout::geom
