// The eye's position in mesh coordinates, and how it sees a plane there.
#pragma once

#include "geom/planes.h"
#include "math/vec.h"
#include "scene/view.h"

#include <optional>

namespace scanout::frame {

// False in a view without a near plane, as a plan gives that knows no view: the eye may be
// anywhere.
bool is_known(const scene::View& view);
// The eye in mesh coordinates; w is 0 in an orthographic view, whose eye is a direction. Nothing
// where the model is flattened. geom::height(eye, plane) > 0: the eye sees the plane's front.
std::optional<DVec4> eye_of(const scene::View& view);
// The same; nothing in a view that is not known, too.
std::optional<DVec4> known_eye_of(const scene::View& view);
// The length of a plane that a pixel spans, relative to a plane that faces the eye: 1 / cos of the
// angle between ray and normal, at most over points no farther than `farthest` (view space) from
// the eye.
double slant(const geom::Plane& plane, const scene::View& view, double farthest);

} // namespace scanout::frame
