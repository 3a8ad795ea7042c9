// What a motion's file can move, one row each: the file's names, how many numbers, their range, and
// the lights that have it.
#pragma once

#include "scene/motion/motion.h"

#include <cstddef>
#include <span>
#include <string_view>

namespace scanout::app {

struct MovedRow {
    std::string_view group; // model, camera, light
    std::string_view name;
    scene::Moved moved;
    std::size_t width;      // numbers a key
    double min, max;        // of each
    std::string_view value; // as a file says it
    unsigned lights = 0;    // bits of LightKind
};

std::span<const MovedRow> moved_rows();

} // namespace scanout::app
