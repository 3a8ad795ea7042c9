// Inertia: what a drag has turned goes on turning when the button goes up, and comes to rest. On
// the virtual clock, in whole numbers: the same in every run.
#include "app/view/viewer.h"

#include <cstdlib>

namespace scanout::app {
namespace {

constexpr int kPartsOfAUnit = 16; // of an angle unit: speeds are that fine
constexpr int kLost = 16;         // a step takes the 16th part of the speed
constexpr std::int64_t kLongestRest =
    4; // steps: a hand that rests before it lets go throws nothing

// These change nothing that turns.
bool leaves_spin(ActionId id) {
    return id == ActionId::pointer || id == ActionId::frame || id == ActionId::drag_end ||
           id == ActionId::screenshot || id == ActionId::print_view ||
           id == ActionId::toggle_help || id == ActionId::toggle_info;
}

} // namespace

void Viewer::follow_turn(std::int64_t right, std::int64_t up) {
    Turn& last = drag_->last;
    if (step_ != last.step) drag_->earlier = last;
    last = {step_, right, up};
}

void Viewer::stop_spin(ActionId id) {
    if (!leaves_spin(id)) spin_ = {};
}

bool Viewer::follows_hand() const {
    return inertia_ && drag_ && drag_->turns && step_ - drag_->last.step <= kLongestRest;
}

void Viewer::throw_off() {
    if (!inertia_ || !drag_ || !drag_->turns) return;
    const Turn &from = drag_->earlier, &to = drag_->last;
    const std::int64_t steps = to.step - from.step;
    if (steps <= 0 || steps > kLongestRest || step_ - to.step > kLongestRest) return;
    spin_ = {state_.camera_mode, (to.right - from.right) * kPartsOfAUnit / steps,
             (to.up - from.up) * kPartsOfAUnit / steps, 0, 0};
    rest_if_slow();
}

void Viewer::rest_if_slow() {
    if (std::abs(spin_.right) < kPartsOfAUnit && std::abs(spin_.up) < kPartsOfAUnit) spin_ = {};
}

// A step of the clock.
void Viewer::spin() {
    const auto whole = [](std::int64_t& rest, std::int64_t speed) {
        rest += speed;
        const std::int64_t units = rest / kPartsOfAUnit;
        rest -= units * kPartsOfAUnit;
        return units;
    };
    const std::int64_t right = whole(spin_.rest_right, spin_.right),
                       up = whole(spin_.rest_up, spin_.up);
    Look& look = state_.look;
    if (spin_.camera) {
        look.orbit.azimuth = scene::wrap_angle(look.orbit.azimuth - right);
        look.orbit.elevation = clamped_elevation(look.orbit.elevation + up);
    } else {
        look.pose.yaw = scene::wrap_angle(look.pose.yaw + right);
        look.pose.pitch = scene::wrap_angle(look.pose.pitch + up);
    }
    spin_.right -= spin_.right / kLost;
    spin_.up -= spin_.up / kLost;
    rest_if_slow();
}

} // namespace scanout::app
