// Morph targets: a primitive's positions and normals, moved by shares of its targets. Khronos 2021,
// 3.7.2.2.
#pragma once

#include "io/gltf/primitive.h"

#include <array>
#include <span>
#include <vector>

namespace scanout::io::gltf {

// The room of a morphed primitive, which its views are of.
struct MorphRoom {
    std::vector<std::array<float, 3>> positions, normals;
};

// The primitive with each target added as often as its weight says: summed in double, rounded once.
// Unchanged where no weight counts. Good until the room is used again.
PrimitiveData morphed(const PrimitiveData& primitive, std::span<const double> weights,
                      MorphRoom& room);

} // namespace scanout::io::gltf
