#include "scene/light.h"

#include "math/rotation.h"
#include "math/transcendental.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace scanout::scene {
namespace {

// Beyond this many bounding radii a light's rays are parallel to the last bit of a direction.
constexpr double kFarthest = 0x1p24;
constexpr double kNearest = 0x1p-10; // nearer, a point light gets no brighter

// `v`, shortened to kFarthest; also of infinities.
DVec3 within_reach(DVec3 v) {
    constexpr double kLimit = std::numeric_limits<double>::max();
    double largest = 0;
    for (int i = 0; i < 3; ++i) {
        v[i] = v[i] > -kLimit ? (v[i] < kLimit ? v[i] : kLimit) : -kLimit;
        largest = std::max(largest, std::abs(v[i]));
    }
    if (largest > 0x1p100) v = v / largest * 0x1p100;
    const double length = scanout::sqrt(dot3(v, v));
    return length > kFarthest ? v * (kFarthest / length) : v;
}

struct Placer {
    const Light& light;
    const View& view;
    const geom::Mesh& mesh;
    bool on_camera() const { return light.frame == LightFrame::camera; }

    DVec3 place(const DVec3& at) const {
        if (on_camera()) return within_reach(at);
        return view.world_axes * within_reach(radii_from_centre(mesh, at)) + view.world_origin;
    }
    // The length does not matter. A direction in the camera's frame is not rotated, and so not
    // rounded.
    DVec3 direction(const DVec3& towards) const {
        const DVec3 unit = normalized(within_reach(towards));
        return on_camera() ? unit : view.world_axes * unit;
    }
    DVec3 aim() const {
        if (light.target) return place(*light.target);
        return on_camera() ? light.position + DVec3(0, 0, -1) : view.world_origin;
    }
    double size() const {
        const double radii = light.size > 0 && !on_camera() ? radii_per_unit(mesh) : 1;
        const double size = light.size * radii;
        return size < kFarthest ? size : kFarthest;
    }
};

} // namespace

bool is_black(const Light& light) {
    const bool no_ground = light.kind != LightKind::hemisphere || light.ground == Vec3(0);
    return !(light.power > 0) || (light.colour == Vec3(0) && no_ground);
}

std::string_view name_of(LightKind kind) {
    constexpr std::array<std::string_view, kLightKinds> kNames = {"ambient", "hemisphere",
                                                                  "directional", "point", "spot"};
    return kNames[static_cast<std::size_t>(kind)];
}

namespace {

// Fixed to the camera; casts no shadow.
Light on_camera(const char* name, const DVec3& towards, double power,
                LightKind kind = LightKind::directional) {
    Light light;
    light.name = name;
    light.kind = kind;
    light.frame = LightFrame::camera;
    light.towards = towards;
    light.power = power;
    light.casts = false;
    return light;
}

} // namespace

const std::vector<Light>& default_lights() {
    // Far enough to the side that the shade of a round body shows. Together they are at most white.
    static const std::vector<Light> lights = {
        on_camera("key", {-5, 5, 4}, 0.8), on_camera("fill", {6, -2, 3}, 0.08),
        on_camera("hemisphere", {0, 1, 0}, 0.18, LightKind::hemisphere)};
    return lights;
}

const std::vector<Light>& plain_lights() {
    static const std::vector<Light> lights = [] {
        Light ambient;
        ambient.name = "ambient";
        ambient.kind = LightKind::ambient;
        ambient.power = 0.15;
        ambient.casts = false;
        return std::vector<Light>{on_camera("key", {-2, 3, 6}, 0.80),
                                  on_camera("fill", {6, -2, 3}, 0.15), ambient};
    }();
    return lights;
}

ViewLight in_view(const Light& light, const View& view, const geom::Mesh& mesh) {
    const Placer placer{light, view, mesh};
    ViewLight placed;
    placed.kind = light.kind;
    placed.shape = light.shape;
    placed.casts = light.casts && !is_ambient(light.kind);
    const double power = std::clamp(light.power, 0.0, kMaxPower);
    placed.colour = Vec3(DVec3(light.colour) * power);
    if (light.kind == LightKind::ambient) return placed;
    if (light.kind == LightKind::hemisphere) {
        placed.ground = Vec3(DVec3(light.ground) * power);
        placed.towards = Vec3(placer.direction(light.towards));
        return placed;
    }
    if (light.kind == LightKind::directional) {
        placed.towards = Vec3(placer.direction(light.towards));
        const double rim = std::clamp(light.size, 0.0, kMaxRimDegrees);
        placed.size = static_cast<float>(sin_degrees(rim) / cos_degrees(rim));
        return placed;
    }
    const DVec3 position = placer.place(light.position);
    const DVec3 to_centre = view.world_origin - position;
    const double unit = to_floats(view);
    placed.position = Vec3(position * unit);
    placed.reach =
        static_cast<float>(std::max(scanout::sqrt(dot3(to_centre, to_centre)), 1.0) * unit);
    placed.size = static_cast<float>(placer.size() * unit);
    // Its square must not be 0: shares are divided by it.
    placed.nearest =
        static_cast<float>(std::max(std::max(placer.size(), kNearest) * unit, 0x1p-50));
    if (light.kind == LightKind::spot) {
        placed.axis = Vec3(normalized(placer.aim() - position, DVec3(0, 0, -1)));
        // A cone of half a turn also holds directions that rounding puts behind the light.
        const auto cosine = [](double degrees) {
            return degrees < 180 ? static_cast<float>(cos_degrees(degrees)) : -2.0F;
        };
        placed.cos_inner = cosine(light.inner_degrees);
        placed.cos_outer = cosine(light.outer_degrees);
    }
    return placed;
}

} // namespace scanout::scene
