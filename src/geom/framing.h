// The model's position and size: the framing sphere about the middle of the bounding box, and the
// shift and power of two that bring it to unit size. Uses only min and max, so that no order of the
// vertices changes it; works from denormal extents to the largest doubles.
#pragma once

#include "base/jobs.h"
#include "math/vec.h"

#include <cstdint>
#include <vector>

namespace scanout::geom {

// normalised = (file units - centre) * 2^-exponent
struct Framing {
    DVec3 box_min{0}, box_max{0}; // file units
    DVec3 centre{0};              // file units
    int exponent = 0;
    double radius = 0.5; // normalised, in [0.5, 1]; 0.5 for no extent

    DVec3 normalise(const DVec3& file_units) const;
};

// The framing of the positions with used[i] not 0, or of all, if none is used. Skips positions that
// are not finite.
Framing framing_of(Jobs& jobs, const std::vector<DVec3>& positions,
                   const std::vector<std::uint8_t>& used);

bool is_finite(const DVec3& v);

} // namespace scanout::geom
