// The user's rotation, scale and shift of the model, and the position of the camera: integers only,
// so that a million steps forth and back end where they began (HARD-CASES 22, 23, 25).
//
// World: right-handed, y up, the model's centre at the origin, 1 = the bounding radius.
#pragma once

#include "math/vec.h"

#include <cstdint>

namespace scanout::scene {

inline constexpr int kAngleUnitsPerDegree = 256;
inline constexpr int kFullTurn = 360 * kAngleUnitsPerDegree;
inline constexpr int kZoomLevelsPerOctave = 64; // scale = 2^(level / 64)
inline constexpr int kMaxZoomLevel = 20 * kZoomLevelsPerOctave;
inline constexpr int kPanUnitsPerRadius = 1 << 20;

// An angle in units, brought into [0, kFullTurn).
int wrap_angle(std::int64_t units);
// 2^(level / 64), exact at multiples of 64.
double zoom_scale(int level);
// level, kept within +-kMaxZoomLevel.
int clamp_zoom(std::int64_t level);

// The model's pose: yaw about its own up axis first, then pitch and roll about the screen's x and z
// axes; scale about the model's centre; then a shift in the plane of the screen (and in depth).
struct Pose {
    int yaw = 0, pitch = 0, roll = 0;             // angle units
    int zoom = 0;                                 // levels
    std::int64_t pan_x = 0, pan_y = 0, pan_z = 0; // pan units; x right, y up, z towards the eye
    friend bool operator==(const Pose&, const Pose&) = default;
};

// The camera's orbit about its target: azimuth turns counter-clockwise seen from above, 0 = front
// (+z side); elevation in [-90, 90] degrees; roll; the distance shrinks as zoom grows.
struct Orbit {
    int azimuth = 0, elevation = 0, roll = 0;
    int zoom = 0;
    std::int64_t pan_x = 0, pan_y = 0, pan_z = 0; // moves eye and target in the plane of the screen
    friend bool operator==(const Orbit&, const Orbit&) = default;
};

// A camera that flies: how it has moved and turned since it left the orbit. x right, y up, z back,
// along the axes of the camera on the orbit; azimuth turns it to the left about the world's up
// axis, elevation then lifts its sight.
struct Flight {
    std::int64_t x = 0, y = 0, z = 0; // pan units
    int azimuth = 0, elevation = 0;   // angle units
    friend bool operator==(const Flight&, const Flight&) = default;
};

int clamp_elevation(std::int64_t units); // [-90, 90] degrees

// Zooming by `levels` so that the point under the pointer stays there. pointer_*: world units in
// the plane of the screen through the model's centre, measured from where that centre appears when
// the pose has no pan (the picture's centre, unless the model or the camera was moved otherwise).
void zoom_towards(Pose& pose, int levels, double pointer_x, double pointer_y);

} // namespace scanout::scene
