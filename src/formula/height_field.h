// Heights on a grid, and the surface that they make.
#pragma once

#include "geom/polygon_mesh.h"
#include "image/plane.h"

namespace scanout::formula {

// Two triangles a cell, seen from above (+y) counter-clockwise, with uv; the longer side is 2 and
// lies around the origin. `height`: of a value of 1. Colours of greens, rock and snow by height.
geom::PolygonMesh surface_of(const image::Plane& heights, double height);

// To six decimal places, so that files are short.
double rounded(double x);

} // namespace scanout::formula
