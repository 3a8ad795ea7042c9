// Sessions of the viewer without a machine: input that comes by a clock, a display in memory.
#pragma once

#include "app/view/view_session.h"
#include "image/codec.h"
#include "port/headless.h"
#include "scene/fit.h"
#include "support/temporary_folder.h"

#include <chrono>
#include <ctime>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/timerfd.h>
#include <unistd.h>

namespace scanout::app {

using namespace std::chrono_literals;

inline constexpr const char* kCube =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

inline port::Event press(std::uint32_t keysym) {
    port::Event event;
    event.kind = port::EventKind::key;
    event.keysym = event.base_keysym = event.keycode = keysym;
    event.pressed = event.repeats = true;
    return event;
}

// Gives its events one after the other, each after a pause, and then quits.
class TimedInput final : public port::Input {
public:
    struct Entry {
        std::chrono::milliseconds pause;
        std::vector<port::Event> events;
    };
    explicit TimedInput(std::vector<Entry> entries)
        : entries_(std::move(entries)), timer_(::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK)) {
        arm();
    }
    int event_fd() const override { return timer_.get(); }
    Result<void> dispatch(std::vector<port::Event>& events) override {
        std::uint64_t expirations = 0;
        if (::read(timer_.get(), &expirations, sizeof expirations) != sizeof expirations) return {};
        const std::vector<port::Event>& due = entries_[next_++].events;
        events.insert(events.end(), due.begin(), due.end());
        arm();
        return {};
    }
    std::string description() const override { return "timed"; }

private:
    void arm() {
        if (next_ == entries_.size()) return;
        itimerspec spec{};
        spec.it_value.tv_nsec = entries_[next_].pause.count() * 1'000'000 % 1'000'000'000;
        spec.it_value.tv_sec = entries_[next_].pause.count() / 1000;
        ::timerfd_settime(timer_.get(), 0, &spec, nullptr);
    }
    std::vector<Entry> entries_;
    std::size_t next_ = 0;
    Fd timer_;
};

inline port::Event quit() {
    port::Event event;
    event.kind = port::EventKind::quit;
    return event;
}

inline double cpu_seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

class Session : public ::testing::Test {
protected:
    Session() {
        settings.arguments = {folder.write("cube.obj", kCube)};
        settings.quiet = true;
        settings.converge = Converge::off;
        settings.holds_budget = false; // a busy machine's frames are late
    }
    port::HeadlessDisplay make_display(const image::PixelFormat& format = {}) {
        return std::move(*port::HeadlessDisplay::create(width, height, format));
    }
    // Runs until the input quits; how many frames were presented.
    std::size_t run(std::vector<TimedInput::Entry> entries) {
        port::HeadlessDisplay display = make_display();
        TimedInput input(std::move(entries));
        auto session = ViewSession::create(settings, {display, input, jobs, {}, {}, {}, false});
        EXPECT_TRUE(session);
        const Result<void> ended = (*session)->run();
        EXPECT_TRUE(ended) << ended.error().what;
        return display.frames();
    }
    // What is on the display at the end.
    image::Image last_frame(std::vector<TimedInput::Entry> entries) {
        port::HeadlessDisplay display = make_display();
        TimedInput input(std::move(entries));
        auto session =
            ViewSession::create(settings, {display, input, jobs, {}, {}, {}, false, time_now});
        EXPECT_TRUE((*session)->run());
        return display.shown();
    }
    static image::Image with_message(image::Image picture, const std::string& message) {
        Overlay overlay;
        overlay.message = message;
        draw_overlay(picture, overlay);
        return picture;
    }
    // Plays a script at once; leaves its pictures in the folder.
    Result<void> play(const std::string& text, port::Display& display) {
        TimedInput input({{1h, {quit()}}});
        TRY(const Script script, parse_script("scanout-actions 1\n" + text, "script"));
        settings.replay = "script";
        TRY(const auto session,
            ViewSession::create(settings, {display, input, jobs, {}, {}, script, true}));
        return session->run();
    }
    scene::CameraOptions fitted(const LoadedModel& model) const {
        return scene::fitted(model.whole_mesh(), settings.model, settings.camera,
                             static_cast<double>(width) / height);
    }
    // What a picture for the same settings is drawn from.
    struct Planned {
        LoadedModel model;
        scene::View view;
        frame::FramePlan plan;
    };
    Planned planned(const scene::Pose& pose) {
        LoadedModel model = *load_model(settings.arguments.front(), settings, jobs, {});
        frame::FrameOptions options = settings.frame;
        options.width = width;
        options.height = height;
        const scene::View view = *scene::make_view(model.scene.mesh, settings.model, pose,
                                                   fitted(model), {}, width, height);
        frame::FramePlan plan = *frame::plan(options, frame::facts(model.scene), view);
        return {std::move(model), view, std::move(plan)};
    }
    // The picture of `scanout render` for the same settings.
    image::Image rendered(const scene::Pose& pose) {
        const Planned p = planned(pose);
        frame::Renderer renderer(jobs);
        return renderer.render(p.model.scene, p.view, p.plan);
    }

    test::TemporaryFolder folder;
    int width = 160, height = 120;
    Settings settings;
    std::function<double(const frame::FramePlan&)> time_now; // empty: by the clock
    Jobs jobs{2};
};

} // namespace scanout::app
