// The viewer on a machine: display, input and files around a Viewer. The loop is epoll: it sleeps
// until there is input, a flip or a step of something that moves; it draws when what should be seen
// differs from what was shown, at most once a refresh.
#pragma once

#include "app/bindings.h"
#include "app/composer.h"
#include "app/explain_report.h"
#include "app/frame_log.h"
#include "app/model_file.h"
#include "app/overlay.h"
#include "app/recording.h"
#include "app/viewer.h"
#include "app/virtual_clock.h"
#include "base/fd.h"
#include "frame/plan/plan_cache.h"
#include "frame/renderer.h"
#include "measure/explain.h"
#include "port/display.h"
#include "port/input.h"

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
};

class ViewSession {
public:
    static Result<std::unique_ptr<ViewSession>> create(const Settings& settings,
                                                       SessionParts parts);

    // Until the user quits. Fails when the only model cannot be shown, or the display is gone.
    Result<void> run();

    RunReport report(std::uint64_t start_bytes);
    int frames_drawn() const { return log_.count(); }

private:
    using Time = VirtualClock::Time;

    ViewSession(const Settings& settings, SessionParts parts, Fd epoll, Fd timer);

    // Files.
    Result<void> load(bool again);
    // A session in which no model could be read has failed.
    Result<void> outcome() const;
    bool report_progress(double share);
    bool wants_to_leave();

    // Actions and time.
    Result<void> take(const Action& action);
    void describe_input();
    Result<void> take_input();
    Result<void> play_script();
    Result<void> advance(Time now);
    Result<void> pass_steps(std::int64_t target);
    std::optional<std::int64_t> next_step() const;
    Result<void> follow_display();
    Result<void> let_go_of_all();
    Result<void> run_instantly();
    Result<void> write_screenshot();
    void show_message(const std::string& text);

    // Frames.
    struct Shown {
        Look look;
        int generation = -1; // of what load() did
        Overlay overlay;
        std::optional<PixelPlace> pointer;
        friend bool operator==(const Shown&, const Shown&) = default;
    };
    Shown wanted() const;
    Overlay overlay() const;
    ScreenPage explain_page() const;
    bool wants_frame() const { return repaint_ || frame_file_ || !(wanted() == shown_); }
    Result<void> draw(const Shown& wanted);
    void fill(frame::FrameOptions& options) const;
    frame::FrameOptions options() const;
    Result<frame::FramePlan> plan() const;
    bool wants_row() const;
    Result<void> explain_a_row();
    bool explains_this() const;
    bool lacks_rows() const;
    Result<void> render();
    const image::Image& frame();
    Result<void> present();
    Result<void> draw_if_due(Time now);
    Result<void> wait();

    const Settings& settings_;
    SessionParts parts_;
    Fd epoll_, timer_;
    bool steady_; // nothing on the screen depends on clock or folder
    Viewer viewer_;
    Binder binder_;
    VirtualClock clock_;
    frame::Renderer renderer_;
    Composer composer_;
    FrameLog log_;

    std::optional<LoadedModel> model_;
    frame::PlanCache plan_;       // of it
    frame::FrameOptions options_; // of the picture
    std::string error_;           // why there is no model
    bool showed_model_ = false;
    int generation_ = 0;
    std::size_t next_entry_ = 0;            // of the script
    std::optional<std::string> frame_file_; // a script's frame that is due
    std::vector<port::Event> events_;
    std::string message_;
    std::int64_t message_hides_ = 0;
    std::string input_described_;

    Shown shown_;
    image::Image background_;
    const image::Image* picture_ = nullptr;
    image::Image undithered_; // of a display that would dither; else empty
    bool in_view_ = true;     // the picture shows some of the model

    // What each effect costs and changes, found out while nothing else happens, for what is shown.
    std::unique_ptr<measure::Explainer> explainer_;
    std::size_t rows_ = 0; // measured
    Look explained_look_;
    int explained_generation_ = -1;

    bool lost_ = false, repaint_ = true, quit_ = false;
    Time due_{}, last_draw_{}, load_start_{};
    double frames_per_second_ = 0;
};

} // namespace scanout::app
