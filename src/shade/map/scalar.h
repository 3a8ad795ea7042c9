// Maps that give one number a texel.
#pragma once

#include "shade/stage.h"

namespace scanout::shade::map {

// As what a filter reads such a map.
inline TexelKind scalar_kind(const BoundMap& map) {
    return map.map->channel == 'm' ? TexelKind::alpha : TexelKind::data;
}

} // namespace scanout::shade::map
