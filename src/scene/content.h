// What a picture of a scene depends on, as one number: for what is remembered about a model from
// one run of the program to the next.
#pragma once

#include "scene/scene.h"

#include <cstdint>

namespace scanout::scene {

// XXH64 of mesh, materials and textures, wherever they come from: two files with the same content
// have the same one. About a millisecond for 10 MB. Not the same on machines of another byte order.
std::uint64_t content_hash(const Scene& scene);

} // namespace scanout::scene
