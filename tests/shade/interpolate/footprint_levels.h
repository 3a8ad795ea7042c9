// shade/setup/footprint-inl.h over arrays, on the target that is chosen.
#pragma once

#include "shade/stage.h"

#include <vector>

namespace scanout::shade::test {

struct Sample {
    std::int32_t x, y; // 1/256 pixel
};
// narrow: in registers of at most 8 lanes.
std::vector<float> levels(bool narrow, const Primitive& triangle, float width, float height,
                          const std::vector<Sample>& samples);

} // namespace scanout::shade::test
