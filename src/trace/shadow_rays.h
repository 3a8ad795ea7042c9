// Does anything stand between a place and a light?
#pragma once

#include "trace/world.h"

namespace scanout::trace {

class ShadowRays {
public:
    explicit ShadowRays(const World& world)
        : world_(world), least_(world.bvh().radius() * 0x1p-34) {}
    // Up to the parameter `end`; of casters other than `triangle`, on which the ray begins.
    bool blocked(const Ray& ray, double end, std::uint32_t triangle) const;

private:
    const World& world_;
    double least_; // a length: nearer is the surface itself
};

} // namespace scanout::trace
