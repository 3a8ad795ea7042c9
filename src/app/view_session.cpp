#include "app/view_session.h"

#include "app/explain_report.h"
#include "app/message.h"
#include "app/picture.h"
#include "base/check.h"
#include "frame/plan/ignored_options.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include <sys/epoll.h>
#include <sys/timerfd.h>
#include <unistd.h>

namespace scanout::app {
namespace {

constexpr int kMessageSteps = 3 * kStepsPerSecond;
constexpr int kFlipTimeoutMs = 1100; // a flip that has not come by then will not come

Result<void> watch(const Fd& epoll, int fd) {
    if (fd < 0) return {};
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.fd = fd;
    if (::epoll_ctl(epoll.get(), EPOLL_CTL_ADD, fd, &event) != 0)
        return fail(Exit::internal, "epoll_ctl: {}", std::strerror(errno));
    return {};
}

std::chrono::nanoseconds refresh_period(const port::Display& display) {
    const double hz = display.info().refresh_hz;
    return std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 / (hz > 1 ? hz : 60)));
}

} // namespace

Result<std::unique_ptr<ViewSession>> ViewSession::create(const Settings& settings,
                                                         SessionParts parts) {
    Fd epoll(::epoll_create1(EPOLL_CLOEXEC));
    if (!epoll.valid()) return fail(Exit::internal, "epoll: {}", std::strerror(errno));
    Fd timer(::timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK));
    if (!timer.valid()) return fail(Exit::internal, "timerfd: {}", std::strerror(errno));
    for (const int fd : {timer.get(), parts.display.event_fd(), parts.input.event_fd()})
        TRY_VOID(watch(epoll, fd));
    return std::unique_ptr<ViewSession>(
        new ViewSession(settings, std::move(parts), std::move(epoll), std::move(timer)));
}

ViewSession::ViewSession(const Settings& settings, SessionParts parts, Fd epoll, Fd timer)
    : settings_(settings), parts_(std::move(parts)), epoll_(std::move(epoll)),
      timer_(std::move(timer)),
      steady_(settings.no_times || !settings.record.empty() || !settings.replay.empty()),
      viewer_(settings, parts_.display.info().width, parts_.display.info().height,
              static_cast<int>(settings.arguments.size())),
      binder_(parts_.display.info().width, parts_.display.info().height, !settings.no_pointer),
      renderer_(parts_.jobs), composer_(parts_.display.info().width, parts_.display.info().height),
      log_(settings, parts_.display.info()),
      background_(parts_.display.info().width, parts_.display.info().height,
                  settings.frame.background) {}

Result<void> ViewSession::run() {
    describe_input();
    TRY_VOID(load(false));
    if (parts_.instant) return run_instantly();
    while (!quit_) {
        TRY_VOID(follow_display());
        const Time now = std::chrono::steady_clock::now();
        TRY_VOID(advance(now));
        if (quit_) break;
        TRY_VOID(draw_if_due(now));
        if (viewer_.state().explain == 0) explainer_.reset();
        if (wants_row()) TRY_VOID(explain_a_row());
        TRY_VOID(wait());
    }
    return outcome();
}

// A frame for every step that the script names, then what remains when nothing moves any more.
Result<void> ViewSession::run_instantly() {
    const std::size_t entries = parts_.script ? parts_.script->size() : 0;
    while (!quit_) {
        TRY_VOID(play_script());
        while (!viewer_.moving() && lacks_rows() && viewer_.view(model_->scene.mesh))
            TRY_VOID(explain_a_row());
        if (wants_frame()) TRY_VOID(draw(wanted()));
        if (quit_ || frame_file_) continue;
        TRY_VOID(take_input());
        if (next_entry_ < entries)
            viewer_.advance_to((*parts_.script)[next_entry_].step);
        else if (viewer_.state().pointer.visible)
            viewer_.advance_to(viewer_.state().pointer.hide_step);
        else
            quit_ = !wants_frame();
    }
    return outcome();
}

// ---- Time -------------------------------------------------------------------------------------

