// Lights. Today: directional, fixed to the camera.
#pragma once

#include "math/vec.h"

#include <array>

namespace scanout::scene {

struct Light {
    Vec3 towards; // unit, view space: from the surface to the light
    Vec3 colour;  // linear
};

inline constexpr float kAmbient = 0.15F; // of Kd (DESIGN 1)

// The default light: a key from above left and a weaker fill from the right, both behind the eye.
const std::array<Light, 2>& default_lights();

} // namespace scanout::scene
