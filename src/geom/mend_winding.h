// Turns faces so that each shell is wound alike: closed ones outwards (cavities inwards), open ones
// as most of their faces are.
#pragma once

#include "geom/mend.h"

namespace scanout::geom {

void make_winding_alike(Jobs& jobs, PolygonMesh& mesh, Mended& report);

} // namespace scanout::geom
