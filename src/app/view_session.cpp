#include "app/view_session.h"

#include "app/message.h"
#include "app/options.h"
#include "app/overlay_text.h"
#include "app/picture.h"
#include "app/view_command.h"
#include "base/stopwatch.h"
#include "frame/plan/ignored_options.h"

#include <algorithm>
#include <utility>

#include <unistd.h>

namespace scanout::app {
namespace {

constexpr int kHintSteps = 5 * kStepsPerSecond;
constexpr std::chrono::milliseconds kSettle{150}; // of a picture that is drawn at its best then
constexpr int kFlipTimeoutMs = 1100;              // a flip that has not come by then will not come

} // namespace

Result<std::unique_ptr<ViewSession>> ViewSession::create(const Settings& settings,
                                                         SessionParts parts) {
    TRY(EventLoop loop, EventLoop::create(parts.display.event_fd(), parts.input.event_fd()));
    return std::unique_ptr<ViewSession>(
        new ViewSession(settings, std::move(parts), std::move(loop)));
}

ViewSession::ViewSession(const Settings& settings, SessionParts parts, EventLoop loop)
    : settings_(settings), parts_(std::move(parts)), loop_(std::move(loop)),
      steady_(!steadying_option(settings).empty()), converges_(!steady_ && converges(settings)),
      viewer_(settings, parts_.display.info().width, parts_.display.info().height,
              static_cast<int>(settings.arguments.size())),
      binder_(viewer_.width(), viewer_.height(), !settings.no_pointer),
      script_(std::move(parts_.script)), accuracy_(steady_), renderer_(parts_.jobs),
      composer_(viewer_.width(), viewer_.height()), pacer_(parts_.display.info().refresh_hz),
      log_(settings, parts_.display.info()),
      background_(viewer_.width(), viewer_.height(), settings.frame.background) {}

Result<void> ViewSession::run() {
    describe_input();
    TRY_VOID(load(false));
    if (parts_.instant) return run_instantly();
    if (!settings_.quiet) show_message("H help, Q quit", kHintSteps);
    while (!quit_) {
        TRY_VOID(follow_display());
        const Time now = std::chrono::steady_clock::now();
        TRY_VOID(advance(now));
        if (quit_) break;
        follow_motion(now);
        if (!asked().any())
            accuracy_.let_go();
        else if (slot_.model() != nullptr)
            accuracy_.follow(key(), now);
        TRY_VOID(draw_if_due(now));
        if (viewer_.state().explain == 0) explain_.stop();
        if (wants_row())
            TRY_VOID(measure_row());
        else if (wants_frontier_step())
            TRY_VOID(measure_frontier());
        else if (wants_trace() && accuracy_.due(now) <= now)
            TRY_VOID(trace_step());
        TRY_VOID(wait());
    }
    return outcome();
}

// A frame for every step that the script names, then what remains when nothing moves any more.
Result<void> ViewSession::run_instantly() {
    while (!quit_) {
        TRY_VOID(play_script());
        while (!viewer_.moving() && lacks_rows() && viewer_.view(*slot_.mesh()))
            TRY_VOID(measure_row());
        if (frame_file_ || !script_.next_step()) TRY_VOID(finish_reference());
        if (wants_frame()) TRY_VOID(draw(wanted()));
        if (quit_ || frame_file_) continue;
        TRY_VOID(take_input());
        if (const auto step = script_.next_step())
            viewer_.advance_to(*step);
        else if (viewer_.state().pointer.visible)
            viewer_.advance_to(viewer_.state().pointer.hide_step);
        else
            quit_ = !wants_frame();
    }
    return outcome();
}

// ---- Time -------------------------------------------------------------------------------------

// The first step that changes more than the message.
std::optional<std::int64_t> ViewSession::next_change() const {
    std::optional<std::int64_t> next;
    const auto consider = [&](std::optional<std::int64_t> step) {
        if (step) next = next ? std::min(*next, *step) : *step;
    };
    if (viewer_.moving()) consider(viewer_.next_step());
    consider(binder_.next_repeat());
    consider(script_.next_step());
    return next;
}

std::optional<std::int64_t> ViewSession::next_step() const {
    const std::optional<std::int64_t> change = next_change(), message = message_.next_step();
    return change && message ? std::min(*change, *message) : change ? change : message;
}

Result<void> ViewSession::advance(Time now) {
    if (!lost_ && !frame_file_) TRY_VOID(play_script());
    if (lost_ || frame_file_ || !next_step()) {
        clock_.stop();
        return {};
    }
    clock_.run(now, viewer_.step_number());
    TRY_VOID(pass_steps(clock_.step_at(now)));
    if (frame_file_ || !next_step()) clock_.stop();
    return {};
}

Result<void> ViewSession::pass_steps(std::int64_t target) {
    int repeats = 0;
    while (viewer_.step_number() < target && !quit_ && !frame_file_) {
        std::int64_t next = std::min(target, next_step().value_or(target));
        next = std::max(next, viewer_.step_number() + 1);
        viewer_.advance_to(next);
        while (const std::optional<Action> repeat = binder_.repeat(next))
            if (++repeats <= kMaxRepeatsAtOnce) TRY_VOID(take(*repeat));
        message_.advance_to(next);
        TRY_VOID(play_script());
    }
    return {};
}

// Takes the script's actions that are due; stops at a frame, which has to be drawn first.
Result<void> ViewSession::play_script() {
    while (!frame_file_ && !quit_) {
        const Action* const action = script_.take_due(viewer_.step_number());
        if (action == nullptr) break;
        TRY_VOID(take(*action));
    }
    return {};
}

Result<void> ViewSession::follow_display() {
    const bool was_lost = std::exchange(lost_, parts_.display.lost());
    if (lost_ && !was_lost) TRY_VOID(let_go_of_all());
    if (was_lost && !lost_) repaint_ = true;
    if (!lost_ && parts_.display.ready()) log_.reached();
    return {};
}

// The console goes away, and with it the releases of what is held.
Result<void> ViewSession::let_go_of_all() {
    std::vector<Action> actions;
    binder_.release_all(actions);
    for (const Action& action : actions)
        TRY_VOID(take(action));
    return {};
}

// ---- Actions ----------------------------------------------------------------------------------

// Devices come and go.
void ViewSession::describe_input() {
    if (!settings_.verbose || parts_.input.description() == input_described_) return;
    input_described_ = parts_.input.description();
    say("input " + input_described_);
}

Result<void> ViewSession::take_input() {
    events_.clear();
    TRY_VOID(parts_.input.dispatch(events_));
    describe_input();
    if (events_.empty()) return {};
    if (!parts_.instant) {
        binder_.let_go(events_);
        TRY_VOID(advance(std::chrono::steady_clock::now()));
    }
    std::vector<Action> actions;
    binder_.bind(events_, viewer_.step_number(), actions);
    const bool script_plays = script_.next_step().has_value();
    for (const Action& action : actions) {
        const bool leaves = action.id == ActionId::quit || action.id == ActionId::close ||
                            action.id == ActionId::suspend;
        if (!script_plays || leaves) TRY_VOID(take(action));
    }
    return {};
}

Result<void> ViewSession::take(const Action& action) {
    if (quit_) return {};
    const TimedAction timed{viewer_.step_number(), action};
    if (!script_.has_script()) log_.took(fmt::format("{} {}", timed.step, to_text(action)));
    if (parts_.recorder && action.id != ActionId::suspend) TRY_VOID(parts_.recorder->write(timed));
    if (action.id != ActionId::pointer) message_.hide();
    if (action.id == ActionId::toggle_explain)
        viewer_.set_explain_pages(static_cast<int>(explain_page().pages));
    if (action.id == ActionId::toggle_doctor) examine();
    if (action.id == ActionId::cull_next && !steady_) return change_culling(action);
    const Effect effect = viewer_.apply(action, slot_.mesh());
    if (!viewer_.answer().empty()) show_message(viewer_.answer(), kMessageSteps);
    switch (effect) {
    case Effect::none:
        break;
    case Effect::load_file:
        return load(false);
    case Effect::reload:
        return load(true);
    case Effect::screenshot:
        return write_screenshot();
    case Effect::rung_down:
        step_rung(-1);
        break;
    case Effect::rung_up:
        step_rung(1);
        break;
    case Effect::print_view:
        note_command();
        break;
    case Effect::frame:
        frame_file_ = action.text;
        break;
    case Effect::suspend:
        clock_.stop();
        TRY_VOID(let_go_of_all());
        return parts_.suspend(events_);
    case Effect::quit:
        quit_ = true;
        break;
    }
    return {};
}

// Of a closed mesh that is seen from outside the backs are hidden: that nothing happens is no
// fault.
Result<void> ViewSession::change_culling(const Action& action) {
    TRY_VOID(render());
    const image::Image before = *picture_;
    viewer_.apply(action, slot_.mesh());
    TRY_VOID(render());
    const bool same = slot_.model() != nullptr && *picture_ == before;
    show_message(viewer_.answer() + (same ? " (no pixel changes)" : ""), kMessageSteps);
    return {};
}

void ViewSession::show_message(const std::string& text, int steps) {
    if (!steady_) message_.show(text, viewer_.step_number() + steps);
}

void ViewSession::tell(const std::string& text) {
    say(text);
    show_message(text, kMessageSteps);
}

// The picture alone, without help, information and pointer, in the first free file name.
Result<void> ViewSession::write_screenshot() {
    if (slot_.model() == nullptr) return {};
    TRY_VOID(render());
    // What has converged is written as it is seen.
    const image::Image* const converged = accuracy_.finished_picture(key(), asked());
    std::string name = file_name_of(slot_.model()->scene.path);
    name = name.substr(0, name.rfind('.'));
    for (int number = 1; number < 1000; ++number) {
        const std::string file = fmt::format("scanout-{}-{:03}.png", name, number);
        if (::access(file.c_str(), F_OK) == 0) continue;
        TRY(const image::Bytes bytes,
            image::encode_png(converged ? *converged : *picture_,
                              command() + (converged ? " --reference" : "")));
        const Result<void> written = write_picture(file, bytes);
        tell(written ? "wrote " + file : written.error().what);
        return {};
    }
    tell(fmt::format("scanout-{}-001.png to -999.png exist already", name));
    return {};
}

std::string ViewSession::command() const {
    if (slot_.model() == nullptr) return {};
    const std::string options = view_options(viewer_, settings_, *slot_.mesh());
    const measure::KnownPoint* const point = rungs_.point() != nullptr ? rungs_.point()
                                             : chosen_                 ? &chosen_->point
                                                                       : nullptr;
    const std::string rungs =
        point != nullptr && !point->rungs.empty() ? " " + point->options() : "";
    return options.empty() ? "" : view_command(path(), options + rungs);
}

void ViewSession::note_command() {
    const std::string now = command();
    if (now.empty()) return;
    noted_commands_.push_back(now);
    show_message("at the end on standard output:\n" + now, kMessageSteps);
}

// ---- Files ------------------------------------------------------------------------------------

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
    Result<LoadedModel> model = load_model(path(), settings_, parts_.jobs, [&](double share) {
        return report_progress("reading", share, start);
    });
    if (quit_) return {};
    explain_.stop(); // the model that it explains is going
    accuracy_.stop();
    frontier_.stop();
    rungs_.clear();
    clock_.stop(); // the time that loading took does not turn the model
    if (!model) {
        const bool hopeless = settings_.arguments.size() == 1 && !again;
        if (hopeless) return tl::unexpected(model.error());
        say("scanout: " + model.error().what);
        slot_.put_error(model.error().what);
        return {};
    }
    if (!settings_.up_given) viewer_.take_up_of_file(model->up);
    slot_.put(*std::move(model), settings_.frame);
    chosen_.reset();
    TRY_VOID(report_plan());
    if (settings_.limits.any()) TRY_VOID(choose_rungs());
    set_motion_levels();
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
                           parts_.jobs, progress, [&] { return quit_; }},
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
    lost_ = parts_.display.lost();
    if (lost_ || !parts_.display.ready() || !parts_.display.dispatch()) return true;
    Overlay notice;
    notice.notice = {fmt::format("{} {}  {} %", doing, path(), static_cast<int>(share * 100))};
    composer_.set_picture(picture_ != nullptr ? *picture_ : background_,
                          [&](image::Image& picture) { draw_overlay(picture, notice); });
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
                                ? bound_to(event)
                                : std::optional<ActionId>();
        if (event.kind == port::EventKind::quit || action == ActionId::quit ||
            action == ActionId::close)
            quit_ = true;
    }
    return quit_;
}

