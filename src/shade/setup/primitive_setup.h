// Triangles that a tile shows in many pixels, or whose items read what they share: set up once
// each, 8 side by side.
#pragma once

#include "shade/setup/shading_setup.h"

namespace scanout::shade {

// Of `count` primitives from `first` on, whose ids are set and whose vertices all stand on the
// screen: all but `clipped`, `across`, `step`, `object` and what follows from a cut. `scratch` is
// written over.
void set_up_primitives(const TriangleSource& source, ShadingSetup& scratch, Primitive* first,
                       int count);

} // namespace scanout::shade
