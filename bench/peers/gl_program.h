// The shaders of a load: the same light as scanout's stages, written as GL programs write it.
#pragma once

#include "base/result.h"

#include <string>

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

namespace scanout::bench {

// What the shaders do besides writing depth.
struct GlFeatures {
    bool light = false;
    bool texture = false;   // instead of the plain colour
    bool shadow = false;    // asks the shadow map
    bool two_sided = false; // backs are drawn, and lit on the side that is seen
};

// A linked program; lives as long as the context. Exit::internal with the compiler's words.
Result<GLuint> make_program(const GlFeatures& features);

} // namespace scanout::bench
