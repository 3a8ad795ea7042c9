// Lights as the viewer's keys move them.
#include "math/rotation.h"
#include "math/transcendental.h"
#include "scene/light.h"

#include <algorithm>

namespace scanout::scene {
namespace {

// The light's position in spherical coordinates about the centre of its movement.
struct Sphere {
    DMat3 upright{1}; // file or camera axes -> axes with y up
    DVec3 centre{0};
    double azimuth = 0, elevation = 0, distance = 0; // degrees
};

bool has_place(const Light& light) {
    return light.kind == LightKind::point || light.kind == LightKind::spot;
}

Sphere sphere_of(const Light& light, UpAxis up, const geom::Mesh& mesh) {
    Sphere sphere;
    if (light.frame == LightFrame::world) {
        sphere.upright = up_rotation(up);
        if (has_place(light)) sphere.centre = mesh.centre;
    }
    const DVec3 at =
        sphere.upright * ((has_place(light) ? light.position : light.towards) - sphere.centre);
    const double level = scanout::sqrt(at.x * at.x + at.z * at.z);
    sphere.distance = scanout::sqrt(dot3(at, at));
    sphere.azimuth = degrees(scanout::atan2(at.x, at.z));
    sphere.elevation = degrees(scanout::atan2(at.y, level));
    return sphere;
}

} // namespace

LightPlace place_of(const Light& light, UpAxis up, const geom::Mesh& mesh) {
    const Sphere sphere = sphere_of(light, up, mesh);
    return {sphere.azimuth, sphere.elevation};
}

Light moved(const Light& light, const LightMove& move, UpAxis up, const geom::Mesh& mesh) {
    Light out = light;
    if (move.level != 0)
        out.power = std::clamp(light.power * zoom_scale(move.level), 0.0, kMaxPower);
    if ((move.azimuth == 0 && move.elevation == 0) || light.kind == LightKind::ambient) return out;
    const Sphere sphere = sphere_of(light, up, mesh);
    const auto turned = [](double from, int units) {
        return from + static_cast<double>(units) / kAngleUnitsPerDegree;
    };
    const double azimuth = turned(sphere.azimuth, move.azimuth);
    const double elevation = std::clamp(turned(sphere.elevation, move.elevation), -90.0, 90.0);
    const double level = sphere.distance * cos_degrees(elevation);
    const DVec3 at(level * sin_degrees(azimuth), sphere.distance * sin_degrees(elevation),
                   level * cos_degrees(azimuth));
    // The inverse of a rotation is its transpose: row vector times matrix.
    const DVec3 placed = at * sphere.upright + sphere.centre;
    (has_place(light) ? out.position : out.towards) = placed;
    return out;
}

} // namespace scanout::scene
