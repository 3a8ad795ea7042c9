// The 26 views in which a model just fits the picture: along the axes, the diagonals of the planes
// between them, and those of space; the faces, edges and corners of a cube around it.
#pragma once

#include <string>
#include <vector>

namespace scanout::measure {

struct FramedView {
    std::string name; // "front", or "--camera 45,35.26"
    double azimuth_degrees, elevation_degrees;
};
const std::vector<FramedView>& framed_views();

} // namespace scanout::measure