std::optional<std::int64_t> ViewSession::next_step() const {
    std::optional<std::int64_t> next;
    const auto consider = [&](std::int64_t step) { next = next ? std::min(*next, step) : step; };
    if (viewer_.moving()) consider(viewer_.next_step());
    if (const auto repeat = binder_.next_repeat()) consider(*repeat);
    if (!message_.empty()) consider(message_hides_);
    if (parts_.script && next_entry_ < parts_.script->size())
        consider((*parts_.script)[next_entry_].step);
    return next;
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
        if (!message_.empty() && next >= message_hides_) message_.clear();
        TRY_VOID(play_script());
    }
    return {};
}

// Takes the script's actions that are due; stops at a frame, which has to be drawn first.
Result<void> ViewSession::play_script() {
    if (!parts_.script) return {};
    const Script& script = *parts_.script;
    while (next_entry_ < script.size() && !frame_file_ && !quit_ &&
           script[next_entry_].step <= viewer_.step_number())
        TRY_VOID(take(script[next_entry_++].action));
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
    const bool script_plays = parts_.script && next_entry_ < parts_.script->size();
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
    if (!parts_.script) log_.took(fmt::format("{} {}", timed.step, to_text(action)));
    if (parts_.recorder && action.id != ActionId::suspend) TRY_VOID(parts_.recorder->write(timed));
    message_.clear();
    if (action.id == ActionId::toggle_explain)
        viewer_.set_explain_pages(static_cast<int>(explain_page().pages));
    switch (viewer_.apply(action, model_ ? &model_->scene.mesh : nullptr)) {
    case Effect::none:
        break;
    case Effect::load_file:
        return load(false);
    case Effect::reload:
        return load(true);
    case Effect::screenshot:
        return write_screenshot();
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

void ViewSession::show_message(const std::string& text) {
    say(text);
    if (steady_) return; // a file's number depends on the folder
    message_ = text;
    message_hides_ = viewer_.step_number() + kMessageSteps;
}

// The picture alone, without help, information and pointer, in the first free file name.
Result<void> ViewSession::write_screenshot() {
    if (!model_) return {};
    TRY_VOID(render());
    const std::string& path = model_->scene.path;
    std::string name = path.substr(path.rfind('/') + 1);
    name = name.substr(0, name.rfind('.'));
    for (int number = 1; number < 1000; ++number) {
        const std::string file = fmt::format("scanout-{}-{:03}.png", name, number);
        if (::access(file.c_str(), F_OK) == 0) continue;
        TRY(const image::Bytes bytes, image::encode_png(*picture_));
        const Result<void> written = write_picture(file, bytes);
        show_message(written ? "wrote " + file : written.error().what);
        return {};
    }
    show_message(fmt::format("scanout-{}-001.png to -999.png exist already", name));
    return {};
}

// ---- Files ------------------------------------------------------------------------------------

Result<void> ViewSession::outcome() const {
    if (showed_model_ || error_.empty()) return {};
    return fail(Exit::unreadable, "none of the {} models could be read; the last: {}",
                settings_.arguments.size(), error_);
}

Result<void> ViewSession::load(bool again) {
    const std::string& path = settings_.arguments[static_cast<std::size_t>(viewer_.state().file)];
    load_start_ = std::chrono::steady_clock::now();
    Result<LoadedModel> model = load_model(path, settings_, parts_.jobs,
                                           [this](double share) { return report_progress(share); });
    if (quit_) return {};
    ++generation_;
    explainer_.reset(); // of a model that is going
    clock_.stop();      // the time that loading took does not turn the model
    if (!model) {
        const bool hopeless = settings_.arguments.size() == 1 && !again;
        if (hopeless) return tl::unexpected(model.error());
        say("scanout: " + model.error().what);
        error_ = model.error().what;
        model_.reset();
        return {};
    }
    error_.clear();
    showed_model_ = true;
    model_ = *std::move(model);
    plan_ = frame::PlanCache(frame::facts(model_->scene, settings_.frame.shadow_plane));
    print_warnings(model_->warnings, settings_);
    // Options that no technique answers to, and cameras that see nothing, are faults of the
    // command.
    TRY(const scene::View view, viewer_.view(model_->scene.mesh));
    TRY(const frame::FramePlan plan, frame::plan(options(), plan_.facts(), view));
    if (settings_.verbose)
        for (const frame::Decision& decision : plan.decisions)
            say(to_string(decision));
    print_warnings(frame::ignored_options(plan), settings_);
    return {};
}

// While a file is read: a notice on the display once that takes long, and a look at the keys.
bool ViewSession::report_progress(double share) {
    if (parts_.instant) return true;
    constexpr std::chrono::milliseconds kPatience{300};
    const Time now = std::chrono::steady_clock::now();
    if (now - std::max(load_start_, last_draw_) < kPatience) return true;
    if (wants_to_leave()) return false;
    lost_ = parts_.display.lost();
    if (lost_ || !parts_.display.ready() || !parts_.display.dispatch()) return true;
    const std::string& path = settings_.arguments[static_cast<std::size_t>(viewer_.state().file)];
    Overlay notice;
    notice.notice = {fmt::format("reading {}  {} %", path, static_cast<int>(share * 100))};
    composer_.set_picture(picture_ != nullptr ? *picture_ : background_,
                          [&](image::Image& picture) { draw_overlay(picture, notice); });
    repaint_ = true;
    last_draw_ = now;
    return present().has_value();
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

// ---- Frames -----------------------------------------------------------------------------------

ViewSession::Shown ViewSession::wanted() const {
    Shown wanted{viewer_.state().look, generation_, overlay(), std::nullopt};
    wanted.look.turntable = false; // turning or not, this picture is the same
    const PointerState& pointer = viewer_.state().pointer;
    if (pointer.visible && !settings_.no_pointer) wanted.pointer = PixelPlace{pointer.x, pointer.y};
    return wanted;
}

Overlay ViewSession::overlay() const {
    const ViewerState& state = viewer_.state();
    const port::DisplayInfo& display = parts_.display.info();
    Overlay overlay;
    if (state.help) overlay.help = help_sheet(state);
    overlay.message = message_;
    if (message_.empty() && model_)
        overlay.message =
            viewer_.light_line(model_->scene.mesh, letters_across(display.width, display.height));
    if (!error_.empty())
        overlay.notice = broken_into_lines(error_, letters_across(display.width, display.height));
    if (state.explain > 0) overlay.explain = explain_page().lines;
    if (!state.info) return overlay;
    const std::string& path = settings_.arguments[static_cast<std::size_t>(state.file)];
    overlay.info.push_back(fmt::format("{}  ({} of {})", path.substr(path.rfind('/') + 1),
                                       state.file + 1, settings_.arguments.size()));
    if (model_)
        overlay.info.push_back(fmt::format(
            "{} triangles  {} vertices  {} warnings  {}x{}", model_->scene.counts.triangles,
            model_->scene.counts.vertices, model_->warnings.size(), display.width, display.height));
    overlay.info.push_back(fmt::format(
        "{}  up {}  cull {}  {} mode", name_of(state.look.projection), name_of(state.look.up),
        name_of(state.look.cull), state.camera_mode ? "camera" : "model"));
    return overlay;
}

// The page of the plan that is open, or the first.
ScreenPage ViewSession::explain_page() const {
    const ViewerState& state = viewer_.state();
    const port::DisplayInfo& display = parts_.display.info();
    const std::size_t letters = letters_across(display.width, display.height);
    const std::size_t others = state.info ? 5 : 1; // lines
    const std::size_t all = lines_down(display.width, display.height);
    const std::size_t lines = all > others ? all - others : 1;
    const auto page = static_cast<std::size_t>(state.explain);
    // How far it has come at a moment is a matter of the clock.
    if (explains_this() && (!steady_ || explainer_->finished()))
        return screen_table(explainer_->so_far(), rows_, letters, lines, page);
    const auto now = model_ ? plan() : fail(Exit::internal, "no model");
    return now ? plan_lines(*now, !steady_, letters, lines, page) : ScreenPage();
}

// Into the room that it has.
void ViewSession::fill(frame::FrameOptions& options) const {
    options = settings_.frame;
    options.width = background_.width();
    options.height = background_.height();
    options.bits = image::min_bits(parts_.display.info().format);
    options.cull = viewer_.state().look.cull;
    viewer_.place_lights(model_->scene.mesh, options.lights);
}

frame::FrameOptions ViewSession::options() const {
    frame::FrameOptions options;
    fill(options);
    return options;
}

// Of the model on show, as it stands now.
Result<frame::FramePlan> ViewSession::plan() const {
    const Result<scene::View> view = viewer_.view(model_->scene.mesh);
    return frame::plan(options(), plan_.facts(), view ? *view : scene::View());
}

// What the explainer knows is true of what should be seen.
bool ViewSession::explains_this() const {
    Look look = viewer_.state().look;
    look.turntable = false;
    return explainer_ != nullptr && model_ && viewer_.state().explain > 0 &&
           explained_generation_ == generation_ && explained_look_ == look;
}

// The plan is on the screen, and its figures are not all there.
bool ViewSession::lacks_rows() const {
    return viewer_.state().explain > 0 && model_ && (!explains_this() || !explainer_->finished());
}

// And nothing else is to be done.
bool ViewSession::wants_row() const {
    return lacks_rows() && in_view_ && !lost_ && parts_.display.ready() && !next_step() &&
           !wants_frame();
}

// Switches one effect, so that keys are heard in between.
Result<void> ViewSession::explain_a_row() {
    if (explains_this()) {
        explainer_->step();
        ++rows_;
        return {};
    }
    TRY(const scene::View view, viewer_.view(model_->scene.mesh));
    measure::ExplainOptions how;
    how.times = !steady_;
    how.display = parts_.display.info().format;
    how.seconds_a_row = 0.05;
    how.min_pairs = 1; // keys wait for a row
    TRY(explainer_, measure::Explainer::create(model_->scene, plan_.facts(), view, options(),
                                               parts_.jobs, how));
    rows_ = 0;
    explained_look_ = viewer_.state().look;
    explained_look_.turntable = false;
    explained_generation_ = generation_;
    return {};
}

Result<void> ViewSession::render() {
    if (!model_) {
        picture_ = &background_;
        return {};
    }
    // What the keys led to may be too near or too far away for any picture: then none is the
    // model's.
    const Result<scene::View> view = viewer_.view(model_->scene.mesh);
    fill(options_);
    TRY(const frame::FramePlan* const now, plan_.plan(options_, view ? *view : scene::View()));
    picture_ = view ? &renderer_.render(model_->scene, *view, *now) : &background_;
    in_view_ = view && renderer_.stats().items_shaded > 0;
    return {};
}

Result<void> ViewSession::draw(const Shown& wanted) {
    const bool new_picture = picture_ == nullptr || !(wanted.look == shown_.look) ||
                             wanted.generation != shown_.generation;
    if (new_picture) TRY_VOID(render());
    if (new_picture || repaint_ || !(wanted.overlay == shown_.overlay)) {
        Overlay overlay = wanted.overlay;
        if (model_ && !in_view_ && overlay.message.empty())
            overlay.message = "model out of view: press R";
        if (!overlay.info.empty() && !steady_)
            overlay.info.push_back(fmt::format("{:.1f} ms  {:.0f} fps", renderer_.stats().total_ms,
                                               frames_per_second_));
        if (!overlay.explain.empty() && !steady_)
            overlay.explain.push_back(fmt::format("geometry {:.1f} ms  tiles {:.1f} ms",
                                                  renderer_.stats().geometry_ms,
                                                  renderer_.stats().tiles_ms));
        composer_.set_picture(*picture_,
                              [&](image::Image& picture) { draw_overlay(picture, overlay); });
    }
    composer_.set_pointer(wanted.pointer);
    TRY_VOID(present());
    shown_ = wanted;
    repaint_ = false;
    if (const auto file = std::exchange(frame_file_, std::nullopt))
        TRY_VOID(log_.dump(frame(), *file));
    return {};
}

// What the display is given.
const image::Image& ViewSession::frame() {
    const image::PixelFormat& format = parts_.display.info().format;
    if (!dithers_unasked(settings_, format)) return composer_.frame();
    undithered_ = image::without_dither(format, composer_.frame());
    return undithered_;
}

Result<void> ViewSession::present() {
    const std::vector<image::Rect>& damage = composer_.take_damage();
    const image::Image& shown = frame();
    TRY_VOID(parts_.display.present(shown, damage));
    log_.presented(shown, renderer_.stats());
    if (parts_.display.ready()) log_.reached();
    return {};
}

Result<void> ViewSession::draw_if_due(Time now) {
    if (lost_ || !parts_.display.ready() || !wants_frame()) return {};
    if (!parts_.display.paced() && now < due_) return {};
    const double passed = std::chrono::duration<double>(now - last_draw_).count();
    frames_per_second_ = passed > 0 && passed < 0.5 ? 1 / passed : 0;
    last_draw_ = now;
    // Half a period of slack: a late wake-up does not make every frame after it late as well.
    const std::chrono::nanoseconds period = refresh_period(parts_.display);
    due_ = std::max(due_ + period, now + period / 2);
    return draw(wanted());
}

// Sleeps until there is something to do. With nothing that moves and nothing to draw no timer is
// set, and only input, a flip or a signal ends the sleep.
Result<void> ViewSession::wait() {
    const bool ready = parts_.display.ready();
    const bool row = wants_row();
    if (ready && !lost_ && !wants_frame() && !row) log_.settled();
    std::optional<Time> wake;
    const auto consider = [&](Time time) { wake = wake ? std::min(*wake, time) : time; };
    if (const auto next = next_step(); next && !lost_ && !frame_file_)
        consider(clock_.running() ? clock_.time_of(*next) : std::chrono::steady_clock::now());
    if (ready && !lost_ && wants_frame()) consider(due_);
    itimerspec spec{};
    if (wake) {
        const auto since_boot = std::max<std::int64_t>(
            std::chrono::nanoseconds(wake->time_since_epoch()).count(), 1); // 0 would disarm it
        spec.it_value.tv_sec = since_boot / 1'000'000'000;
        spec.it_value.tv_nsec = since_boot % 1'000'000'000;
    }
    ::timerfd_settime(timer_.get(), TFD_TIMER_ABSTIME, &spec, nullptr);

    std::array<epoll_event, 4> events{};
    const int count = ::epoll_wait(epoll_.get(), events.data(), static_cast<int>(events.size()),
                                   row              ? 0
                                   : ready || lost_ ? -1
                                                    : kFlipTimeoutMs);
    if (count < 0 && errno != EINTR)
        return fail(Exit::internal, "epoll_wait: {}", std::strerror(errno));
    for (int i = 0; i < count; ++i) {
        const int fd = events[static_cast<std::size_t>(i)].data.fd;
        if (fd == timer_.get()) {
            std::uint64_t expirations = 0;
            [[maybe_unused]] const ssize_t n = ::read(fd, &expirations, sizeof expirations);
        } else if (fd == parts_.input.event_fd()) {
            TRY_VOID(take_input());
        }
    }
    // Also without an event: this is where a flip that never came counts as done.
    return parts_.display.dispatch();
}

RunReport ViewSession::report(std::uint64_t start_bytes) {
    RunReport report;
    if (model_) {
        report.model_path = model_->scene.path;
        report.counts = model_->scene.counts;
        report.warnings = model_->warnings;
        report.load_ms = model_->load_ms;
        report.load_times = model_->load_times;
    }
    report.frames = log_.take_records();
    report.start_bytes = start_bytes;
    report.threads = parts_.jobs.threads();
    return report;
}

} // namespace scanout::app
