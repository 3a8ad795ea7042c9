// The viewer converges to the reference, maps its errors and shows both side by side.
#include "app/picture/reference.h"
#include "app/session_fixture.h"
#include "image/heat_map.h"
#include "trace/render.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <xkbcommon/xkbcommon-keysyms.h>

namespace scanout::app {
namespace {

// Is asked every 20 ms; gives its events once the display is as it should be, in turn.
class WaitingInput final : public port::Input {
public:
    struct Entry {
        std::function<bool()> until;
        std::vector<port::Event> events;
    };
    explicit WaitingInput(std::vector<Entry> entries)
        : entries_(std::move(entries)), timer_(::timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK)) {
        itimerspec spec{};
        spec.it_value.tv_nsec = spec.it_interval.tv_nsec = 20'000'000;
        ::timerfd_settime(timer_.get(), 0, &spec, nullptr);
    }
    int event_fd() const override { return timer_.get(); }
    Result<void> dispatch(std::vector<port::Event>& events) override {
        std::uint64_t expirations = 0;
        if (::read(timer_.get(), &expirations, sizeof expirations) != sizeof expirations) return {};
        const bool late = std::chrono::steady_clock::now() - start_ > 60s;
        if (late || next_ == entries_.size()) {
            timed_out = late && next_ < entries_.size();
            events.push_back(quit());
        } else if (entries_[next_].until()) {
            const std::vector<port::Event>& due = entries_[next_++].events;
            events.insert(events.end(), due.begin(), due.end());
        }
        return {};
    }
    std::string description() const override { return "waiting"; }
    bool timed_out = false;

private:
    std::vector<Entry> entries_;
    std::size_t next_ = 0;
    Fd timer_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class AccuracySession : public Session {
protected:
    AccuracySession() {
        width = 64;
        height = 48;
        settings.converge = Converge::automatic;
    }
    // The picture of `scanout render --reference`.
    image::Image referred(const scene::Pose& pose) {
        const Planned p = planned(pose);
        return trace::render(p.model.scene, p.view, *look_of(p.plan), jobs)->image;
    }
    void run(port::Display& display, port::Input& input) {
        auto session = ViewSession::create(settings, {display, input, jobs, {}, {}, {}, false});
        ASSERT_TRUE(session);
        const Result<void> ended = (*session)->run();
        EXPECT_TRUE(ended) << (ended ? "" : ended.error().what);
    }
    static scene::Pose turned_left() {
        scene::Pose pose;
        pose.yaw = scene::wrap_angle(-5 * scene::kAngleUnitsPerDegree);
        return pose;
    }
    static port::Event release(std::uint32_t keysym) {
        port::Event event = press(keysym);
        event.pressed = false;
        return event;
    }
};

TEST_F(AccuracySession, ConvergesToTheReferenceShowsAKeysFrameAtOnceAndConvergesAgain) {
    port::HeadlessDisplay display = make_display();
    const image::Image first = referred({}), second = referred(turned_left()),
                       drawn = rendered(turned_left());
    ASSERT_NE(first, rendered({}));
    ASSERT_NE(second, drawn);
    bool was_drawn = false;
    WaitingInput input(
        {{[&] { return display.shown() == first; }, {press(XKB_KEY_Left), release(XKB_KEY_Left)}},
         {[&] {
              was_drawn = was_drawn || display.shown() == drawn;
              return was_drawn;
          },
          {}},
         {[&] { return display.shown() == second; }, {}}});
    run(display, input);
    EXPECT_FALSE(input.timed_out);
    EXPECT_TRUE(was_drawn);
}

TEST_F(AccuracySession, OnceConvergedNoFrameIsDrawnAndTheProcessSleeps) {
    port::HeadlessDisplay display = make_display();
    const image::Image reference = referred({});
    double busy = 0;
    std::size_t frames = 0;
    std::chrono::steady_clock::time_point since;
    const auto begin_quiet = [&] {
        busy = cpu_seconds();
        frames = display.frames();
        since = std::chrono::steady_clock::now();
    };
    // The last frames may show what the display has already: a second begins with the last one.
    WaitingInput input({{[&] {
                             begin_quiet();
                             return display.shown() == reference;
                         },
                         {}},
                        {[&] {
                             if (display.frames() != frames) begin_quiet();
                             return std::chrono::steady_clock::now() - since > 1s;
                         },
                         {}}});
    run(display, input);
    ASSERT_FALSE(input.timed_out) << "it goes on drawing";
    EXPECT_EQ(display.shown(), reference);
    EXPECT_LT(cpu_seconds() - busy, 0.3) << "a second of looking every 20 ms";
}

TEST_F(AccuracySession, WhatTheUserNamedStays) {
    settings.frame.samples = 1;
    for (const bool off : {false, true}) {
        settings.converge = off ? Converge::off : Converge::automatic;
        settings.frame.aa = off ? "auto" : "samples_2";
        settings.named_axes = {"aa"};
        EXPECT_EQ(last_frame({{2500ms, {quit()}}}), rendered({}));
    }
    settings.converge = Converge::on;
    settings.frame.aa = "samples_2";
    port::HeadlessDisplay display = make_display();
    const image::Image reference = referred({});
    WaitingInput input({{[&] { return display.shown() == reference; }, {}}});
    run(display, input);
    EXPECT_FALSE(input.timed_out);
}

// The reference has no lines: they would be lost.
TEST_F(AccuracySession, AModelWithLinesOrTooLargeAOneIsNotConvergedAndSaysWhy) {
    width = 640;
    height = 100;
    const auto message_of = [&] {
        const image::Image shown = last_frame({{1500ms, {quit()}}}), drawn = rendered({});
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < width; ++x)
                if (shown.at(x, y) != drawn.at(x, y)) return std::string("another picture");
        const image::Image expected =
            with_message(drawn, "no reference: it draws no lines and points, which this model has");
        return std::string(shown == drawn ? "none" : shown == expected ? "lines" : "another");
    };
    settings.arguments = {folder.write("lines.obj", std::string(kCube) + "l 1 7\n")};
    EXPECT_EQ(message_of(), "lines");
    settings.arguments = {folder.write("cube.obj", kCube)};
    settings.max_memory_mb = 1;
    width = height = 300;
    EXPECT_EQ(message_of(), "another");
}

// Rows without any overlay.
void expect_same_rows(const image::Image& a, const image::Image& b, int x0, int x1, int y1) {
    for (int y = 0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            ASSERT_EQ(a.at(x, y), b.at(x, y)) << x << " " << y;
}

TEST_F(AccuracySession, AReplayShowsTheWholeErrorMapAndTheSplitView) {
    width = 200;
    height = 150;
    port::HeadlessDisplay display = make_display();
    const std::string map = folder.file("map.png"), split = folder.file("split.png"),
                      moved = folder.file("moved.png"), closed = folder.file("closed.png");
    ASSERT_TRUE(play("toggle_error_map\nframe " + map +
                         "\n+1 toggle_error_map\ntoggle_split\nframe " + split +
                         "\n+1 pointer 100 10\n+0 drag_begin\ndrag_rotate -40 3\ndrag_end\n" +
                         "+300 frame " + moved + "\n+1 close\n+0 frame " + closed + "\n",
                     display));
    const image::Image drawn = rendered({}), reference = referred({});
    expect_same_rows(*image::load(map), image::heat_map(reference, drawn), 0, width, 20);
    const image::Image by_half = *image::load(split), by_less = *image::load(moved);
    expect_same_rows(by_half, drawn, 0, 98, 80);
    expect_same_rows(by_half, reference, 102, width, 80);
    expect_same_rows(by_less, drawn, 0, 58, 80);
    expect_same_rows(by_less, reference, 62, width, 80);
    EXPECT_EQ(*image::load(closed), drawn);
}

TEST_F(AccuracySession, AReplayOfAMapIsTheSameEachTimeAndAMovingModelHasNone) {
    const std::string first = folder.file("1.png"), again = folder.file("2.png"),
                      moving = folder.file("3.png");
    const auto picture = [&](const std::string& file, const std::string& before) {
        port::HeadlessDisplay display = make_display();
        EXPECT_TRUE(
            play(before + "toggle_error_map\npointer 30 20\ntoggle_info\nframe " + file + "\n",
                 display));
        return *image::load(file);
    };
    const image::Image map = picture(first, "");
    EXPECT_EQ(picture(again, ""), map);
    EXPECT_NE(picture(moving, "toggle_turntable\n"), map);
}

// Live, V alone makes the reference, even where the picture does not converge to it.
TEST_F(AccuracySession, VMakesTheReferenceAndTakesItsMapAwayAgain) {
    settings.converge = Converge::off;
    width = 200;
    height = 150;
    port::HeadlessDisplay display = make_display();
    const image::Image drawn = rendered({}), map = image::heat_map(referred({}), drawn);
    const auto shows = [&](const image::Image& picture) {
        const image::Image now = display.shown();
        constexpr std::ptrdiff_t kRows = 20; // above the legend
        return std::equal(now.pixels().begin(), now.pixels().begin() + kRows * width,
                          picture.pixels().begin());
    };
    WaitingInput input({{[&] { return shows(drawn); }, {press(XKB_KEY_v)}},
                        {[&] { return shows(map); }, {press(XKB_KEY_v)}},
                        {[&] { return shows(drawn); }, {}}});
    run(display, input);
    EXPECT_FALSE(input.timed_out);
}

// A display that says when it was given a frame.
class ClockedDisplay final : public port::Display {
public:
    ClockedDisplay(int width, int height) {
        info_.width = width;
        info_.height = height;
    }
    const port::DisplayInfo& info() const override { return info_; }
    bool ready() const override { return true; }
    Result<void> present(const image::Image&, std::span<const image::Rect>) override {
        if (waits) last = std::chrono::steady_clock::now();
        waits = false;
        ++frames;
        return {};
    }
    bool paced() const override { return false; }
    int event_fd() const override { return -1; }
    Result<void> dispatch() override { return {}; }
    bool lost() const override { return false; }
    std::chrono::steady_clock::time_point last{};
    int frames = 0;
    bool waits = false;

private:
    port::DisplayInfo info_;
};

// Keys come 505, 510, 515 ... ms after the last one: while the hierarchy is built, and later.
TEST_F(AccuracySession, AKeyIsHeardWhileTheReferenceIsMade) {
    settings.arguments = {SCANOUT_SOURCE_DIR "/models/rabbit/rabbit.obj"};
    width = 320;
    height = 200;
    ClockedDisplay display(width, height);
    struct Keys final : port::Input {
        explicit Keys(ClockedDisplay& d) : display(d), timer(::timerfd_create(CLOCK_MONOTONIC, 0)) {
            arm();
        }
        int event_fd() const override { return timer.get(); }
        Result<void> dispatch(std::vector<port::Event>& events) override {
            std::uint64_t expirations = 0;
            [[maybe_unused]] const auto n = ::read(timer.get(), &expirations, sizeof expirations);
            if (pressed != decltype(pressed)()) latency.push_back(display.last - pressed);
            pressed = due;
            display.waits = true;
            port::Event up = press(XKB_KEY_Left);
            up.pressed = false;
            events = {press(XKB_KEY_Left), up};
            if (++count == 7) events.push_back(quit());
            arm();
            return {};
        }
        std::string description() const override { return "keys"; }
        void arm() {
            due = std::chrono::steady_clock::now() + 500ms + count * 10ms;
            itimerspec spec{};
            const auto ns = std::chrono::nanoseconds(due.time_since_epoch()).count();
            spec.it_value.tv_sec = ns / 1'000'000'000;
            spec.it_value.tv_nsec = ns % 1'000'000'000;
            ::timerfd_settime(timer.get(), TFD_TIMER_ABSTIME, &spec, nullptr);
        }
        ClockedDisplay& display;
        Fd timer;
        int count = 0;
        std::chrono::steady_clock::time_point due{}, pressed{};
        std::vector<std::chrono::nanoseconds> latency;
    } input(display);
    run(display, input);
    ASSERT_EQ(input.latency.size(), 6U);
#ifdef SCANOUT_SANITIZED
    constexpr auto kSoon = 1000ms; // its steps are instrumented
#else
    constexpr auto kSoon = 250ms;
#endif
    for (const auto latency : input.latency) {
        EXPECT_GT(latency, 0ns) << "a frame was shown";
        EXPECT_LT(latency, kSoon) << "on a busy machine; else under 20 ms";
    }
}

// A display that would have a frame each 10 us: none is in time, whatever the machine.
class HurryingDisplay final : public port::Display {
public:
    HurryingDisplay(int width, int height) : shown(width, height) {
        info_.width = width;
        info_.height = height;
        info_.refresh_hz = 100'000;
    }
    const port::DisplayInfo& info() const override { return info_; }
    bool ready() const override { return true; }
    Result<void> present(const image::Image& frame, std::span<const image::Rect>) override {
        shown = frame;
        return {};
    }
    bool paced() const override { return false; }
    int event_fd() const override { return -1; }
    Result<void> dispatch() override { return {}; }
    bool lost() const override { return false; }
    image::Image shown;

private:
    port::DisplayInfo info_;
};

TEST_F(AccuracySession, WhileItMovesFewerPixelsAreDrawnAndAllOfThemWhenItIsStill) {
    settings.converge = Converge::off;
    settings.arguments = {SCANOUT_SOURCE_DIR "/models/spot/spot.obj"};
    width = 1280;
    height = 960;
    for (const bool holds : {true, false}) {
        settings.holds_budget = holds;
        HurryingDisplay display(width, height);
        TimedInput timed(
            {{100ms, {press(XKB_KEY_space)}}, {1000ms, {press(XKB_KEY_Home)}}, {1000ms, {quit()}}});
        struct Looking final : port::Input {
            explicit Looking(TimedInput& t) : timed(t) {}
            int event_fd() const override { return timed.event_fd(); }
            Result<void> dispatch(std::vector<port::Event>& events) override {
                levels.push_back(session->motion_level());
                return timed.dispatch(events);
            }
            std::string description() const override { return "looking"; }
            TimedInput& timed;
            ViewSession* session = nullptr;
            std::vector<int> levels;
        } input(timed);
        auto session = ViewSession::create(settings, {display, input, jobs, {}, {}, {}, false});
        input.session = session->get();
        ASSERT_TRUE((*session)->run());
        ASSERT_EQ(input.levels.size(), 3U);
        EXPECT_EQ(input.levels[1] > 0, holds);
        EXPECT_EQ(input.levels[2], 0);
        EXPECT_EQ(display.shown, rendered({}));
    }
}

} // namespace
} // namespace scanout::app
