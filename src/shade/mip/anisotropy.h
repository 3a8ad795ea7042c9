// The anisotropic filters' kernel: texture/anisotropic_*.cpp differ in how many probes they spend.
#pragma once

#include "shade/stage.h"

namespace scanout::shade {

// Reads a map at b.u, b.v with up to `probes` trilinear probes, side by side along the longer axis
// of the pixel's footprint.
void sample_anisotropic(ShadingBlock& block, const BoundMap& map, TexelKind kind, int probes);

} // namespace scanout::shade
