// The colours of triangles in frames that colour by a fact (shade/colour_by.h).
#pragma once

#include "math/vec.h"
#include "scene/scene.h"
#include "scene/view.h"
#include "shade/colour_by.h"

#include <cstdint>
#include <span>
#include <vector>

namespace scanout::frame {

// Linear, one a triangle; empty where each pixel has its own. Keeps what depends on the scene alone
// while it stays the same.
class TriangleColours {
public:
    std::span<const Vec3> of(const scene::Scene& scene, const scene::View& view,
                             shade::ColourByTraits::Of what);

private:
    std::vector<Vec3> colours_;
    std::uint64_t revision_ = 0;
    shade::ColourByTraits::Of what_ = shade::ColourByTraits::Of::light;
};

// Colours of materials and parts, by number: neighbours in number differ most.
Vec3 distinct_colour(std::uint32_t number);

// The distances of the nearest and the farthest corner of the model's box from the eye's plane.
struct DepthRange {
    double nearest, farthest;
};
DepthRange depth_range(const geom::Mesh& mesh, const scene::View& view);

} // namespace scanout::frame
