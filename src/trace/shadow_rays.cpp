#include "trace/shadow_rays.h"

#include "math/transcendental.h"

namespace scanout::trace {

bool ShadowRays::blocked(const Ray& ray, double end, std::uint32_t triangle) const {
    const double least = least_ / scanout::sqrt(dot3(ray.way, ray.way));
    if (!world_.has_holes())
        return world_.bvh().blocked(ray, least, end, triangle, world_.casters());
    for (Hit hit{least, kNothing, {}};;) {
        hit = world_.bvh().next(ray, hit);
        if (!hit.any() || hit.t >= end) return false;
        if (hit.triangle != triangle && world_.casters()[hit.triangle] != 0 &&
            !world_.lets_through(hit))
            return true;
    }
}

} // namespace scanout::trace
