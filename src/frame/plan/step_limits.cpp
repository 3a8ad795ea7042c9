#include "frame/plan/step_limits.h"

#include "math/transcendental.h"

#include <algorithm>

namespace scanout::frame {
namespace {

// Half a code where sRGB's codes stand closest, in the dark: its slope there is 12.92.
constexpr double kHalfCode = 0.5 / 255 / 12.92;
constexpr double kPosition = 1e-4; // bounding radii: light from near lamps hardly changes

double magnitude(float x) {
    return double{x < 0 ? -x : x};
}

// The most texels that a unit of u or v spans, over all maps.
double texels(const scene::Scene& scene) {
    int side = 1;
    for (const scene::Texture& texture : scene.textures)
        side = std::max({side, texture.image.width(), texture.image.height()});
    double scale = 1;
    for (const scene::Material& m : scene.materials)
        for (const scene::NamedMap& row : scene::kTextureMaps) {
            const Vec3& repeats = (m.*row.map)->scale;
            if (row.drawn) scale = std::max({scale, magnitude(repeats.x), magnitude(repeats.y)});
        }
    return side * scale;
}

// The greatest change of reflected light when the normal's tip moves; the slope of cos^n is below
// the square root of n.
double steepness(const scene::Scene& scene) {
    double steepest = 1;
    for (const scene::Material& m : scene.materials) {
        const auto largest = [](const Vec3& c) { return double{std::max({c.x, c.y, c.z})}; };
        const double highlight =
            has_highlight(m) ? largest(m.specular) * sqrt(std::max(double{m.shininess}, 1.0)) : 0;
        steepest = std::max(steepest, largest(m.diffuse) + highlight);
    }
    return steepest;
}

} // namespace

shade::StepLimits step_limits(const scene::Scene& scene, const FramePlan& plan) {
    double light = 1; // all that shines, together
    for (const scene::Light& l : plan.lights)
        light += double{std::max({l.colour.x, l.colour.y, l.colour.z})} * l.power;
    const double shown = kHalfCode / (light * double{plan.exposure});
    // The vertices' attributes and their normals get half of the error budget each; a mean of unit
    // vectors may be shorter than 1 by a tenth.
    return {plan.attributes, 1.0 / 256 / texels(scene), shown / 2,
            shown / 2 / (steepness(scene) * 1.2), kPosition};
}

} // namespace scanout::frame
