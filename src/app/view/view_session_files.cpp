// The session's part in models: reading them, what is said of their plan, the rungs that
// --budget and --max-error choose for them, and their hazards.
#include "app/message.h"
#include "app/view/view_session.h"
#include "frame/plan/ignored_options.h"

#include <algorithm>
#include <utility>

namespace scanout::app {

const std::string& ViewSession::path() const {
    return settings_.arguments[static_cast<std::size_t>(viewer_.state().file)];
}

Result<void> ViewSession::outcome() const {
    if (slot_.has_held_model() || slot_.error().empty()) return {};
    return fail(Exit::unreadable, "none of the {} models could be read; the last: {}",
                settings_.arguments.size(), slot_.error());
}

Result<void> ViewSession::load(bool again) {
    const Time start = std::chrono::steady_clock::now();
    Result<LoadedModel> model =
        fail(Exit::unreadable,
             "standard input cannot be read a second time; save it, and show the file");
    if (path() != "-" || !std::exchange(input_was_read_, true)) {
        model = load_model(path(), settings_, parts_.jobs,
                           [&](double share) { return report_progress("reading", share, start); });
    } else if (again) {
        refuse(model.error().what);
        return {}; // what is on show stays
    }
    if (quit_) return {};
    explain_.stop(); // the model that it explains is going
    accuracy_.stop();
    frontier_.stop();
    rungs_.clear();
    clock_.stop(); // the time that loading took does not turn the model
    if (watch_) watch_files(model ? *model : LoadedModel());
    if (!model) {
        const bool hopeless = settings_.arguments.size() == 1 && !again && !watch_;
        if (hopeless) return tl::unexpected(model.error());
        say("scanout: " + model.error().what);
        slot_.put_error(model.error().what);
        return {};
    }
    viewer_.take_file(again);
    if (!settings_.up_given) viewer_.take_up_of_file(model->up);
    slot_.put(*std::move(model), settings_.frame);
    follow_section();
    chosen_.reset();
    TRY_VOID(report_plan());
    if (settings_.limits.any()) TRY_VOID(choose_rungs());
    set_motion_levels();
    return {};
}

// The model is cut as the view says. What looks at the one before ends.
void ViewSession::follow_section() {
    const std::optional<scene::SectionSpec>& wanted = viewer_.state().look.section;
    if (slot_.model() == nullptr || slot_.model()->section == wanted) return;
    explain_.stop();
    accuracy_.stop();
    frontier_.stop();
    slot_.put_section(wanted, settings_.frame, parts_.jobs);
    const std::optional<scene::SceneSection>& made = slot_.model()->scene.section;
    if (const std::string line = made ? scene::remark(*made) : ""; !line.empty())
        show_message(line, kMessageSteps);
}

void ViewSession::watch_files(const LoadedModel& model) {
    std::vector<std::string> files = model.libraries;
    files.push_back(path());
    for (const scene::Texture& texture : model.scene.textures)
        files.push_back(texture.path);
    watch_->watch(files);
}

Result<void> ViewSession::follow_files(Time now) {
    if (!watch_) return {};
    constexpr std::chrono::milliseconds kSettles{150}; // exporters write several files
    if (watch_->take_changes()) reload_at_ = now + kSettles;
    if (!reload_at_ || now < *reload_at_) return {};
    reload_at_.reset();
    TRY_VOID(load(true));
    if (slot_.model() != nullptr) tell("read again: " + path());
    return {};
}

// Options that no technique answers to, and cameras that see nothing, are faults of the command.
Result<void> ViewSession::report_plan() {
    print_warnings(slot_.model()->warnings, settings_);
    TRY(const scene::View view, viewer_.view(*slot_.mesh()));
    set_frame_options();
    TRY(const frame::FramePlan* const plan, slot_.plan(frame_options_, view));
    if (settings_.verbose)
        for (const frame::Decision& decision : plan->decisions)
            say(to_string(decision));
    print_warnings(frame::ignored_options(*plan), settings_);
    return {};
}

// By the view that opens. What cannot be met is no fault: the nearest is shown.
Result<void> ViewSession::choose_rungs() {
    const Time start = std::chrono::steady_clock::now();
    TRY(const scene::View view, viewer_.view(*slot_.mesh()));
    set_frame_options();
    const frame::FrameOptions options = frame_options_;
    const auto progress = [&](std::string_view doing, double share) {
        report_progress(std::string(doing), share, start);
    };
    Result<Chosen> chosen =
        app::choose_rungs({slot_.model()->scene, slot_.facts(), view, options, free_axes(settings_),
                           parts_.jobs, settings_.max_memory_mb, progress, [&] { return quit_; }},
                          settings_.limits);
    if (quit_) return {};
    if (!chosen) {
        print_warnings({none_chosen(settings_.limits, chosen.error())}, settings_);
        return {};
    }
    print_warnings(chosen->notes, settings_);
    if (!chosen->choice.met()) print_warnings({chosen->instead}, settings_);
    if (!settings_.quiet) say(to_text(*chosen));
    chosen_ = *std::move(chosen);
    return {};
}

// While a file is read, or rungs are measured: a notice on the display once that takes long, and a
// look at the keys.
bool ViewSession::report_progress(const std::string& doing, double share, Time start) {
    if (parts_.instant) return true;
    constexpr std::chrono::milliseconds kPatience{300};
    const Time now = std::chrono::steady_clock::now();
    if (now - std::max(start, pacer_.last()) < kPatience) return true;
    if (wants_to_leave()) return false;
    if (!parts_.display.dispatch()) return true;
    lost_ = parts_.display.lost();
    if (lost_ || !parts_.display.ready()) return true;
    follow_size();
    Overlay notice;
    notice.notice = {fmt::format("{} {}  {} %", doing, path(), static_cast<int>(share * 100))};
    compose_on(picture_ != nullptr ? *picture_ : background_, notice);
    repaint_ = true;
    pacer_.interrupt(now);
    return present().has_value();
}

// Once a model.
void ViewSession::examine() {
    if (slot_.model() == nullptr || doctor_.knows(slot_.generation())) return;
    const Time start = std::chrono::steady_clock::now();
    doctor_.examine(path(), settings_, parts_.jobs, slot_.generation(), steady_,
                    [&](double share) { return report_progress("examining", share, start); });
    clock_.stop(); // the time that it took does not turn the model
    viewer_.set_hazards(doctor_.places());
}

bool ViewSession::wants_to_leave() {
    events_.clear();
    if (!parts_.input.dispatch(events_)) return true;
    for (const port::Event& event : events_) {
        const auto action = event.kind == port::EventKind::key && event.pressed
                                ? binder_.keys().find(event)
                                : std::optional<ActionId>();
        if (event.kind == port::EventKind::quit || action == ActionId::quit ||
            action == ActionId::close)
            quit_ = true;
    }
    return quit_;
}

} // namespace scanout::app
