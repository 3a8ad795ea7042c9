#include "trace/probe.h"

#include "trace/sampler.h"

#include <cmath>

namespace scanout::trace {
namespace {

constexpr double kNearCorner = 0.49; // of a pixel, from its middle

// Mean of f(x, y) over an even grid in the pixel's box.
template <class F>
double mean_over(int x, int y, int side, F f) {
    int found = 0;
    for (int i = 0; i < side * side; ++i)
        found += f(x + (i % side + 0.5) / side, y + (i / side + 0.5) / side) ? 1 : 0;
    return static_cast<double>(found) / (side * side);
}

} // namespace

Result<Probe> Probe::create(const scene::Scene& scene, const scene::View& view, const Look& look) {
    TRY(World world, World::create(scene, view, look));
    return Probe(std::move(world), scene, view, look);
}

Hit Probe::first(const Ray& ray) const {
    for (Hit hit{world_.nearest(), kNothing, {}};;) {
        hit = world_.next(ray, hit);
        if (!hit.any() || (!world_.is_left_out(hit.triangle) && world_.alpha(hit) > 0)) return hit;
    }
}

double Probe::covered(int x, int y) const {
    const auto shows = [&](double px, double py) { return first(world_.ray(px, py)).any(); };
    const double coarse = mean_over(x, y, 4, shows);
    return coarse == 0 || coarse == 1 ? coarse : mean_over(x, y, 32, shows);
}

bool Probe::is_inside(int x, int y) const {
    constexpr double kContinues = 0.01; // of the distance
    const Hit middle = first(world_.ray(x + 0.5, y + 0.5));
    DVec3 normal(0), place(0);
    if (middle.any()) {
        const Corners& c = world_.bvh().corners(middle.triangle);
        normal = cross3(c[1] - c[0], c[2] - c[0]);
        place = c[0];
    }
    for (int corner = 0; corner < 4; ++corner) {
        const Ray ray = world_.ray(x + 0.5 + ((corner & 1) != 0 ? kNearCorner : -kNearCorner),
                                   y + 0.5 + ((corner & 2) != 0 ? kNearCorner : -kNearCorner));
        const Hit hit = first(ray);
        if (hit.any() != middle.any()) return false;
        if (!hit.any() || hit.triangle == middle.triangle) continue;
        // Where the ray meets the plane of the middle one.
        const double plane = dot3(place - ray.from, normal) / dot3(ray.way, normal);
        if (scene_->mesh.material[hit.triangle] != scene_->mesh.material[middle.triangle] ||
            !(std::abs(hit.t - plane) <= kContinues * std::abs(hit.t)))
            return false;
    }
    return true;
}

bool Probe::is_seen_through(int x, int y) const {
    const Hit hit = first(world_.ray(x + 0.5, y + 0.5));
    return hit.any() && world_.alpha(hit) < 1;
}

std::optional<Probe::Place> Probe::on_triangle(std::uint32_t triangle, int x, int y) const {
    const Hit hit =
        RayTest(world_.ray(x + 0.5, y + 0.5)).meets(world_.bvh().corners(triangle), triangle);
    if (!std::isfinite(hit.t)) return std::nullopt;
    return Place{hit.t, scene_->mesh.uv.empty() ? DVec2(0) : world_.uv(hit)};
}

std::optional<bool> Probe::is_lit(const Ray& ray) const {
    constexpr std::uint32_t kPoints = 64; // of a light with a size
    const Hit hit = first(ray);
    if (!hit.any()) return std::nullopt;
    const DVec3 seen = ray.from + ray.way * hit.t;
    const ShadowRays shadows(world_);
    bool some_lit = false, some_dark = false;
    for (const PlacedLight& light : lights_.others) {
        if (!light.casts() || light.at(seen).colour == DVec3(0)) continue;
        const auto [place, facing] = world_.ground(hit, ray, light.at(seen).towards);
        for (std::uint32_t i = 0; i < (light.has_size() ? kPoints : 1); ++i) {
            const DVec2 point = light.has_size() ? stratified(i, 1, 0) : DVec2(0.5);
            const Ray towards = light.towards(place, point);
            if (dot3(towards.way, facing) <= 0) continue;
            const bool dark = shadows.blocked(towards, light.end(), hit.triangle);
            (dark ? some_dark : some_lit) = true;
            if (some_lit && some_dark) return std::nullopt;
        }
    }
    if (some_lit == some_dark) return std::nullopt;
    return some_lit;
}

std::optional<bool> Probe::is_lit(int x, int y) const {
    const std::optional<bool> middle = is_lit(world_.ray(x + 0.5, y + 0.5));
    for (int corner = 0; corner < 4 && middle; ++corner)
        if (is_lit(world_.ray(x + 0.5 + ((corner & 1) != 0 ? kNearCorner : -kNearCorner),
                              y + 0.5 + ((corner & 2) != 0 ? kNearCorner : -kNearCorner))) !=
            middle)
            return std::nullopt;
    return middle;
}

} // namespace scanout::trace
