// Colours of vertices as files give them: display values (sRGB), which is what Blender, three.js
// and Godot take them for in OBJ and PLY.
#pragma once

#include "base/warnings.h"
#include "math/vec.h"

#include <string>
#include <vector>

namespace scanout::io {

// Makes display values linear, in place. Values beyond 1 of which all are whole numbers up to 255
// are taken as bytes, with a warning; else they are cut at 1. Not finite and negative ones are 0.
void decode_vertex_colours(std::vector<Vec3>& colours, const std::string& path, Warnings& warnings);

} // namespace scanout::io
