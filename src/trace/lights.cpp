#include "trace/lights.h"

#include "math/transcendental.h"

#include <algorithm>
#include <cmath>

namespace scanout::trace {
namespace {

// Uniform over the unit disc, even where the samples are: Shirley and Chiu 1997.
DVec2 in_disc(const DVec2& sample) {
    const double x = 2 * sample.x - 1, y = 2 * sample.y - 1;
    if (x == 0 && y == 0) return DVec2(0);
    const bool wide = std::abs(x) > std::abs(y);
    const double radius = wide ? x : y;
    const double angle = wide ? 45 * (y / x) : 90 - 45 * (x / y);
    return {radius * cos_degrees(angle), radius * sin_degrees(angle)};
}

} // namespace

Across across(const DVec3& unit) {
    const double sign = unit.z < 0 ? -1 : 1;
    const double a = -1 / (sign + unit.z), b = unit.x * unit.y * a;
    return {{1 + sign * unit.x * unit.x * a, sign * b, -sign * unit.x},
            {b, sign + unit.y * unit.y * a, -unit.y}};
}

DVec3 unit_of(const DVec3& v, const DVec3& otherwise) {
    const double size = scanout::sqrt(dot3(v, v));
    return size > 0x1p-60 ? v / size : otherwise;
}

PlacedLight::PlacedLight(const scene::Light& light, const scene::View& view, const geom::Mesh& mesh)
    : light_(scene::in_view(light, view, mesh)),
      position_(DVec3(light_.position) / scene::to_floats(view)) {
    light_.size /= is_far() ? 1 : static_cast<float>(scene::to_floats(view));
    const DVec3 back =
        is_far() ? unit_of(DVec3(light_.towards)) : unit_of(position_ - view.translation);
    const Across sides = across(back);
    across_ = sides.x;
    up_ = sides.y;
    light_.reach /= static_cast<float>(scene::to_floats(view));
    light_.nearest /= static_cast<float>(scene::to_floats(view));
}

Arrival PlacedLight::at(const DVec3& place) const {
    const DVec3 colour(light_.colour);
    if (is_far()) return {unit_of(DVec3(light_.towards)), colour};
    const DVec3 way = position_ - place;
    const double square = dot3(way, way);
    if (square < 0x1p-100) return {};
    const DVec3 towards = way / scanout::sqrt(square);
    const double reach = light_.reach, nearest = light_.nearest;
    double arrives = reach * reach / std::max(square, nearest * nearest);
    if (light_.kind == scene::LightKind::spot) {
        const double cosine = -dot3(towards, DVec3(light_.axis)), inner = light_.cos_inner,
                     outer = light_.cos_outer;
        if (cosine < inner) {
            const double t =
                inner > outer ? std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0) : 0;
            arrives *= t * t * (3 - 2 * t); // Hermite's cubic
        }
    }
    return {towards, colour * arrives};
}

Ray PlacedLight::towards(const DVec3& place, const DVec2& sample) const {
    const DVec3 middle = is_far() ? unit_of(DVec3(light_.towards)) : position_ - place;
    if (!has_size()) return {place, middle};
    const double size = light_.size;
    if (light_.shape == scene::LightShape::square)
        return {place,
                middle + across_ * (size * (2 * sample.x - 1)) + up_ * (size * (2 * sample.y - 1))};
    const Across sides = across(unit_of(middle));
    const DVec2 aside = in_disc(sample) * size;
    return {place, middle + sides.x * aside.x + sides.y * aside.y};
}

double PlacedLight::end() const {
    return is_far() ? INFINITY : 1;
}

static Hemisphere hemisphere_of(const scene::ViewLight& light) {
    return {unit_of(DVec3(light.towards)), DVec3(light.colour), DVec3(light.ground)};
}

// Of a sky that is as bright everywhere, and a ground likewise: the surface sees (1 + cos) / 2 of
// the sky.
DVec3 PlacedLights::ambient_on(const DVec3& normal) const {
    DVec3 sum = ambient;
    for (const Hemisphere& h : hemispheres) {
        const double seen = std::clamp((1 + dot3(normal, h.up)) / 2, 0.0, 1.0);
        sum = sum + h.sky * seen + h.ground * (1 - seen);
    }
    return sum;
}

PlacedLights placed(const std::vector<scene::Light>& lights, const scene::View& view,
                    const geom::Mesh& mesh) {
    PlacedLights all;
    for (const scene::Light& light : lights) {
        if (light.kind == scene::LightKind::ambient)
            all.ambient = all.ambient + DVec3(scene::in_view(light, view, mesh).colour);
        else if (light.kind == scene::LightKind::hemisphere)
            all.hemispheres.push_back(hemisphere_of(scene::in_view(light, view, mesh)));
        else if (!scene::is_black(light))
            all.others.emplace_back(light, view, mesh);
    }
    return all;
}

} // namespace scanout::trace
