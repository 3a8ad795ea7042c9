// Colours of vertices, which files give as display values (sRGB): Blender, three.js and Godot also
// read OBJ and PLY so.
#pragma once

#include "base/warnings.h"
#include "math/vec.h"

#include <string>
#include <vector>

namespace scanout::io {

// Less linear light than this is read as none: no display shows the difference, and arithmetic on
// denormal numbers doubles the time of a frame (HARD-CASES 64).
inline constexpr double kDarkest = 0x1p-60;

// Makes display values linear, in place. If some exceed 1 and all are whole numbers up to 255, they
// are read as bytes, with a warning; otherwise they are clamped to 1. NaN and negative ones are 0.
void decode_vertex_colours(std::vector<Vec3>& colours, const std::string& path, Warnings& warnings);

} // namespace scanout::io
