// Faces with the same corners: repeated, or turned around. Those without an area are left out.
#pragma once

#include <cstdint>
#include <vector>

namespace scanout::geom {

class Surface;

struct SameFace {
    std::uint32_t face, first; // the later one, and the earliest that has its corners
    bool turned;               // wound in the opposite direction
};

// Of a surface whose places and areas are known; by `face`.
std::vector<SameFace> find_same_faces(const Surface& surface);

} // namespace scanout::geom
