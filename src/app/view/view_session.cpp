#include "app/view/view_session.h"

#include "app/files.h"
#include "app/message.h"
#include "app/options/conflicts.h"
#include "app/overlay/overlay_text.h"
#include "app/overlay/text_block.h"
#include "app/overlay/warnings_page.h"
#include "app/picture/picture.h"
#include "app/view/pick.h"
#include "app/view/view_command.h"
#include "math/bits.h"

#include <algorithm>
#include <utility>

#include <unistd.h>

namespace scanout::app {
namespace {

constexpr int kHintSteps = 5 * kStepsPerSecond;
constexpr int kFlipTimeoutMs = 1100; // a flip that has not come by then will not come

} // namespace

Result<std::unique_ptr<ViewSession>> ViewSession::create(const Settings& settings,
                                                         SessionParts parts) {
    std::optional<FileWatch> watch;
    if (settings.watch && !parts.instant) {
        TRY(watch, FileWatch::create());
    }
    TRY(EventLoop loop, EventLoop::create(parts.display.event_fd(), parts.input.event_fd(),
                                          watch ? watch->event_fd() : -1));
    return std::unique_ptr<ViewSession>(
        new ViewSession(settings, std::move(parts), std::move(watch), std::move(loop)));
}

ViewSession::ViewSession(const Settings& settings, SessionParts parts,
                         std::optional<FileWatch> watch, EventLoop loop)
    : settings_(settings), parts_(std::move(parts)), watch_(std::move(watch)),
      loop_(std::move(loop)), steady_(!steadying_option(settings).empty()),
      converges_(!steady_ && converges(settings)),
      viewer_(settings, parts_.display.info().width, parts_.display.info().height,
              static_cast<int>(settings.arguments.size())),
      binder_(viewer_.width(), viewer_.height(), !settings.no_pointer, std::move(parts_.keys)),
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
        TRY_VOID(follow_files(now));
        TRY_VOID(advance(now));
        if (quit_) break;
        follow_section();
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
        follow_section();
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
    if (!lost_ && (was_lost || parts_.display.stale())) repaint_ = true;
    if (!lost_ && parts_.display.ready()) log_.reached(parts_.display.shown_at_ns());
    follow_size();
    return {};
}

void ViewSession::follow_size() {
    const port::DisplayInfo& info = parts_.display.info();
    if (info.width == viewer_.width() && info.height == viewer_.height()) return;
    viewer_.resize(info.width, info.height);
    binder_.resize(info.width, info.height);
    composer_ = Composer(info.width, info.height);
    background_ = image::Image(info.width, info.height, background_.at(0, 0));
    picture_ = nullptr; // it has the size before
    repaint_ = true;
}

