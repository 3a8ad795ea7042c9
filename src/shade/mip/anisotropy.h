// The kernel of the anisotropic filters; the rows of texture/rows.cpp differ in the number of
// probes.
#pragma once

#include "shade/stage.h"

namespace scanout::shade {

// Reads a map at b.u, b.v with up to `probes` trilinear probes, side by side along the longer axis
// of the pixel's footprint.
void sample_anisotropic(ShadingBlock& block, const BoundMap& map, TexelKind kind, int probes);

} // namespace scanout::shade
