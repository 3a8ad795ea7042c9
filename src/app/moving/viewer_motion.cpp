// The viewer's part in a motion: which moment is shown, and when it goes on.
#include "app/view/viewer.h"
#include "math/bits.h"

#include <fmt/format.h>

namespace scanout::app {

std::optional<double> Viewer::motion_time() const {
    if (!motion_) return std::nullopt;
    const double seconds =
        motion_start_ + static_cast<double>(state_.look.motion_steps) / kStepsPerSecond;
    return motion_->local(seconds);
}

// A view that a key has chosen is not the motion's: the model alone moves.
const scene::Motion* Viewer::motion() const {
    const std::optional<scene::Motion>& seen = state_.look.view < 0 ? motion_ : of_model_;
    return seen ? &*seen : nullptr;
}

Moment Viewer::moment(const geom::Mesh& mesh) const {
    Moment now{model(), fitted_camera(mesh)};
    if (motion() != nullptr) motion()->move(*motion_time(), now.model, now.camera);
    return now;
}

// At its end it begins again.
void Viewer::toggle_playing() {
    Look& look = state_.look;
    look.plays = !look.plays;
    if (look.plays && !motion_->loops && *motion_time() >= motion_->duration)
        look.motion_steps = -static_cast<std::int64_t>(motion_start_ * kStepsPerSecond + 0.999);
    answer_ = fmt::format("motion: {} at {:.2f} s", look.plays ? "plays" : "rests", *motion_time());
}

void Viewer::play(std::int64_t steps) {
    state_.look.motion_steps += steps;
    if (!motion_->loops && *motion_time() >= motion_->duration) state_.look.plays = false;
}

} // namespace scanout::app