// The console goes away, and with it the releases of what is held.
Result<void> ViewSession::let_go_of_all() {
    std::vector<Action> actions;
    binder_.release_all(actions);
    input_ns_ = 0;
    for (const Action& action : actions)
        TRY_VOID(take(action));
    log_.forget_inputs();
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
    binder_.set_flying(viewer_.state().look.flies);
    input_ns_ = 0;
    for (const port::Event& event : events_)
        if (event.time_ns != 0 && (input_ns_ == 0 || event.time_ns < input_ns_))
            input_ns_ = event.time_ns;
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
    if (!script_.has_script())
        log_.took(fmt::format("{} {}", timed.step, to_text(action)), std::exchange(input_ns_, 0));
    if (parts_.recorder && action.id != ActionId::suspend) TRY_VOID(parts_.recorder->write(timed));
    if (action.id != ActionId::pointer) message_.hide();
    viewer_.set_pages(pages_for(action.id));
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
    case Effect::rendering:
        return follow_switch(action);
    case Effect::rung_down:
        step_rung(-1);
        break;
    case Effect::rung_up:
        step_rung(1);
        break;
    case Effect::print_view:
        note_command();
        break;
    case Effect::pick:
        pick();
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

std::string ViewSession::options() const {
    if (slot_.model() == nullptr) return {};
    const std::string view = view_options(viewer_, settings_, *slot_.mesh());
    const measure::KnownPoint* const point = chosen_point();
    if (view.empty() || point == nullptr) return view;
    const std::string rungs = measure::options_of(counting_rungs(*point));
    return rungs.empty() ? view : view + " " + rungs;
}

std::string ViewSession::command() const {
    const std::string shown = options();
    return shown.empty() ? "" : view_command(path(), shown);
}

// Of what is drawn: a section's vertices, too.
void ViewSession::pick() {
    if (slot_.model() == nullptr) return;
    follow_section();
    const geom::Mesh& mesh = slot_.model()->scene.mesh;
    const Result<scene::View> view = viewer_.view(*slot_.mesh());
    const PointerState& pointer = viewer_.state().pointer;
    const auto vertex =
        view ? seen_vertex(mesh, *view, viewer_.width(), viewer_.height(), {pointer.x, pointer.y})
             : std::nullopt;
    if (!vertex) return show_message("no vertex is seen near the pointer", kMessageSteps);
    viewer_.take_point(mesh.centre + DVec3(mesh.position[*vertex]) * power_of_two(mesh.exponent));
}

void ViewSession::note_command() {
    const std::string now = command();
    if (now.empty()) return;
    noted_commands_.push_back(now);
    show_message("at the end on standard output:\n" + now, kMessageSteps);
}

// ---- The plan on the picture ------------------------------------------------------------------

// Of the model on show, as it stands now.
Result<const frame::FramePlan*> ViewSession::plan(int level) {
    // What the keys led to may be too near or too far away for any picture: a plan there is still.
    const Result<scene::View> view = viewer_.view(*slot_.mesh());
    set_frame_options(level);
    return slot_.plan(frame_options_, view ? *view : scene::View());
}

// How many pages the panel that the action opens has.
Viewer::Pages ViewSession::pages_for(ActionId id) {
    Viewer::Pages pages;
    if (id == ActionId::toggle_help)
        pages.help = static_cast<int>(help_pages(help_sheet(viewer_.state(), binder_.keys()),
                                                 letters_across(viewer_.width(), viewer_.height()),
                                                 lines_down(viewer_.width(), viewer_.height()))
                                          .size());
    if (id == ActionId::toggle_explain) pages.explain = static_cast<int>(explain_page().pages);
    if (id == ActionId::toggle_warnings) pages.warnings = static_cast<int>(warnings().pages);
    return pages;
}

// The lines that fit under the information, which a small screen leaves out where a page is open.
std::size_t ViewSession::panel_lines() const {
    const std::size_t all = lines_down(viewer_.width(), viewer_.height());
    if (!shows_info()) return all > 1 ? all - 1 : 1;
    constexpr std::size_t kFigures = 4; // lines of times and accuracy, and an empty one
    const std::size_t letters = letters_across(viewer_.width(), viewer_.height());
    std::size_t others = kFigures;
    for (const std::string& line : info_lines(viewer_, slot_, settings_))
        others += broken_into_lines(line, letters).size();
    return all > others ? all - others : 1;
}

bool ViewSession::shows_info() const {
    constexpr std::size_t kRoomForBoth = 20; // lines
    const ViewerState& state = viewer_.state();
    const bool page = state.explain > 0 || state.doctor > 0 || state.warnings > 0;
    return state.info && (!page || lines_down(viewer_.width(), viewer_.height()) >= kRoomForBoth);
}

ScreenPage ViewSession::warnings() const {
    if (slot_.model() == nullptr) return {};
    return warnings_page(slot_.model()->warnings, letters_across(viewer_.width(), viewer_.height()),
                         panel_lines(), static_cast<std::size_t>(viewer_.state().warnings));
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

// ---- Waiting ----------------------------------------------------------------------------------

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
    if (level_ > 0 && !viewer_.turning()) consider(settling_.settles());
    if (rungs) // at once, or when a thread may have ended
        consider(std::chrono::steady_clock::now() +
                 std::chrono::milliseconds(frontier_.building() ? 5 : 0));
    if (reload_at_) consider(*reload_at_);
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
    report.input_to_screen_ms = log_.take_latencies();
    report.chosen = chosen_;
    report.start_bytes = start_bytes;
    report.threads = parts_.jobs.threads();
    return report;
}

} // namespace scanout::app
