#include "app/moving/moment.h"

#include "app/model_file.h"

namespace scanout::app {

double seconds_of(const Settings& s, int picture) {
    if (s.range) return static_cast<double>(s.range->first + picture) / s.fps;
    return s.time.value_or(0);
}

Moment moment_of(const Settings& s, const scene::CameraOptions& at_rest, double seconds) {
    Moment moment{s.model, at_rest};
    if (s.motion) s.motion->move(seconds, moment.model, moment.camera);
    return moment;
}

void put_lights(const Settings& s, double seconds, std::vector<scene::Light>& out) {
    out = s.frame.lights; // reuses its memory
    if (s.motion) s.motion->move_lights(seconds, out);
}

Result<scene::View> view_at_time(Settings& s, const LoadedModel& model) {
    const double seconds = seconds_of(s, 0);
    const Moment now = moment_of(s, fitted_camera_of(s, model), seconds);
    if (s.motion) s.motion->move_lights(seconds, s.frame.lights);
    return scene::make_view(model.scene.mesh, now.model, {}, now.camera, {}, s.frame.width,
                            s.frame.height);
}

Result<FrameRange> whole(const scene::Motion& motion, int fps) {
    constexpr int kMost = 100'000;
    const double frames = motion.duration * fps;
    if (!(frames < kMost))
        return fail(Exit::usage,
                    "all of the motion are {:.0f} frames; say which by --frames A..B, {} at most",
                    frames, kMost);
    // The last frame of a loop is the one before it begins again.
    const int last = static_cast<int>(frames + (motion.loops ? 0.5 : 0)) - (motion.loops ? 1 : 0);
    return FrameRange{0, last > 0 ? last : 0};
}

} // namespace scanout::app