// ---- The plan on the picture ------------------------------------------------------------------

// Of the model on show, as it stands now.
Result<const frame::FramePlan*> ViewSession::plan(int level) {
    // What the keys led to may be too near or too far away for any picture: a plan there is still.
    const Result<scene::View> view = viewer_.view(*slot_.mesh());
    set_frame_options(level);
    return slot_.plan(frame_options_, view ? *view : scene::View());
}

std::size_t ViewSession::panel_lines() const {
    const std::size_t others = viewer_.state().info ? 5 : 1;
    const std::size_t all = lines_down(viewer_.width(), viewer_.height());
    return all > others ? all - others : 1;
}

// The page of the plan that is open, or the first.
ScreenPage ViewSession::explain_page() {
    const ViewerState& state = viewer_.state();
    const std::size_t letters = letters_across(viewer_.width(), viewer_.height());
    const std::size_t lines = panel_lines();
    const auto page = static_cast<std::size_t>(state.explain);
    // How far it has come at a moment is a matter of the clock.
    const bool has_figures =
        state.explain > 0 && (steady_ ? explain_.has_all_rows(key()) : explain_.explains(key()));
    if (has_figures && slot_.model() != nullptr) return explain_.page(letters, lines, page);
    if (slot_.model() == nullptr) return {};
    const Result<const frame::FramePlan*> now = plan();
    return now ? plan_lines(**now, !steady_, letters, lines, page) : ScreenPage();
}

