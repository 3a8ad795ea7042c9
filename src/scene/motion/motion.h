// A scene at time t: tracks for the model's place, the camera and the lights, over what the options
// say of them. A pure function of time: no state, the same bits for the same second.
#pragma once

#include "scene/light.h"
#include "scene/motion/track.h"
#include "scene/view.h"

#include <cstdint>
#include <vector>

namespace scanout::scene {

// What a track moves, and the numbers that it has. The model's tracks act on what the options made
// of it: it is scaled further, then turned further, then moved further; so is the camera's shift.
// The others take the place of the option's value.
enum class Moved : std::uint8_t {
    translate, // 3, bounding radii
    rotate,    // 3, degrees about x, y, z, in this order
    turn,      // 4, a quaternion: the same as rotate
    scale,     // 3
    azimuth,   // 1, degrees
    elevation, // 1, degrees
    distance,  // 1, bounding radii
    shift,     // 2, bounding radii
    fov,       // 1, degrees
    eye,       // 3, file coordinates
    look_at,   // 3, file coordinates
    at,        // 3, of a light: its position, or where it comes from
    to,        // 3, what a spot aims at
    cone,      // 2, degrees
    colour,    // 3, linear
    ground,    // 3, linear
    power,     // 1
    size       // 1
};
constexpr bool is_of_camera(Moved moved) {
    return moved >= Moved::azimuth && moved <= Moved::look_at;
}
constexpr bool is_of_light(Moved moved) {
    return moved >= Moved::at;
}

struct MotionTrack {
    Moved moved;
    std::size_t light = 0; // index into the lights
    Track track;
};

struct Motion {
    std::vector<MotionTrack> tracks;
    double duration = 0; // seconds
    bool loops = false;  // after that it begins again; else it stays as it is then

    // A time within the duration: the last moment beyond the end, or that of another round.
    double local(double seconds) const;
    bool has_lights() const;
    Motion without_camera() const;
    // What the options say -> the same at a time. Tracks whose curve leaves what the option may say
    // stop there.
    void move(double seconds, ModelTransform& model, CameraOptions& camera) const;
    void move_lights(double seconds, std::vector<Light>& lights) const;
};

} // namespace scanout::scene
