#include "textbook/light.h"

#include "math/transcendental.h"

#include <algorithm>

namespace scanout::textbook {
namespace {

// c = n . l, and never below 0 [Compendium 11.1] leaves that out.
double lambert(const DVec3& normal, const DVec3& light) {
    return std::max(dot3(normal, light), 0.0);
}

// Blinn 1977.
double highlight(const Surface& s, const DVec3& light) {
    if (!s.highlight || !(dot3(s.normal, light) > 0)) return 0;
    const double cosine = dot3(s.normal, unit(light + s.to_eye));
    if (!(cosine > 0)) return 0;
    return std::min(s.shininess, 1.0) * pow(std::min(cosine, 1.0), std::max(s.shininess, 1.0));
}

// Of a lamp at a place: less with the square of the distance; of a spot nothing outside its cone.
double arrives(const scene::ViewLight& light, double square, const DVec3& towards, double scale) {
    const double reach = light.reach / scale, nearest = light.nearest / scale;
    const double share = reach * reach / std::max(square, nearest * nearest);
    if (light.kind != scene::LightKind::spot) return share;
    const double cosine = -dot3(towards, DVec3(light.axis)), inner = light.cos_inner,
                 outer = light.cos_outer;
    if (cosine >= inner) return share;
    const double t = inner > outer ? std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0) : 0;
    return share * t * t * (3 - 2 * t);
}

} // namespace

DVec3 unit(const DVec3& v) {
    const double length = scanout::sqrt(dot3(v, v));
    return length > 0x1p-60 ? v / length : DVec3(0, 0, 1);
}

DVec3 light_from(const std::vector<scene::ViewLight>& lights, double scale, const Surface& s) {
    DVec3 sum(0);
    for (const scene::ViewLight& light : lights) {
        const DVec3 colour(light.colour);
        if (light.kind == scene::LightKind::ambient) {
            sum = sum + s.diffuse * colour;
        } else if (light.kind == scene::LightKind::hemisphere) {
            const double sky =
                std::clamp((1 + dot3(s.normal, unit(DVec3(light.towards)))) / 2, 0.0, 1.0);
            sum = sum + s.diffuse * (colour * sky + DVec3(light.ground) * (1 - sky));
        } else {
            const bool far = light.kind == scene::LightKind::directional;
            const DVec3 way = far ? DVec3(light.towards) : DVec3(light.position) / scale - s.place;
            const double square = dot3(way, way);
            if (!far && square < 0x1p-100) continue;
            const DVec3 towards = unit(way);
            const double share = far ? 1 : arrives(light, square, towards, scale);
            sum = sum +
                  colour * share *
                      (s.diffuse * lambert(s.normal, towards) + s.specular * highlight(s, towards));
        }
    }
    return sum;
}

} // namespace scanout::textbook
