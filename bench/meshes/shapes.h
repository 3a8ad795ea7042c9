// The makers behind the names, and what they are made of. Shapes are closed and wound
// counter-clockwise seen from where they are looked at. libm may differ in a last bit between
// machines: nothing here decides a picture that is kept.
#pragma once

#include "geom/polygon_mesh.h"

#include <functional>

namespace scanout::bench {

// Newell's teapot: 32 bicubic patches of 10 x 10 squares, without what the poles fold up: 6320
// triangles. Newell 1975.
geom::PolygonMesh teapot();
// A rough tube along a torus knot, of about so many triangles: a long body that winds before and
// behind itself, as the dragon's does. finest_fold: height of the folds that are two squares long
// when it has as many triangles as the dragon, as a share of the tube's radius.
geom::PolygonMesh knot(std::size_t triangles, double finest_fold = 0.004);
// The knot as a scan would hold it, by what was measured of Stanford's dragon, whose neighbours
// meet at 6.4 degrees rms: its finest folds are lower, and vertices and triangles stand as a volume
// gives them in which range images were merged, by slices (z), by rows (y), along the row (x).
// Curless and Levoy 1996.
geom::PolygonMesh dragon(std::size_t triangles);
// The knot in a box, all of it hidden from outside.
geom::PolygonMesh crate(std::size_t triangles_inside);
// A hall with aisles, piers, columns, beams and furniture, seen from inside.
geom::PolygonMesh building();

void add_triangle(geom::PolygonMesh& mesh, std::size_t a, std::size_t b, std::size_t c);

// A grid of squares over [0, 1] x [0, 1], two triangles each, those that have no area left out.
// closed_u, closed_v: the last column or row is the first.
struct GridSize {
    std::size_t u, v;
    bool closed_u = false, closed_v = false;
};
void add_grid(geom::PolygonMesh& mesh, const GridSize& size,
              const std::function<DVec3(double u, double v)>& place);

} // namespace scanout::bench
