// How much of the light from everywhere reaches a place: rays over the half of directions before
// its face, by the cosine to the face's normal; what one meets at the distance d takes
// 1 - (d / radius)^2 of it. Zhukov, Iones and Kronin 1998.
#pragma once

#include "trace/world.h"

namespace scanout::trace {

class OcclusionRays {
public:
    // radius: in parts of the model's; 0: nothing keeps off light.
    OcclusionRays(const World& world, double radius);
    bool any() const { return radius_ > 0; }
    // Where the ray from the eye has met it; by the rays of sample `index`, spread like those of
    // the light `number`.
    double open(const Hit& hit, const Ray& ray, std::uint32_t index, int number,
                std::uint32_t seed) const;

private:
    double taken(const Ray& ray, std::uint32_t triangle) const; // by what a unit ray meets

    const World& world_;
    double radius_, least_;
};

} // namespace scanout::trace
