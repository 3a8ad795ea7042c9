// The session's part in what is shown of accuracy: when the reference is made, and of which
// picture.
#include "app/message.h"
#include "app/picture/reference.h"
#include "app/view/view_session.h"
#include "measure/ladder.h"

#include <algorithm>
#include <array>
#include <utility>

namespace scanout::app {

// Where the user named a rung, it is what he wants to see.
bool ViewSession::converges(const Settings& settings) {
    if (settings.converge != Converge::automatic) return settings.converge == Converge::on;
    const std::vector<std::string_view> axes = measure::ladder_axes();
    return std::none_of(axes.begin(), axes.end(), [&](std::string_view axis) {
        return settings.named_axes.count(axis) != 0;
    });
}

AccuracyView::Asked ViewSession::asked() const {
    const ViewerState& state = viewer_.state();
    // The rungs that keys chose are what the user wants to see, as those of the command line are;
    // so are edges, annotations and false colours, which the reference does not draw.
    const bool chosen = rungs_.point() != nullptr;
    const Look& look = state.look;
    const bool annotated =
        look.edges != "none" || look.colour_by != "light" || !look.annotations.empty();
    // So are techniques that keys switched; the reference has the tone curve that is drawn.
    const std::array<std::string, kSwitchedAxes.size()>& named = look.rendering.asked;
    bool switched = false;
    for (std::size_t i = 0; i < named.size(); ++i)
        switched = switched || (kSwitchedAxes[i] != "tone" && !frame::is_auto(named[i]));
    const bool kept =
        settings_.converge == Converge::automatic && (chosen || annotated || switched);
    return {converges_ && !kept, state.error_map, state.split, state.split_x};
}

// Nothing else is to be done, and the picture is such that there can be a reference.
bool ViewSession::wants_trace() {
    return level_ == 0 && accuracy_.lacks() && slot_.model() != nullptr && !blank_ && !lost_ &&
           parts_.display.ready() && !viewer_.turning() && !wants_row() && !wants_frame();
}

// Short, so that keys are heard in between.
Result<void> ViewSession::trace_step() {
    constexpr std::chrono::milliseconds kStep{8};
    if (!accuracy_.has_begun()) return begin_reference();
    accuracy_.convergence().step(parts_.jobs, std::chrono::steady_clock::now() + kStep);
    accuracy_.refresh(*picture_, std::chrono::steady_clock::now());
    return {};
}

Result<void> ViewSession::begin_reference() {
    const scene::Scene& scene = slot_.model()->scene;
    TRY(const scene::View view, viewer_.view(*slot_.mesh()));
    TRY(const frame::FramePlan* const now, plan());
    const Result<trace::Look> look = look_of(*now);
    if (!look) return refuse_reference(look.error().what);
    if (scene.mesh.lines() + scene.mesh.points() != 0)
        return refuse_reference("it draws no lines and points, which this model has");
    if (const auto fits =
            check_reference_fits(scene, viewer_.width(), viewer_.height(), settings_.max_memory_mb);
        !fits)
        return refuse_reference(fits.error().what);
    accuracy_.begin(scene, view, *look, key());
    return {};
}

// Of a script: all at once, where a picture is kept.
Result<void> ViewSession::finish_reference() {
    const Time now = std::chrono::steady_clock::now();
    if (!asked().any() || slot_.model() == nullptr || viewer_.turning()) return {};
    accuracy_.follow(key(), now);
    if (!accuracy_.lacks() || !viewer_.view(*slot_.mesh())) return {};
    TRY_VOID(render());
    if (blank_) return {};
    TRY_VOID(begin_reference());
    accuracy_.convergence().finish(parts_.jobs);
    accuracy_.refresh(*picture_, now);
    return {};
}

void ViewSession::refuse(const std::string& why) {
    if (!settings_.quiet) say("scanout: " + why);
    show_message(why, kMessageSteps);
}

// Once for each model.
Result<void> ViewSession::refuse_reference(const std::string& why) {
    accuracy_.refuse(key(), why);
    if (std::exchange(refusal_told_, slot_.generation()) == slot_.generation()) return {};
    refuse("no reference: " + why);
    return {};
}

} // namespace scanout::app
