// How surfaces reflect: the formulas of docs/GUIDE.md in double, written from their papers. Light
// of colour 1 that falls straight on a white matt surface shows 1: MTL leaves 1/pi out.
#pragma once

#include "math/vec.h"

#include <span>
#include <string_view>

namespace scanout::trace {

// What a surface is where a ray meets it.
struct Surface {
    DVec3 normal{0, 0, 1}; // unit
    DVec3 albedo{0}, specular{0};
    double shininess = 0;   // Ns
    bool highlight = false; // it has one, of whatever model
    bool physical = false;  // it says roughness or metalness: Ks and Ns do not count
    double roughness = 0.5, metalness = 0;
};

// What arrives there from a light that shines on it.
struct Arrival {
    DVec3 towards{0, 0, 1}; // unit, from the surface
    DVec3 colour{0};
};

// Linear light towards the eye, a unit vector from the surface.
using Reflection = DVec3 (*)(const Surface& surface, const DVec3& eye, const DVec3& ambient,
                             std::span<const Arrival> lights);

// By the name of a technique; null where there is none.
Reflection find_reflection(std::string_view name);

} // namespace scanout::trace
