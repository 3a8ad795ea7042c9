#include "app/session_fixture.h"
#include "image/hash.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <sys/timerfd.h>
#include <unistd.h>
#include <xkbcommon/xkbcommon-keysyms.h>

namespace scanout::app {
namespace {

TEST_F(Session, NothingIsDrawnWhenNothingChangesAndTheProcessSleeps) {
    const double before = cpu_seconds();
    EXPECT_EQ(run({{1500ms, {quit()}}}), 1U) << "the first frame alone";
    EXPECT_LT(cpu_seconds() - before, 0.5) << "1.5 s of waiting";
}

// HARD-CASES Z5, with the plan on the picture: once its figures are there, a frame a row, it is
// text like any other and costs nothing to keep.
TEST_F(Session, TenSecondsWithoutInputDrawNoFrameAndTakeLessThanAThousandthOfTheProcessor) {
    port::HeadlessDisplay display = make_display();
    TimedInput timed({{100ms, {press(XKB_KEY_x)}}, {10s, {}}, {10s, {quit()}}});
    struct Looking final : port::Input { // at processor time and frames, each time it is asked
        Looking(TimedInput& t, port::HeadlessDisplay& d) : timed(t), display(d) {}
        int event_fd() const override { return timed.event_fd(); }
        Result<void> dispatch(std::vector<port::Event>& events) override {
            seen.emplace_back(cpu_seconds(), display.frames());
            return timed.dispatch(events);
        }
        std::string description() const override { return "looking"; }
        TimedInput& timed;
        port::HeadlessDisplay& display;
        std::vector<std::pair<double, std::size_t>> seen;
    } input(timed, display);
    auto session = ViewSession::create(settings, {display, input, jobs, {}, {}, {}, false});
    ASSERT_TRUE((*session)->run());
    ASSERT_EQ(input.seen.size(), 3U) << "nothing else wakes it up";
    EXPECT_GT(input.seen[1].second, 20U) << "the first frame, the plan, and its rows' figures";
    EXPECT_EQ(input.seen[2].second, input.seen[1].second);
#ifndef SCANOUT_SANITIZED // ThreadSanitizer has a thread of its own, which does not sleep
    EXPECT_LT(input.seen[2].first - input.seen[1].first, 0.010);
#endif
}

// A pipe gives its bytes once.
TEST_F(Session, TheTimeFromAnInputToItsFrameIsThatOfTheEventsOwnClock) {
    settings.json = "";
    settings.no_times = true;
    const auto key = [](std::uint32_t keysym, std::chrono::seconds ago) {
        port::Event event = press(keysym);
        event.repeats = false;
        event.time_ns =
            std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch() - ago)
                .count();
        return event;
    };
    port::Event untimed = key(XKB_KEY_Left, 1s);
    untimed.time_ns = 0;
    port::HeadlessDisplay display = make_display();
    TimedInput input({{10ms, {key(XKB_KEY_Left, 100s), untimed}}, // one frame of both
                      {10ms, {key(XKB_KEY_Page_Down, 500s)}},     // nothing changes
                      {10ms, {key(XKB_KEY_Right, 0s)}},
                      {10ms, {quit()}}});
    auto session = ViewSession::create(settings, {display, input, jobs, {}, {}, {}, false});
    ASSERT_TRUE((*session)->run());
    std::vector<double> ms = (*session)->report(0).input_to_screen_ms;
    ASSERT_EQ(ms.size(), 2U);
    EXPECT_GE(ms[0], 100'000) << "since the first of them";
    EXPECT_LT(ms[0], 400'000);
    EXPECT_GT(ms[1], 0);
    EXPECT_LT(ms[1], 400'000) << "and not since the one that changed nothing";
}

TEST_F(Session, AModelFromStandardInputIsReadOnce) {
    const image::Image cube = rendered({});
    const std::string before = folder.file("before.png"), after = folder.file("after.png");
    const Fd model = *Fd::open(settings.arguments.front(), O_RDONLY);
    const Fd old(::dup(STDIN_FILENO));
    ASSERT_EQ(::dup2(model.get(), STDIN_FILENO), STDIN_FILENO);
    settings.arguments = {"-"};
    port::HeadlessDisplay display = make_display();
    const Result<void> played =
        play("frame " + before + "\n+1 reload\n+1 frame " + after + "\n", display);
    ::dup2(old.get(), STDIN_FILENO);
    ASSERT_TRUE(played) << played.error().what;
    EXPECT_EQ(*image::load(before), cube);
    EXPECT_EQ(*image::load(after), cube);
}

TEST_F(Session, XLaysThePlanOnThePictureAndTakesItAway) {
    const std::string open = folder.file("open.png"), closed = folder.file("closed.png");
    port::HeadlessDisplay display = make_display();
    ASSERT_TRUE(
        play("toggle_explain\nframe " + open + "\n+1 close\nframe " + closed + "\n", display));
    EXPECT_EQ(*image::load(closed), rendered({}));
    EXPECT_NE(*image::load(open), rendered({}));
}

// What needs no clock is there at once, and the same in every run.
TEST_F(Session, AReplayShowsThePlanWithItsFigures) {
    const std::string first = folder.file("first.png"), again = folder.file("again.png");
    for (const std::string& file : {first, again}) {
        port::HeadlessDisplay display =
            std::move(*port::HeadlessDisplay::create(1000, 700, image::PixelFormat{}));
        ASSERT_TRUE(play("toggle_explain\nframe " + file + "\n", display));
    }
    EXPECT_EQ(*image::load(first), *image::load(again));
    // The plan's reasons alone are narrower than a table with figures.
    std::optional<port::HeadlessDisplay> display;
    display.emplace(std::move(*port::HeadlessDisplay::create(1000, 700, image::PixelFormat{})));
    const std::string moving = folder.file("moving.png");
    ASSERT_TRUE(play("toggle_turntable\ntoggle_explain\nframe " + moving + "\n", *display));
    EXPECT_NE(*image::load(moving), *image::load(first));
}

TEST_F(Session, XTurnsThePagesOfThePlanAndThenTakesItAway) {
    port::HeadlessDisplay display =
        std::move(*port::HeadlessDisplay::create(640, 480, image::PixelFormat{}));
    std::string script;
    for (int press = 0; press < 6; ++press)
        script += fmt::format("+0 toggle_explain\n+1 frame {}\n",
                              folder.file(std::to_string(press) + ".png"));
    ASSERT_TRUE(
        play(script + "+0 toggle_explain\n+0 close\n+1 frame " + folder.file("none.png") + "\n",
             display));
    const image::Image none = *image::load(folder.file("none.png"));
    std::vector<image::Image> pages;
    int press = 0;
    for (; press < 6; ++press) {
        pages.push_back(*image::load(folder.file(std::to_string(press) + ".png")));
        if (pages.back() == none) break;
        for (int earlier = 0; earlier < press; ++earlier)
            EXPECT_NE(pages[static_cast<std::size_t>(earlier)], pages.back());
    }
    EXPECT_GE(press, 2) << "the reasons are more than a page";
    EXPECT_LT(press, 6) << "the last page is followed by none";
}

// At the lower left, where nothing else stands.
TEST_F(Session, TheFirstSecondsNameTheKeysOfHelpAndEnd) {
    EXPECT_EQ(last_frame({{200ms, {quit()}}}), rendered({})) << "--quiet";
    settings.quiet = false;
    EXPECT_EQ(last_frame({{200ms, {quit()}}}), with_message(rendered({}), "H help, Q quit"));
    EXPECT_EQ(last_frame({{6500ms, {quit()}}}), rendered({})) << "it goes by itself";
    EXPECT_EQ(last_frame({{200ms, {press(XKB_KEY_Home)}}, {300ms, {quit()}}}), rendered({}))
        << "a key takes it away";
    settings.no_times = true;
    EXPECT_EQ(last_frame({{200ms, {quit()}}}), rendered({}));
}

TEST_F(Session, ASwitchShowsItsStateForAMoment) {
    width = 640; // room for the message
    EXPECT_EQ(last_frame({{100ms, {press(XKB_KEY_o)}}, {300ms, {quit()}}}),
              with_message(rendered({}), "keys drive: camera"));
    EXPECT_EQ(last_frame({{100ms, {press(XKB_KEY_o)}}, {3800ms, {quit()}}}), rendered({}));
}

TEST_F(Session, KNotesTheViewAsACommandForTheEnd) {
    port::HeadlessDisplay display = make_display();
    TimedInput input({{100ms, {press(XKB_KEY_Left), press(XKB_KEY_k)}}, {100ms, {quit()}}});
    auto session = ViewSession::create(settings, {display, input, jobs, {}, {}, {}, false});
    ASSERT_TRUE((*session)->run());
    ASSERT_EQ((*session)->noted_commands().size(), 1U);
    const std::string& command = (*session)->noted_commands().front();
    EXPECT_EQ(command.find("scanout render " + settings.arguments.front() + " --size 160x120 "), 0U)
        << command;
    EXPECT_NE(command.find(" --rotate 0,-5,0 "), std::string::npos) << command;
}

TEST_F(Session, CullingThatChangesNoPixelSaysSo) {
    width = 640; // room for the message
    const image::Image closed = rendered({});
    EXPECT_EQ(last_frame({{100ms, {press(XKB_KEY_c)}}, {300ms, {quit()}}}),
              with_message(closed, "faces left out: back (no pixel changes)"));
    // Its lower half alone, from above: the backs of the walls are seen.
    settings.arguments = {folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                                   "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                                                   "f 4 3 2 1\nf 1 2 6 5\nf 4 1 5 8\n")};
    settings.camera.elevation_degrees = 50;
    settings.frame.cull = frame::Cull::back;
    const image::Image culled = rendered({});
    settings.frame.cull = frame::Cull::material;
    EXPECT_EQ(last_frame({{100ms, {press(XKB_KEY_c)}}, {300ms, {quit()}}}),
              with_message(culled, "faces left out: back"));
}

TEST_F(Session, APictureThatShowsNothingSaysWhy) {
    width = 640; // room for the message
    const image::Image empty(width, height, settings.frame.background);
    settings.arguments = {folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nf 1 2 3\n")};
    settings.camera.elevation_degrees = 0;
    EXPECT_EQ(last_frame({{300ms, {quit()}}}),
              with_message(empty, "a flat model, seen from its edge: turn it, or press 9"));
    settings.camera.elevation_degrees = 90;
    settings.frame.cull = frame::Cull::back;
    EXPECT_EQ(last_frame({{300ms, {quit()}}}),
              with_message(empty, "all faces that look this way are left out: press C"));
    settings.frame.cull = frame::Cull::none;
    EXPECT_EQ(last_frame({{300ms, {quit()}}}), rendered({}));
}

TEST_F(Session, AKeyIsOneFrameAndAKeyWithoutEffectIsNone) {
    port::Event release = press(XKB_KEY_Left);
    release.pressed = false;
    EXPECT_EQ(run({{50ms, {press(XKB_KEY_Left), release}},
                   {300ms, {press(XKB_KEY_0)}},
                   {300ms, {quit()}}}),
              2U);
}

TEST_F(Session, MovingDrawsAtMostOnceARefresh) {
    const std::size_t frames =
        run({{50ms, {press(XKB_KEY_space)}}, {1000ms, {press(XKB_KEY_space)}}, {400ms, {quit()}}});
    EXPECT_GT(frames, 3U);
    EXPECT_LE(frames, 66U) << "60 a second, the first, and one on either side";
}

TEST_F(Session, AHeldKeyRepeatsUntilItIsReleased) {
    port::Event release = press(XKB_KEY_Left);
    release.pressed = false;
    const std::string file = folder.file("held.txt");
    settings.record = file;
    port::HeadlessDisplay display = make_display();
    TimedInput input({{20ms, {press(XKB_KEY_Left)}}, {1000ms, {release}}, {500ms, {quit()}}});
    auto session = ViewSession::create(
        settings, {display, input, jobs, {}, std::move(*Recorder::create(file)), {}, false});
    ASSERT_TRUE((*session)->run());
    const Script script = *load_script(file);
    int first = 0, repeated = 0;
    for (const TimedAction& action : script)
        if (action.action.id == ActionId::rotate_left)
            ++(action.action.repeated ? repeated : first);
    EXPECT_EQ(first, 1);
    EXPECT_GE(repeated, 1) << "600 ms of the 1000";
    EXPECT_LE(repeated, 25) << "none after the release";
    EXPECT_EQ(script.back().action.id, ActionId::quit);
}

TEST_F(Session, AReplayedFrameIsTheFrameThatRenderDraws) {
    port::HeadlessDisplay display = make_display();
    const std::string start = folder.file("start.png"), turned = folder.file("turned.png");
    ASSERT_TRUE(
        play("frame " + start + "\n+1 rotate_left\nrotate_up\n+1 frame " + turned + "\n", display));
    scene::Pose pose;
    EXPECT_EQ(*image::load(start), rendered(pose));
    pose.yaw = scene::wrap_angle(-5 * scene::kAngleUnitsPerDegree);
    pose.pitch = scene::wrap_angle(-5 * scene::kAngleUnitsPerDegree);
    EXPECT_EQ(*image::load(turned), rendered(pose));
    EXPECT_NE(*image::load(start), *image::load(turned));
}

// Moved away, smaller than a pixel, or all of it nearer than the picture begins.
TEST_F(Session, AModelThatIsLostSaysHowToComeBackAndRSeesItAgain) {
    const auto repeated = [](const std::string& line, int count) {
        std::string text;
        for (int i = 0; i < count; ++i)
            text += line + "\n";
        return text;
    };
    const image::Image empty(width, height, settings.frame.background);
    const std::string lost = folder.file("lost.png"), back = folder.file("back.png");
    for (const std::string& way : {repeated("move_right", 60), repeated("scale_down", 200),
                                   repeated("scale_up", 40) + repeated("move_up", 900),
                                   "toggle_drive\n" + repeated("move_left", 60)}) {
        port::HeadlessDisplay display = make_display();
        ASSERT_TRUE(play(way + "frame " + lost + "\n+1 reset\nframe " + back + "\n", display));
        const image::Image picture = *image::load(lost);
        EXPECT_NE(picture, empty) << way;
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < width; ++x)
                ASSERT_EQ(picture.at(x, y), empty.at(x, y))
                    << way << "lines at the lower left, no more";
        EXPECT_EQ(*image::load(back), rendered({})) << way;
    }
}

// The view of a key has a distance of its own, far too close for this scale.
TEST_F(Session, AViewThatIsNoneSaysHowToComeBackAndRSeesTheModelAgain) {
    settings.model.scale = DVec3(1e40);
    settings.camera.distance = 3e40;
    width = 640; // room for the message
    const image::Image empty(width, height, settings.frame.background);
    const std::string lost = folder.file("lost.png"), back = folder.file("back.png");
    port::HeadlessDisplay display = make_display();
    ASSERT_TRUE(play("view_front\nframe " + lost + "\n+1 reset\nframe " + back + "\n", display));
    const image::Image picture = *image::load(lost);
    EXPECT_NE(picture, empty);
    for (int y = 0; y < 90; ++y)
        for (int x = 0; x < width; ++x)
            ASSERT_EQ(picture.at(x, y), empty.at(x, y)) << "a line at the lower left, no more";
    EXPECT_EQ(*image::load(back), rendered({}));
}

TEST_F(Session, ARecordingOfAReplayIsTheReplay) {
    const std::string text =
        "0 rotate_left\n+30 drag_begin\ndrag_rotate 12 -3\n+1 drag_end\n+0 frame " +
        folder.file("a.png") + "\n+60 repeat roll_left\n+5 quit\n";
    const std::string file = folder.file("recorded");
    const Script script = *parse_script("scanout-actions 1\n" + text, "script");
    port::HeadlessDisplay display = make_display();
    TimedInput input({{1h, {quit()}}});
    settings.replay = "script";
    settings.record = file;
    auto session = ViewSession::create(
        settings, {display, input, jobs, {}, std::move(*Recorder::create(file)), script, true});
    ASSERT_TRUE((*session)->run());
    EXPECT_EQ(*load_script(file), script);
}

TEST_F(Session, AFrameOfANarrowDisplayIsWhatThatDisplayShows) {
    const image::PixelFormat narrow = *image::pixel_format("rgb565");
    port::HeadlessDisplay display = make_display(narrow);
    const std::string file = folder.file("narrow.png"), raw = folder.file("narrow.raw");
    ASSERT_TRUE(play("frame " + file + "\nframe " + raw + "\n", display));
    EXPECT_EQ(*image::load(file), image::as_displayed(narrow, rendered({})));
    EXPECT_EQ(display.shown(), *image::load(file));
    const std::string bytes = folder.read("narrow.raw");
    EXPECT_TRUE(
        std::equal(bytes.begin(), bytes.end(), display.bytes().begin(), display.bytes().end(),
                   [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }));
}

TEST_F(Session, ANarrowDisplayIsNotDitheredWhereNoneIsAskedFor) {
    const image::PixelFormat narrow = *image::pixel_format("rgb565");
    port::HeadlessDisplay display = make_display(narrow);
    const std::string file = folder.file("plain.png");
    settings.frame.dither = "none";
    ASSERT_TRUE(play("frame " + file + "\n", display));
    const image::Image plain = image::without_dither(narrow, rendered({}));
    EXPECT_NE(plain, image::as_displayed(narrow, rendered({})));
    EXPECT_EQ(*image::load(file), plain);
    EXPECT_EQ(display.shown(), plain);
}

TEST_F(Session, WhatWasRecordedLiveReplaysToTheSameLastFrame) {
    const std::string file = folder.file("live.txt");
    port::Event motion, button;
    motion.kind = port::EventKind::motion;
    motion.x = 13;
    motion.y = -7;
    button.kind = port::EventKind::button;
    button.pressed = true;
    port::Event up = button;
    up.pressed = false;
    settings.record = file;
    port::HeadlessDisplay live = make_display();
    TimedInput input({{20ms, {press(XKB_KEY_space)}},
                      {300ms, {press(XKB_KEY_space), button, motion}},
                      {50ms, {motion, up, press(XKB_KEY_i)}},
                      {50ms, {press(XKB_KEY_h)}},
                      {400ms, {quit()}}});
    auto session = ViewSession::create(
        settings, {live, input, jobs, {}, std::move(*Recorder::create(file)), {}, false});
    ASSERT_TRUE((*session)->run());
    port::HeadlessDisplay again = make_display();
    settings.record.clear();
    std::string text = folder.read("live.txt");
    text.erase(0, text.find('\n') + 1);
    ASSERT_TRUE(play(text, again));
    EXPECT_EQ(live.shown(), again.shown());
    EXPECT_NE(again.shown(), rendered({}));
}

TEST_F(Session, AModelThatCannotBeReadEndsASessionOfOneAndShowsItsErrorAmongSeveral) {
    const std::string good = settings.arguments.front(), bad = folder.write("bad.obj", "nothing\n");
    port::HeadlessDisplay display = make_display();
    settings.arguments = {bad};
    const Result<void> alone = play("quit\n", display);
    ASSERT_FALSE(alone);
    EXPECT_EQ(alone.error().exit, Exit::unreadable);
    settings.arguments = {good, bad};
    const std::string error = folder.file("error.png"), back = folder.file("back.png");
    ASSERT_TRUE(
        play("next_file\nframe " + error + "\n+1 next_file\nframe " + back + "\n", display));
    EXPECT_EQ(*image::load(back), rendered({}));
    EXPECT_NE(*image::load(error), *image::load(back));
    // Text on the background.
    EXPECT_NE(*image::load(error), image::Image(160, 120, settings.frame.background));
}

// A display that is taken away for a while, and that counts.
class FlakyDisplay final : public port::Display {
public:
    FlakyDisplay() {
        info_.width = 160;
        info_.height = 120;
    }
    const port::DisplayInfo& info() const override { return info_; }
    bool ready() const override { return true; }
    Result<void> present(const image::Image&, std::span<const image::Rect>) override {
        EXPECT_FALSE(lost_) << "nothing is drawn while the console is away";
        ++frames;
        return {};
    }
    bool paced() const override { return false; }
    int event_fd() const override { return -1; }
    Result<void> dispatch() override { return {}; }
    bool lost() const override { return lost_; }
    void lose(bool lost) { lost_ = lost; }
    int frames = 0;

private:
    port::DisplayInfo info_;
    bool lost_ = false;
};

// Takes the display away and gives it back with its events, as a console's session does.
class SwitchingInput final : public port::Input {
public:
    SwitchingInput(TimedInput& timed, FlakyDisplay& display) : timed_(timed), display_(display) {}
    int event_fd() const override { return timed_.event_fd(); }
    Result<void> dispatch(std::vector<port::Event>& events) override {
        const std::size_t before = events.size();
        TRY_VOID(timed_.dispatch(events));
        if (events.size() == before) return {};
        ++count_;
        if (count_ <= 2) display_.lose(count_ == 1);
        frames.push_back(display_.frames);
        return {};
    }
    std::string description() const override { return "switching"; }
    std::vector<int> frames;

private:
    TimedInput& timed_;
    FlakyDisplay& display_;
    int count_ = 0;
};

TEST_F(Session, AConsoleThatComesBackIsDrawnAtOnceEvenIfNothingChanged) {
    FlakyDisplay display;
    TimedInput timed({{200ms, {press(XKB_KEY_0)}}, {200ms, {press(XKB_KEY_0)}}, {300ms, {quit()}}});
    SwitchingInput input(timed, display);
    auto session = ViewSession::create(settings, {display, input, jobs, {}, {}, {}, false});
    ASSERT_TRUE((*session)->run());
    EXPECT_EQ(input.frames, (std::vector<int>{1, 1, 2}))
        << "at leaving, at coming back, at the end";
}

TEST_F(Session, CtrlZSuspendsAndGoesOn) {
    int suspended = 0;
    port::HeadlessDisplay display = make_display();
    port::Event suspend;
    suspend.kind = port::EventKind::suspend;
    TimedInput input({{20ms, {suspend}}, {100ms, {quit()}}});
    auto session = ViewSession::create(settings, {display,
                                                  input,
                                                  jobs,
                                                  [&](std::vector<port::Event>&) -> Result<void> {
                                                      ++suspended;
                                                      return {};
                                                  },
                                                  {},
                                                  {},
                                                  false});
    ASSERT_TRUE((*session)->run());
    EXPECT_EQ(suspended, 1);
}

TEST_F(Session, AFrameBehindASuspensionIsNotThatOfAKeyBeforeIt) {
    settings.json = "";
    settings.no_times = true;
    port::Event left = press(XKB_KEY_Left), suspend;
    left.repeats = false;
    left.time_ns = 1;
    suspend.kind = port::EventKind::suspend;
    port::HeadlessDisplay display = make_display();
    TimedInput input({{20ms, {left, suspend}}, {100ms, {quit()}}});
    const auto no_stop = [](std::vector<port::Event>&) -> Result<void> { return {}; };
    auto session = ViewSession::create(settings, {display, input, jobs, no_stop, {}, {}, false});
    ASSERT_TRUE((*session)->run());
    EXPECT_EQ(display.frames(), 2U);
    EXPECT_TRUE((*session)->report(0).input_to_screen_ms.empty());
}

} // namespace
} // namespace scanout::app
