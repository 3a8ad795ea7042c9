// What colours say (axis `colour_by`): light, or a fact about a surface in false colours, which
// nothing lights.
#pragma once

#include "shade/stage.h"

namespace scanout::shade {

struct ColourByTraits {
    enum class Of : std::uint8_t { light, normal, depth, side, material, part };
    Of of = Of::light;
};
struct ColourBy : Stage, ColourByTraits {};

} // namespace scanout::shade
