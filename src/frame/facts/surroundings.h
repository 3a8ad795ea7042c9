// Where the surfaces of a scene lie, coarsely: what the light of a lamp that stands near them is
// asked of. Cells of a grid about the model, each with the area, the mean place and the mean normal
// of the surfaces in it that face one of six ways. Sums of whole numbers alone: no order of
// triangles changes them.
#pragma once

#include "geom/mesh.h"
#include "math/vec.h"
#include "scene/light.h"

#include <cstdint>
#include <span>
#include <vector>

namespace scanout::frame {

struct SurfaceCell {
    DVec3 place{0};        // bounding radii from the model's centre, along the file's axes
    DVec3 normal{0};       // unit; 0 where it cancels out
    std::int64_t area = 0; // in a unit of its own
    friend bool operator==(const SurfaceCell&, const SurfaceCell&) = default;
};

struct Surroundings {
    DVec3 centre{0}; // as in geom::Mesh
    int exponent = 0;
    double radius = 0.5;
    std::vector<SurfaceCell> cells; // in the order of their places in the grid
};
Surroundings surroundings_of(const geom::Mesh& mesh);

// The light of all lamps of the world, straight from them, that only a hundredth of the area
// exceeds; of one channel. Lamps on the camera do not count.
double lamp_light(std::span<const scene::Light> lights, const Surroundings& surroundings,
                  int channel);

} // namespace scanout::frame