// The plan is on the screen, and its figures are not all there.
bool ViewSession::lacks_rows() const {
    return viewer_.state().explain > 0 && slot_.model() != nullptr && !explain_.has_all_rows(key());
}

// And nothing else is to be done.
bool ViewSession::wants_row() {
    return lacks_rows() && !blank_ && !lost_ && parts_.display.ready() && !next_change() &&
           !wants_frame();
}

// Switches one effect, so that keys are heard in between.
Result<void> ViewSession::measure_row() {
    if (explain_.explains(key())) {
        explain_.measure();
        return {};
    }
    TRY(const scene::View view, viewer_.view(*slot_.mesh()));
    measure::ExplainOptions how;
    how.times = !steady_;
    how.display = parts_.display.info().format;
    how.seconds_a_row = 0.05;
    set_frame_options();
    TRY(std::unique_ptr<measure::Explainer> explainer,
        measure::Explainer::create(slot_.model()->scene, slot_.facts(), view, frame_options_,
                                   parts_.jobs, how));
    explain_.begin(std::move(explainer), key());
    return {};
}

// ---- Motion -----------------------------------------------------------------------------------

void ViewSession::set_motion_levels() {
    governor_.reset();
    level_ = 0;
    if (steady_ || !settings_.holds_budget) return;
    set_frame_options();
    levels_ = motion_levels(frame_options_, settings_.named_axes.count("render_scale") == 0);
    std::vector<double> shares;
    for (const MotionLevel& level : levels_)
        shares.push_back(level.share);
    governor_.emplace(std::move(shares), budget_ms());
}

