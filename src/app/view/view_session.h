// The viewer on a machine: display, input and files around a Viewer. The loop is epoll: it sleeps
// until there is input, a flip or a step of something that moves; it draws when what should be seen
// differs from what was shown, at most once a refresh.
#pragma once

#include "app/frontier/budget.h"
#include "app/overlay/overlay.h"
#include "app/picture/composer.h"
#include "app/picture/picture_key.h"
#include "app/report/explain_report.h"
#include "app/view/accuracy_view.h"
#include "app/view/bindings.h"
#include "app/view/event_loop.h"
#include "app/view/file_watch.h"
#include "app/view/frame_log.h"
#include "app/view/frame_pacer.h"
#include "app/view/governor.h"
#include "app/view/live_doctor.h"
#include "app/view/live_explain.h"
#include "app/view/live_frontier.h"
#include "app/view/model_slot.h"
#include "app/view/motion_levels.h"
#include "app/view/recording.h"
#include "app/view/rung_stepper.h"
#include "app/view/script_player.h"
#include "app/view/settling.h"
#include "app/view/timed_message.h"
#include "app/view/viewer.h"
#include "app/view/virtual_clock.h"
#include "frame/blank_picture.h"
#include "frame/renderer.h"
#include "port/display.h"
#include "port/input.h"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace scanout::app {

struct SessionParts {
    port::Display& display;
    port::Input& input;
    Jobs& jobs;
    // Ctrl-Z: gives the console back and returns when the process is continued.
    std::function<Result<void>(std::vector<port::Event>&)> suspend;
    std::optional<Recorder> recorder;
    std::optional<Script> script;
    // A script is played at once instead of in real time: nobody watches.
    bool instant = false;
    // What a frame takes now, of CPU time, ms; empty: it is timed.
    std::function<double(const frame::FramePlan&)> time_now = {};
    KeyMap keys = KeyMap::standard();
};

class ViewSession {
public:
    static Result<std::unique_ptr<ViewSession>> create(const Settings& settings,
                                                       SessionParts parts);

    // Until the user quits. Fails when the only model cannot be shown, or the display is gone.
    Result<void> run();

    RunReport report(std::uint64_t start_bytes);
    int motion_level() const { return level_; } // of governor.h; 0 when all is still
    std::string options() const;                // that show the same as now; empty: none do
    // What K noted, for standard output once the console is text again.
    const std::vector<std::string>& noted_commands() const { return noted_commands_; }

private:
    using Time = VirtualClock::Time;

    ViewSession(const Settings& settings, SessionParts parts, std::optional<FileWatch> watch,
                EventLoop loop);

    // Files (view_session_files.cpp).
    const std::string& path() const; // of the model on show
    Result<void> load(bool again);
    Result<void> report_plan();
    Result<void> choose_rungs(); // where --budget or --max-error asks for them
    // A session in which no model could be read has failed.
    Result<void> outcome() const;
    bool report_progress(const std::string& doing, double share, Time start);
    void examine(); // for the panel of hazards
    bool wants_to_leave();
    void follow_section();
    void watch_files(const LoadedModel& model); // that it was read from
    Result<void> follow_files(Time now); // with --watch: reads them again when they have changed
    Result<void> write_screenshot();
    std::string command() const; // likewise
    void note_command();
    void pick();

    // Actions and time.
    Result<void> take(const Action& action);
    Result<void> change_culling(const Action& action);
    void describe_input();
    Result<void> take_input();
    Result<void> play_script();
    Result<void> advance(Time now);
    Result<void> pass_steps(std::int64_t target);
    std::optional<std::int64_t> next_change() const;
    std::optional<std::int64_t> next_step() const;
    Result<void> follow_display();
    void follow_size(); // of the display
    Result<void> let_go_of_all();
    Result<void> run_instantly();
    static constexpr int kMessageSteps = 3 * kStepsPerSecond;
    // On the picture for a moment; not where the picture has to be the same in every run.
    void show_message(const std::string& text, int steps);
    void tell(const std::string& text);  // the same, and a line on standard error
    void refuse(const std::string& why); // the same of what cannot be shown; --quiet leaves it out
    Result<void> wait();

