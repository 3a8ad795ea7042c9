// The vertex that the pointer means: the nearest of those that are seen.
#pragma once

#include "app/view/pixel_place.h"
#include "geom/mesh.h"
#include "scene/view.h"

#include <cstdint>
#include <optional>

namespace scanout::app {

inline constexpr int kPickPixels = 24; // no vertex is farther away from the pointer

// Its number; nothing where none is near enough. Seen is what no triangle hides that it is no
// corner of: decided by exact predicates on positions in view space, whatever faces are culled or
// transparent. At equal distances the one nearer to the eye.
std::optional<std::uint32_t> seen_vertex(const geom::Mesh& mesh, const scene::View& view, int width,
                                         int height, PixelPlace at);

} // namespace scanout::app
