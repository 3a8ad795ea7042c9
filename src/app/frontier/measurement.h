// Measuring: the distances between two points or three, the angle at the second, and how they are
// drawn over the picture.
#pragma once

#include "app/view/pixel_place.h"
#include "geom/mesh.h"
#include "image/image.h"
#include "scene/view.h"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace scanout::app {

// File units; angle in degrees, of three points.
struct Measured {
    std::vector<DVec3> steps; // from each point to the next
    std::vector<double> distances;
    std::optional<double> angle;
};
Measured measure_points(std::span<const DVec3> points);

// "distance 5  dx 3  dy 4  dz 0", and for three points a line more and the angle.
std::vector<std::string> measured_text(std::span<const DVec3> points);

// On the picture: pixels, and what is off it left out. Surfaces hide none of it.
struct MeasuredMarks {
    std::vector<PixelPlace> points;
    std::vector<std::pair<PixelPlace, PixelPlace>> lines;
    friend bool operator==(const MeasuredMarks&, const MeasuredMarks&) = default;
};
MeasuredMarks measured_marks(std::span<const DVec3> points, const scene::View& view,
                             const geom::Mesh& mesh, int width, int height);
void draw_measured(image::Image& picture, const MeasuredMarks& marks, int scale);

} // namespace scanout::app
