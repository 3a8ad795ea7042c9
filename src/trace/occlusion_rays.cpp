#include "trace/occlusion_rays.h"

#include "math/transcendental.h"
#include "trace/lights.h"
#include "trace/sampler.h"

#include <algorithm>

namespace scanout::trace {

constexpr std::uint32_t kRays = 16; // a sample

OcclusionRays::OcclusionRays(const World& world, double radius)
    : world_(world), radius_(radius > 0 ? radius * world.model_radius() : 0),
      least_(world.bvh().radius() * 0x1p-34) {}

double OcclusionRays::taken(const Ray& ray, std::uint32_t triangle) const {
    for (Hit hit{least_, kNothing, {}};;) {
        hit = world_.bvh().next(ray, hit);
        if (!hit.any() || hit.t >= radius_) return 0;
        if (hit.triangle == triangle || !world_.keeps_off(hit)) continue;
        return 1 - hit.t / radius_ * (hit.t / radius_);
    }
}

// Directions that are even over a disc are so by the cosine over the half sphere above it: Malley
// 1988.
double OcclusionRays::open(const Hit& hit, const Ray& ray, std::uint32_t index, int number,
                           std::uint32_t seed) const {
    constexpr double kTurn = 6.28318530717958647693;
    const DVec3 up = unit_of(world_.facing(hit, ray));
    const Across sides = across(up);
    const DVec3 place = ray.from + ray.way * hit.t;
    double hidden = 0;
    for (std::uint32_t i = 0; i < kRays; ++i) {
        const DVec2 at = stratified(index * kRays + i, number + 1, seed);
        const double square = at.x, out = scanout::sqrt(square);
        const DVec3 way = sides.x * (out * scanout::cos(kTurn * at.y)) +
                          sides.y * (out * scanout::sin(kTurn * at.y)) +
                          up * scanout::sqrt(std::max(1 - square, 0.0));
        hidden += taken({place, way}, hit.triangle);
    }
    return 1 - hidden / kRays;
}

} // namespace scanout::trace
