// What a place of a surface shows [Compendium 11.1], [Primer 7]: light from everywhere, Lambert's
// law, and Blinn's highlight.
#pragma once

#include "math/vec.h"
#include "scene/light.h"

#include <vector>

namespace scanout::textbook {

struct Surface {
    DVec3 place{0};        // in view space
    DVec3 normal{0, 0, 1}; // unit
    DVec3 to_eye{0, 0, 1}; // unit
    DVec3 diffuse{0}, specular{0};
    double shininess = 0;
    bool highlight = false;
};
// Linear. `scale`: of the lights' lengths over view space's (scene::to_floats).
DVec3 light_from(const std::vector<scene::ViewLight>& lights, double scale, const Surface& surface);

DVec3 unit(const DVec3& v); // of what has no length: the way to the eye

} // namespace scanout::textbook