    // The plan on the picture.
    PictureKey key() const;
    Result<const frame::FramePlan*> plan(int level = 0);
    ScreenPage explain_page();
    Viewer::Pages pages_for(ActionId id);
    bool shows_info() const;
    std::size_t panel_lines() const;
    ScreenPage warnings() const;
    bool lacks_rows() const;
    bool wants_row();
    Result<void> measure_row();

    // Accuracy (view_session_accuracy.cpp).
    static bool converges(const Settings& settings);
    AccuracyView::Asked asked() const;
    bool wants_trace();
    Result<void> trace_step();
    Result<void> begin_reference();
    Result<void> finish_reference();
    Result<void> refuse_reference(const std::string& why);

    // Rungs (view_session_rungs.cpp).
    void step_rung(int by);
    bool wants_frontier_step();
    Result<void> measure_frontier();
    Result<void> begin_frontier();
    void refuse_frontier(const std::string& why);
    void put_frontier(measure::KnownFrontier frontier);
    FrontierPanel frontier_panel() const;
    Result<void> follow_switch(const Action& action); // switches/view_session_switches.cpp
    std::vector<measure::Rung> counting_rungs(const measure::KnownPoint& point) const;
    double budget_ms() const; // of a frame while something moves
    // Whose rungs are drawn, by keys or else by limits; null: as asked for.
    const measure::KnownPoint* chosen_point() const;

    // Motion and frames (view_session_frames.cpp).
    void set_motion_levels();
    void follow_motion(Time now);

    struct Shown {
        PictureKey picture;
        int level = 0; // of governor.h
        Overlay overlay;
        int accuracy = 0; // the view's revision
        std::optional<PixelPlace> pointer;
        friend bool operator==(const Shown&, const Shown&) = default;
    };
    std::optional<PixelPlace> pointer() const; // where it is seen
    Shown wanted();
    Overlay overlay();
    bool wants_frame() { return repaint_ || frame_file_ || !(wanted() == shown_); }
    // Without what rungs were chosen; in the room of what `out` holds.
    void put_asked_frame_options(frame::FrameOptions& out) const;
    void set_frame_options(int level = 0);
    Result<void> render(int level = 0);
    void compose(const Overlay& overlay, int level);
    void compose_on(const image::Image& picture, const Overlay& overlay);
    Result<void> draw(const Shown& wanted);
    Result<void> draw_if_due(Time now);
    const image::Image& displayed();
    Result<void> present();

    const Settings& settings_;
    SessionParts parts_;
    std::optional<FileWatch> watch_; // none: without --watch
    std::optional<Time> reload_at_;  // files have changed
    EventLoop loop_;
    bool steady_; // nothing on the screen depends on clock or folder
    bool converges_;
    Viewer viewer_;
    Binder binder_;
    VirtualClock clock_;
    ScriptPlayer script_;
    ModelSlot slot_;
    TimedMessage message_;
    LiveExplain explain_;
    LiveDoctor doctor_;
    AccuracyView accuracy_;
    RungStepper rungs_;
    LiveFrontier frontier_;
    std::string frontier_key_; // of the one that is measured
    PictureKey frontier_of_;   // the picture whose frontier it is
    int refusal_told_ = -1;    // the generation of the model of which it was said
    frame::Renderer renderer_;
    Composer composer_;
    FramePacer pacer_;
    std::vector<MotionLevel> levels_;
    std::optional<Governor> governor_; // none: no budget is held
    Settling settling_;
    int level_ = 0; // of the next frame
    FrameLog log_;

    std::vector<port::Event> events_;
    std::int64_t input_ns_ = 0; // when the first of the events happened
    std::string input_described_;
    std::vector<std::string> noted_commands_;
    std::optional<std::string> frame_file_; // where a script wants the next frame
    std::optional<Chosen> chosen_;          // by --budget or --max-error
    frame::FrameOptions frame_options_;     // of the picture, in the room of the last
    Shown shown_;
    image::Image background_;
    const image::Image* picture_ = nullptr;
    image::Image undithered_;           // of a display that would dither; else empty
    std::optional<frame::Blank> blank_; // why the picture shows nothing of the model
    bool lost_ = false, repaint_ = true, quit_ = false;
    bool input_was_read_ = false; // standard input, as a model
};

} // namespace scanout::app