// The level of the next frame: what the governor says until a picture has stood for a while.
void ViewSession::follow_motion(Time now) {
    if (!governor_) return;
    if (const PictureKey asked_for = key(); !(asked_for == moved_to_)) {
        moved_to_ = asked_for;
        moved_ = now;
    }
    const bool moves = viewer_.turning() || now - moved_ < kSettle;
    if (!moves && moving_) governor_->rest();
    moving_ = moves;
    level_ = moves ? governor_->level() : 0;
}

// ---- Frames -----------------------------------------------------------------------------------

std::optional<PixelPlace> ViewSession::pointer() const {
    const PointerState& pointer = viewer_.state().pointer;
    if (!pointer.visible || settings_.no_pointer) return std::nullopt;
    return PixelPlace{pointer.x, pointer.y};
}

ViewSession::Shown ViewSession::wanted() {
    return {key(), level_, overlay(), accuracy_.revision(), pointer()};
}

Overlay ViewSession::overlay() {
    Overlay overlay = overlay_text(viewer_, slot_, settings_, message_.text());
    if (viewer_.state().explain > 0) overlay.explain = explain_page().lines;
    if (slot_.model() == nullptr) return overlay;
    if (const int hazard = viewer_.state().doctor; hazard > 0) {
        overlay.doctor =
            doctor_.lines(letters_across(viewer_.width(), viewer_.height()), panel_lines(), hazard);
        if (const std::optional<DVec3> place = viewer_.hazard_place())
            overlay.mark = viewer_.pixel_of(*place, *slot_.mesh());
    }
    if (viewer_.state().error_map) overlay.legend = accuracy_.legend(picture_, key(), pointer());
    if (viewer_.state().frontier) overlay.frontier = frontier_panel();
    if (viewer_.state().split) overlay.split = accuracy_.split_line(key(), asked());
    if (const std::string line = accuracy_.line(key(), asked());
        viewer_.state().info && !line.empty())
        overlay.info.push_back(line);
    return overlay;
}

