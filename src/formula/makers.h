// One function a formula and form; formula.cpp has the table.
#pragma once

#include "formula/formula.h"

#include <vector>

namespace scanout::formula {

// Light is (1 + cos(pi n r^2)) / 2 for n rings within the radius 1: waves that get finer outwards
// (Fresnel zones). Model: black and white rings of equal area.
image::Image zone_plate_picture(const Wanted& wanted, Jobs& jobs, const Progress& progress);
geom::PolygonMesh zone_plate_model(const Wanted& wanted, Jobs& jobs, const Progress& progress);

// Black and white squares, `detail` a side. Model: on the ground, from z = 0 to the horizon.
image::Image checker_picture(const Wanted& wanted, Jobs& jobs, const Progress& progress);
geom::PolygonMesh checker_model(const Wanted& wanted, Jobs& jobs, const Progress& progress);

image::Image terrain_picture(const Wanted& wanted, Jobs& jobs, const Progress& progress);
geom::PolygonMesh terrain_model(const Wanted& wanted, Jobs& jobs, const Progress& progress);

image::Image mandelbrot_picture(const Wanted& wanted, Jobs& jobs, const Progress& progress);
geom::PolygonMesh mandelbrot_model(const Wanted& wanted, Jobs& jobs, const Progress& progress);

image::Image koch_picture(const Wanted& wanted, Jobs& jobs, const Progress& progress);
geom::PolygonMesh koch_model(const Wanted& wanted, Jobs& jobs, const Progress& progress);
// The curve's corners, counter-clockwise, around the origin, within 1 of it.
std::vector<DVec2> koch_curve(int recursions);

image::Image fern_picture(const Wanted& wanted, Jobs& jobs, const Progress& progress);
geom::PolygonMesh fern_model(const Wanted& wanted, Jobs& jobs, const Progress& progress);
image::Image sierpinski_picture(const Wanted& wanted, Jobs& jobs, const Progress& progress);
geom::PolygonMesh sierpinski_model(const Wanted& wanted, Jobs& jobs, const Progress& progress);
image::Image dragon_picture(const Wanted& wanted, Jobs& jobs, const Progress& progress);
geom::PolygonMesh dragon_model(const Wanted& wanted, Jobs& jobs, const Progress& progress);

} // namespace scanout::formula
