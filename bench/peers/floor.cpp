#include "bench/peers/floor.h"

namespace scanout::bench {

double floor_of(const Load& load, const Work& work, const CoreLimits& core) {
    if (load.samples != 1) return 0;
    const bool lit = load.shading != Shading::depth, textured = load.shading == Shading::textured,
               shadowed = load.shading == Shading::shadowed;
    const auto vertices = static_cast<double>(work.vertices),
               triangles = static_cast<double>(work.triangles);
    // Bytes: place, normal, u and v; three indices a triangle. A shadow map is a second view.
    const double of_vertex = textured ? 32 : lit ? 24 : 12, of_triangle = 12;
    double bytes = vertices * of_vertex + triangles * of_triangle;
    // Cycles: turned vertices; triangles gathered and culled, and what is left of them set up;
    // pixels by depth alone, with light, with eight texels, with those of a shadow map.
    double cycles = vertices * (textured ? 6.5 : lit ? 6 : 3) + triangles * 4 + work.drawn * 25;
    double a_pixel = textured ? 18 : lit ? 4 : 0.6;
    if (shadowed) {
        bytes += vertices * 12 + triangles * of_triangle;
        cycles += vertices * (1.5 + 3) + triangles * 4 + work.drawn * 25 + 0.5e6;
        a_pixel += 6;
    }
    cycles += work.fragments * a_pixel;
    return (work.pixels * 4 / core.write + bytes / core.read + cycles / core.clock) * 1e3;
}

} // namespace scanout::bench