void ViewSession::put_asked_frame_options(frame::FrameOptions& out) const {
    out = settings_.frame;
    out.width = background_.width();
    out.height = background_.height();
    out.bits = image::min_bits(parts_.display.info().format);
    out.cull = viewer_.state().look.cull;
    viewer_.place_lights(*slot_.mesh(), out.lights);
}

void ViewSession::set_frame_options(int level) {
    put_asked_frame_options(frame_options_);
    if (rungs_.point() != nullptr)
        frame_options_ = measure::with(std::move(frame_options_), rungs_.point()->rungs);
    else if (chosen_)
        frame_options_ = measure::with(std::move(frame_options_), chosen_->point.rungs);
    if (level > 0)
        frame_options_.render_scale = levels_[static_cast<std::size_t>(level)].render_scale;
}

Result<void> ViewSession::render(int level) {
    if (slot_.model() == nullptr) {
        blank_.reset();
        picture_ = &background_;
        return {};
    }
    const Result<scene::View> view = viewer_.view(*slot_.mesh());
    TRY(const frame::FramePlan* const now, plan(level));
    picture_ = view ? &renderer_.render(slot_.model()->scene, *view, *now) : &background_;
    if (!view)
        blank_ = frame::Blank::outside;
    else if (renderer_.stats().items_shaded == 0)
        blank_ = frame::why_nothing_is_drawn(slot_.model()->scene, *view, *now);
    else
        blank_.reset();
    return {};
}

void ViewSession::compose(const Overlay& overlay, int level) {
    Overlay complete = overlay;
    add_frame_text(complete,
                   {blank_, !steady_, pacer_.frames_per_second(), renderer_.stats(),
                    level > 0 ? levels_[static_cast<std::size_t>(level)].render_scale : ""});
    composer_.set_picture(accuracy_.picture(*picture_, key(), asked()),
                          [&](image::Image& picture) { draw_overlay(picture, complete); });
}

