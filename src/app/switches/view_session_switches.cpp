// The session's part in live switches: what the plan makes of them.
#include "app/switches/switch_note.h"
#include "app/view/view_session.h"

namespace scanout::app {

// A technique that no plan can hold here is passed over, and the plan's error says why.
Result<void> ViewSession::follow_switch(const Action& action) {
    if (slot_.model() == nullptr) return {};
    const int place = static_cast<int>(action.id) - static_cast<int>(ActionId::shading_next);
    const auto axis = static_cast<std::size_t>(place / 2);
    std::string passed;
    Result<const frame::FramePlan*> now = plan();
    constexpr int kTries = 32; // more than an axis has techniques
    for (int i = 0; i < kTries && !now; ++i) {
        passed = fmt::format("{}: {}\n", viewer_.answer(), now.error().what);
        viewer_.apply({action.id, {}, {}, true}, slot_.mesh()); // undone together with the first
        now = plan();
    }
    if (!now) return tl::unexpected(now.error());
    const std::string note =
        axis < kSwitchedAxes.size() ? switch_note(**now, kSwitchedAxes[axis]) : std::string();
    show_message(passed + viewer_.answer() + note, kMessageSteps);
    set_motion_levels();
    return {};
}

// Without those of axes that keys switched after the last step on the frontier.
std::vector<measure::Rung> ViewSession::counting_rungs(const measure::KnownPoint& point) const {
    std::vector<measure::Rung> rungs;
    for (const measure::Rung& rung : point.rungs)
        if (!counts_before_rung(viewer_.state().look.rendering, rung.axis)) rungs.push_back(rung);
    return rungs;
}

} // namespace scanout::app
