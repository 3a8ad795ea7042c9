// The moments of a motion that a command draws.
#pragma once

#include "app/options/settings.h"
#include "base/result.h"

#include <vector>

namespace scanout::app {

struct LoadedModel;

// Of a picture of the run: --time, or its frame's. 0 without a motion.
double seconds_of(const Settings& settings, int picture);

// What the options say, and a motion makes of it.
struct Moment {
    scene::ModelTransform model;
    scene::CameraOptions camera;
};
Moment moment_of(const Settings& settings, const scene::CameraOptions& at_rest, double seconds);
// The lights of the options at that moment, in the room of `out`.
void put_lights(const Settings& settings, double seconds, std::vector<scene::Light>& out);

// The view of --time's moment; the settings' lights become those of that moment. For commands that
// look at one picture.
Result<scene::View> view_at_time(Settings& settings, const LoadedModel& model);

// All of its frames, where they are wanted and nothing says which: Exit::usage where those are too
// many.
Result<FrameRange> whole(const scene::Motion& motion, int fps);

} // namespace scanout::app