Result<void> ViewSession::draw(const Shown& wanted) {
    const bool new_picture =
        picture_ == nullptr || !(wanted.picture == shown_.picture) || wanted.level != shown_.level;
    const Stopwatch watch;
    if (new_picture) TRY_VOID(render(wanted.level));
    if (new_picture || repaint_ || wanted.accuracy != shown_.accuracy ||
        !(wanted.overlay == shown_.overlay))
        compose(wanted.overlay, wanted.level);
    composer_.set_pointer(wanted.pointer);
    TRY_VOID(present());
    if (governor_ && new_picture && wanted.picture == moved_to_ &&
        wanted.level == governor_->level())
        governor_->took(watch.milliseconds());
    shown_ = wanted;
    repaint_ = false;
    if (const auto file = std::exchange(frame_file_, std::nullopt))
        TRY_VOID(log_.dump(displayed(), *file));
    return {};
}

// What the display is given.
const image::Image& ViewSession::displayed() {
    const image::PixelFormat& format = parts_.display.info().format;
    if (!dithers_unasked(settings_, format)) return composer_.frame();
    undithered_ = image::without_dither(format, composer_.frame());
    return undithered_;
}

Result<void> ViewSession::present() {
    const std::vector<image::Rect>& damage = composer_.take_damage();
    const image::Image& image = displayed();
    TRY_VOID(parts_.display.present(image, damage));
    log_.presented(image, renderer_.stats());
    if (parts_.display.ready()) log_.reached();
    return {};
}

Result<void> ViewSession::draw_if_due(Time now) {
    if (lost_ || !parts_.display.ready() || !wants_frame()) return {};
    if (!parts_.display.paced() && now < pacer_.due()) return {};
    pacer_.begin_frame(now);
    return draw(wanted());
}

// Sleeps until there is something to do. With nothing that moves and nothing to draw only input, a
// flip or a signal ends the sleep.
Result<void> ViewSession::wait() {
    const bool ready = parts_.display.ready();
    const bool row = wants_row(), rungs = wants_frontier_step(), trace = !rungs && wants_trace();
    if (ready && !lost_ && !wants_frame() && !row && !rungs && !trace) log_.settled();
    std::optional<Time> wake;
    const auto consider = [&](Time time) { wake = wake ? std::min(*wake, time) : time; };
    if (const auto next = next_step(); next && !lost_ && !frame_file_)
        consider(clock_.running() ? clock_.time_of(*next) : std::chrono::steady_clock::now());
    if (ready && !lost_ && wants_frame()) consider(pacer_.due());
    if (level_ > 0 && !viewer_.turning()) consider(moved_ + kSettle);
    if (rungs) // at once, or when a thread may have ended
        consider(std::chrono::steady_clock::now() +
                 std::chrono::milliseconds(frontier_.building() ? 5 : 0));
    if (trace) consider(accuracy_.due(std::chrono::steady_clock::now()));
    const int patience = row ? 0 : ready || lost_ ? -1 : kFlipTimeoutMs;
    TRY(const bool input, loop_.sleep(wake, patience));
    if (input) TRY_VOID(take_input());
    // Also without an event: this is where a flip that never came counts as done.
    return parts_.display.dispatch();
}

RunReport ViewSession::report(std::uint64_t start_bytes) {
    RunReport report;
    if (const LoadedModel* const model = slot_.model()) {
        report.model_path = model->scene.path;
        report.counts = model->scene.counts;
        report.warnings = model->warnings;
        report.load_ms = model->load_ms;
        report.load_times = model->load_times;
    }
    report.frames = log_.take_records();
    report.chosen = chosen_;
    report.start_bytes = start_bytes;
    report.threads = parts_.jobs.threads();
    return report;
}

} // namespace scanout::app
