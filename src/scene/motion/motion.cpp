#include "scene/motion/motion.h"

#include "base/check.h"
#include "math/quaternion.h"
#include "math/rotation.h"

#include <algorithm>
#include <array>

namespace scanout::scene {
namespace {

constexpr std::size_t kMostNumbers = 4;
constexpr double kLeastFov = 0.1, kMostFov = 175; // as --fov
constexpr double kLeastDistance = 0x1p-20;        // bounding radii

using Numbers = std::array<double, kMostNumbers>;

DVec3 vector_of(const Numbers& n) {
    return {n[0], n[1], n[2]};
}
Vec3 colour_of(const Numbers& n) {
    Vec3 colour;
    for (int i = 0; i < 3; ++i)
        colour[i] = static_cast<float>(std::clamp(n[static_cast<std::size_t>(i)], 0.0, 1.0));
    return colour;
}

void move_model(Moved moved, const Numbers& n, ModelTransform& model) {
    switch (moved) {
    case Moved::translate:
        model.moved += vector_of(n);
        break;
    case Moved::scale:
        model.scale *= vector_of(n);
        break;
    case Moved::rotate:
        model.turn = rotation_z(n[2]) * rotation_y(n[1]) * rotation_x(n[0]);
        break;
    case Moved::turn:
        model.turn = matrix_of({n[0], n[1], n[2], n[3]});
        break;
    default:
        break;
    }
}

void move_camera(Moved moved, const Numbers& n, CameraOptions& camera) {
    switch (moved) {
    case Moved::azimuth:
        camera.azimuth_degrees = n[0];
        break;
    case Moved::elevation:
        camera.elevation_degrees = std::clamp(n[0], -90.0, 90.0);
        break;
    case Moved::distance:
        camera.distance = std::max(n[0], kLeastDistance);
        break;
    case Moved::shift:
        camera.shift += DVec2(n[0], n[1]);
        break;
    case Moved::fov:
        camera.fov_degrees = std::clamp(n[0], kLeastFov, kMostFov);
        break;
    case Moved::eye:
        camera.eye = vector_of(n);
        break;
    case Moved::look_at:
        camera.target = vector_of(n);
        break;
    default:
        break;
    }
}

void move_light(Moved moved, const Numbers& n, Light& light) {
    switch (moved) {
    case Moved::at:
        (light.kind == LightKind::point || light.kind == LightKind::spot ? light.position
                                                                         : light.towards) =
            vector_of(n);
        break;
    case Moved::to:
        light.target = vector_of(n);
        break;
    case Moved::cone:
        light.inner_degrees = std::clamp(n[0], 0.0, 180.0);
        light.outer_degrees = std::clamp(n[1], light.inner_degrees, 180.0);
        break;
    case Moved::colour:
        light.colour = colour_of(n);
        break;
    case Moved::ground:
        light.ground = colour_of(n);
        break;
    case Moved::power:
        light.power = std::clamp(n[0], 0.0, kMaxPower);
        break;
    case Moved::size:
        light.size = std::max(n[0], 0.0);
        break;
    default:
        break;
    }
}

template <class Use>
void each_value(const Motion& motion, double seconds, bool of_lights, Use use) {
    const double now = motion.local(seconds);
    for (const MotionTrack& track : motion.tracks) {
        if (is_of_light(track.moved) != of_lights) continue;
        Numbers numbers{};
        track.track.at(now, std::span(numbers).first(track.track.width()));
        use(track, numbers);
    }
}

} // namespace

double Motion::local(double seconds) const {
    return loops ? wrapped_time(seconds, duration) : std::clamp(seconds, 0.0, duration);
}

bool Motion::has_lights() const {
    return std::any_of(tracks.begin(), tracks.end(),
                       [](const MotionTrack& track) { return is_of_light(track.moved); });
}

Motion Motion::without_camera() const {
    Motion others = *this;
    std::erase_if(others.tracks,
                  [](const MotionTrack& track) { return is_of_camera(track.moved); });
    return others;
}

void Motion::move(double seconds, ModelTransform& model, CameraOptions& camera) const {
    each_value(*this, seconds, false, [&](const MotionTrack& track, const Numbers& numbers) {
        move_model(track.moved, numbers, model);
        move_camera(track.moved, numbers, camera);
    });
}

void Motion::move_lights(double seconds, std::vector<Light>& lights) const {
    each_value(*this, seconds, true, [&](const MotionTrack& track, const Numbers& numbers) {
        CHECK_LT(track.light, lights.size());
        move_light(track.moved, numbers, lights[track.light]);
    });
}

} // namespace scanout::scene
