// The truth about single pixels by single rays, in double: what a measure of one axis alone is
// compared with. Like the reference (render.h) it shares no code with what it judges.
#pragma once

#include "base/result.h"
#include "trace/lights.h"
#include "trace/shadow_rays.h"
#include "trace/world.h"

#include <optional>

namespace scanout::trace {

class Probe {
public:
    // All three outlive it. Fails where memory does not suffice (Exit::unreadable).
    static Result<Probe> create(const scene::Scene& scene, const scene::View& view,
                                const Look& look);

    // The share of a pixel's box in which anything shows: of 32 x 32 rays, where 4 x 4 differ.
    double covered(int x, int y) const;
    // No edge crosses the pixel: rays near its corners meet the surface that the middle one meets,
    // or its continuation, or all of them nothing.
    bool is_inside(int x, int y) const;
    // What the middle of the pixel shows first lets light through.
    bool is_seen_through(int x, int y) const;

    struct Place {
        double distance = 0; // from the eye's plane; of an orthographic view from anywhere
        DVec2 uv{0};         // of the mesh; 0 where it has none
    };
    // Where the ray through the middle of the pixel meets this triangle.
    std::optional<Place> on_triangle(std::uint32_t triangle, int x, int y) const;

    // Whether the lights that cast shadows reach what is seen in the pixel: all of them wholly, or
    // none of them at all; nothing where neither holds for the whole pixel, or none shines on it.
    std::optional<bool> is_lit(int x, int y) const;

private:
    Probe(World world, const scene::Scene& scene, const scene::View& view, const Look& look)
        : world_(std::move(world)), scene_(&scene), lights_(placed(look.lights, view, scene.mesh)) {
    }
    Hit first(const Ray& ray) const; // that is shown at all
    std::optional<bool> is_lit(const Ray& ray) const;

    World world_;
    const scene::Scene* scene_;
    PlacedLights lights_;
};

} // namespace scanout::trace
