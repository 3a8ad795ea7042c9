#include "frame/facts/brightness.h"

#include "math/rotation.h"
#include "math/transcendental.h"

#include <algorithm>
#include <vector>

namespace scanout::frame {
namespace {

constexpr std::size_t kExact = 8;

// Directional lights as vectors: the light's direction, with its brightness as length.
std::vector<DVec3> vectors(std::span<const scene::Light> lights, scene::LightFrame frame,
                           int channel) {
    std::vector<DVec3> found;
    for (const scene::Light& light : lights) {
        if (light.kind != scene::LightKind::directional || light.frame != frame) continue;
        const DVec3& d = light.towards;
        const double largest = std::max({d.x, -d.x, d.y, -d.y, d.z, -d.z});
        if (!(largest > 0)) continue;
        const DVec3 scaled = d / largest;
        found.push_back(scaled *
                        (double{light.colour[channel]} * light.power / sqrt(dot3(scaled, scaled))));
    }
    return found;
}

double greatest(const std::vector<DVec3>& lights) {
    double most = 0;
    if (lights.size() > kExact) {
        for (const DVec3& light : lights)
            most += length(light);
        return most;
    }
    for (unsigned subset = 0; subset < 1u << lights.size(); ++subset) {
        DVec3 together(0);
        for (std::size_t k = 0; k < lights.size(); ++k)
            if ((subset >> k & 1) != 0) together += lights[k];
        most = std::max(most, length(together));
    }
    return most;
}

} // namespace

double greatest_light(std::span<const scene::Light> lights, const Surroundings& surroundings) {
    double brightest = 0;
    for (int channel = 0; channel < 3; ++channel) {
        double sum = 0, lamps = 0, of_camera = 0;
        for (const scene::Light& light : lights) {
            const double arrives = double{light.colour[channel]} * light.power;
            if (light.kind == scene::LightKind::ambient)
                sum += arrives;
            else if (light.kind == scene::LightKind::hemisphere)
                sum += double{std::max(light.colour[channel], light.ground[channel])} * light.power;
            else if (light.kind != scene::LightKind::directional)
                (light.frame == scene::LightFrame::world ? lamps : of_camera) += arrives;
        }
        sum += of_camera + std::max(lamps, lamp_light(lights, surroundings, channel));
        for (const scene::LightFrame frame : {scene::LightFrame::world, scene::LightFrame::camera})
            sum += greatest(vectors(lights, frame, channel));
        brightest = std::max(brightest, sum);
    }
    return brightest;
}

} // namespace scanout::frame
