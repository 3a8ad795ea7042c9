// The option --light: text -> lights.
//
//     none | key | fill | KIND[:VALUE][:NAME=VALUE]...
//     ambient[:POWER]  directional:X,Y,Z  point:X,Y,Z  spot:X,Y,Z  camera[:X,Y,Z]
//     colour= power= size= shape=sphere|square shadow=on|off frame=world|camera name=
//     spot: to=X,Y,Z cone=INNER,OUTER
#pragma once

#include "base/result.h"
#include "scene/light.h"

#include <string_view>
#include <vector>

namespace scanout::app {

// Changes the lights as one --light does. The first one (`first`) replaces the default lights; the
// ambient light stays until one is named, and "none" takes it as well. An error is the second half
// of a line.
Result<void> add_light(std::vector<scene::Light>& lights, bool first, std::string_view spec);

} // namespace scanout::app
