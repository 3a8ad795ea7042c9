// --motion FILE: what moves, in TOML, by the names of the options (docs/MOTION.md).
//
//     end = "loop"                     # or "hold"; duration = SECONDS, else until the last key
//     [model.rotate]                   # model, camera, light.NAME; then what of it moves
//     by = "spline"                    # step linear slerp spline hermite
//     ease = "in-out"                  # none in out in-out; a key may have its own
//     keys = [{ time = 0, value = [0, 0, 0] }, { time = 2, value = [0, 90, 0] }]
#pragma once

#include "app/options/settings.h"
#include "base/result.h"
#include "base/warnings.h"
#include "scene/motion/motion.h"

#include <string>
#include <string_view>
#include <vector>

namespace scanout::app {

// Of a file's text; `path` stands in messages. Exit::unreadable for every mistake: its place, what
// is wrong, what to do. Lights are those of the options, found by their names.
Result<scene::Motion> parse_motion(std::string_view text, const std::string& path,
                                   const scene::CameraOptions& camera,
                                   const std::vector<scene::Light>& lights, Warnings& warnings);

// Reads the file that --motion names into the settings, with warnings on standard error. Nothing
// to do without one.
Result<void> read_motion(Settings& settings);

} // namespace scanout::app
