// Scalar maps: one number a texel.
#pragma once

#include "shade/stage.h"

namespace scanout::shade::map {

// The kind of texels that a filter reads of such a map.
inline TexelKind scalar_kind(const BoundMap& map) {
    return map.map->channel == 'm' ? TexelKind::alpha : TexelKind::data;
}

} // namespace scanout::shade::map
