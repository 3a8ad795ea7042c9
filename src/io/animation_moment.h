// A moment of one of a file's animations: what a reader of a format that has some is asked for.
#pragma once

#include "math/vec.h"

#include <optional>
#include <string>
#include <utility>

namespace scanout::io {

using Reach = std::pair<DVec3, DVec3>; // a box: its least and greatest corner, file coordinates

struct AnimationMoment {
    std::string name; // or its number
    double seconds = 0;
    std::optional<Reach> reach; // of all its moments, where an earlier reading has found it
};

} // namespace scanout::io
