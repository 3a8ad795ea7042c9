// Faces with the same corners: repeated, or turned around. Those without an area are left out.
#pragma once

#include "geom/diagnose/surface.h"

#include <cstdint>
#include <vector>

namespace scanout::geom {

struct SameFace {
    std::uint32_t face, first; // the later one, and the earliest that has its corners
    bool turned;               // wound in the opposite direction
};

// By `face`. A face is turned only where no earlier one repeats it.
std::vector<SameFace> find_same_faces(const Surface& surface);

} // namespace scanout::geom
