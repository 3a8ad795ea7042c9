// Lights: as the user describes them, and as a frame sees them in view space. Each has a size, 0 by
// default, that only soft shadows read.
//
// Brightness: a surface that faces the light receives colour * power. A light at a place falls off
// with the square of the distance and is that bright at the model's centre, or one bounding radius
// away where it stands nearer than that: Lambert 1760, [Primer 7].
#pragma once

#include "geom/mesh.h"
#include "math/vec.h"
#include "scene/pose.h"
#include "scene/view.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::scene {

// ambient and hemisphere: from everywhere; a hemisphere's colour goes from that of its sky,
// straight on, to that of its ground on what faces away.
enum class LightKind : std::uint8_t { ambient, hemisphere, directional, point, spot };
inline constexpr int kLightKinds = 5;
// What a light is fixed to. world: to the model's file. camera: to the camera, axes x right, y up,
// z towards the eye; positions are in bounding radii from the eye.
enum class LightFrame : std::uint8_t { world, camera };
enum class LightShape : std::uint8_t { sphere, square };

struct Light {
    std::string name;
    LightKind kind = LightKind::directional;
    LightFrame frame = LightFrame::world;
    // directional: from the surface to the light; hemisphere: to the middle of its sky. Any length
    // but 0.
    DVec3 towards{0, 0, 1};
    DVec3 position{0};           // point, spot
    std::optional<DVec3> target; // spot: the point it aims at; none: the model's centre
    double inner_degrees = 20,
           outer_degrees = 30; // spot: full inside, nothing outside; half angles
    Vec3 colour{1};            // linear; of a hemisphere's sky
    Vec3 ground{0.25F};        // linear; of a hemisphere
    double power = 1;
    // Radius of the sphere or half the side of the square, in the units of the position;
    // directional: degrees from its middle to its rim. 0: a point.
    double size = 0;
    LightShape shape = LightShape::sphere;
    bool casts = true; // may throw shadows
    friend bool operator==(const Light&, const Light&) = default;
};

inline constexpr std::size_t kMaxLights = 32;
inline constexpr double kMaxRimDegrees = 80; // of a directional light's size
inline constexpr double kMaxPower = 1e4;
inline constexpr float kAmbient = 0.15F; // of Kd

// No light arrives from it.
bool is_black(const Light& light);
std::string_view name_of(LightKind kind);

// Light from everywhere, so that it throws no shadow.
inline bool is_ambient(LightKind kind) {
    return kind == LightKind::ambient || kind == LightKind::hemisphere;
}

// The look of a model where nobody asks for another one: a strong key light from above left, a weak
// fill from the right, and light from the sky and, less, from the ground; all fixed to the camera.
const std::vector<Light>& default_lights();
// As little as shows a form: a key light from above left and a weaker fill from the right, both
// fixed to the camera and behind the eye; and ambient light.
const std::vector<Light>& plain_lights();

// A light's movement by the user: about the model's centre, or about the eye for a light fixed to
// the camera; up is the world's or the camera's. Integers, so that forth and back end where they
// began; without a move every bit of the light stays.
struct LightMove {
    int azimuth = 0, elevation = 0; // angle units (pose.h)
    int level = 0;                  // zoom levels: power * zoom_scale(level)
    friend bool operator==(const LightMove&, const LightMove&) = default;
};
Light moved(const Light& light, const LightMove& move, UpAxis up, const geom::Mesh& mesh);

// The light's position as the camera's azimuth and elevation, in degrees.
struct LightPlace {
    double azimuth_degrees = 0, elevation_degrees = 0;
};
LightPlace place_of(const Light& light, UpAxis up, const geom::Mesh& mesh);

// A light in view space, made once a frame; lengths are times to_floats(view), like positions of
// lanes.
struct ViewLight {
    Vec3 towards{0, 0, 1}; // directional, hemisphere: unit, as Light says
    Vec3 colour{1};        // linear; times the power
    Vec3 ground{0};        // likewise; of a hemisphere
    LightKind kind = LightKind::directional;
    Vec3 position{0};    // point, spot
    float reach = 1;     // distance at which `colour` arrives
    float nearest = 0;   // nearer than this it gets no brighter
    Vec3 axis{0, 0, -1}; // spot: unit, the direction of its cone
    float cos_inner = 1, cos_outer = 1;
    float size = 0; // bounding radii; directional: tangent of the angle
    LightShape shape = LightShape::sphere;
    bool casts = false;
    std::uint32_t source = 0; // index of its Light
};
ViewLight in_view(const Light& light, const View& view, const geom::Mesh& mesh);

} // namespace scanout::scene
