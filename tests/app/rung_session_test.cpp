// , and . step along the frontier of the model on show.
#include "app/frontier/budget.h"
#include "app/frontier/key.h"
#include "app/overlay/text_block.h"
#include "app/session_fixture.h"
#include "scene/content.h"

#include <cstdlib>
#include <filesystem>

#include <xkbcommon/xkbcommon-keysyms.h>

namespace scanout::app {
namespace {

class RungSession : public Session {
protected:
    RungSession() {
        settings.converge = Converge::automatic;
        time_now = [](const frame::FramePlan&) { return 3; }; // known()'s, as asked for
        ::setenv("XDG_CACHE_HOME", folder.file("cache").c_str(), 1);
    }
    ~RungSession() override { ::unsetenv("XDG_CACHE_HOME"); }
    static measure::KnownFrontier known() {
        measure::KnownFrontier f;
        f.date = "2026-11-29";
        f.points = {{{{"aa", "none"}}, 1, 1, 8},
                    {{{"aa", "samples_2"}}, 2, 2, 4},
                    {{}, 3, 3, 2},
                    {{{"aa", "samples_16"}}, 9, 9, 1}};
        return f;
    }
    void remember(const measure::KnownFrontier& frontier) {
        const LoadedModel model = *load_model(settings.arguments.front(), settings, jobs, {});
        frame::FrameOptions options = settings.frame;
        options.width = width;
        options.height = height;
        options.lights = Viewer(settings, width, height, 1).lights(model.scene.mesh);
        const scene::View view = *scene::make_view(model.scene.mesh, settings.model, {},
                                                   fitted(model), {}, width, height);
        const std::string key = frontier_key(scene::content_hash(model.scene), view, options,
                                             free_axes(settings), jobs.threads());
        ASSERT_TRUE(FrontierCache::of_user()->keep(key, frontier));
    }
    image::Image rendered_with(const std::string& aa) {
        const frame::FrameOptions before = settings.frame;
        settings.frame.aa = aa;
        settings.frame.samples = 1;
        const image::Image picture = rendered({});
        settings.frame = before;
        return picture;
    }
};

// The lower left holds no panel.
void expect_same_left(const image::Image& a, const image::Image& b) {
    for (int y = 0; y < a.height() - 40; ++y)
        for (int x = 0; x < a.width() / 2; ++x)
            ASSERT_EQ(a.at(x, y), b.at(x, y)) << x << " " << y;
}

TEST_F(RungSession, KeysStepOnAKnownFrontierAndWhatTheyChoseStays) {
    width = 640;
    height = 300;
    remember(known());
    const port::Event down = press(XKB_KEY_comma), up = press(XKB_KEY_period);
    const auto released = [](port::Event event) {
        event.pressed = false;
        return event;
    };
    expect_same_left(last_frame({{300ms, {down, released(down)}}, {2500ms, {quit()}}}),
                     rendered_with("samples_2"));
    expect_same_left(last_frame({{300ms, {up, released(up)}}, {1000ms, {quit()}}}),
                     rendered_with("samples_16"));
    expect_same_left(last_frame({{300ms, {down, released(down), down, released(down)}},
                                 {500ms, {down, released(down)}},
                                 {1000ms, {quit()}}}),
                     rendered_with("none"));
    EXPECT_NE(rendered_with("none"), rendered_with("samples_2"));
}

// What is touched last wins.
TEST_F(RungSession, ASwitchCountsBeforeTheRungUntilTheNextStep) {
    width = 640;
    height = 300;
    remember(known());
    const port::Event down = press(XKB_KEY_comma), aa = press(XKB_KEY_F3);
    const auto released = [](port::Event event) {
        event.pressed = false;
        return event;
    };
    const std::vector<TimedInput::Entry> switched = {
        {300ms, {down, released(down)}}, {1000ms, {aa, released(aa)}}}; // samples_2, then none
    std::vector<TimedInput::Entry> entries = switched;
    entries.push_back({1000ms, {quit()}});
    expect_same_left(last_frame(entries), rendered_with("none"));
    entries = switched;
    const port::Event up = press(XKB_KEY_period);
    entries.push_back({500ms, {up, released(up), up, released(up)}});
    entries.push_back({1000ms, {quit()}});
    expect_same_left(last_frame(entries), rendered_with("samples_16"));
}

TEST_F(RungSession, AFrontierIsMeasuredWhereNoneIsKnownAndThenRemembered) {
    width = 64;
    height = 48;
    port::Event down = press(XKB_KEY_comma), up = down;
    up.pressed = false;
    const std::string cache = folder.file("cache");
    EXPECT_FALSE(std::filesystem::exists(cache));
    last_frame({{300ms, {down, up}}, {14s, {quit()}}});
    ASSERT_TRUE(std::filesystem::exists(cache));
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(cache))
        files += entry.is_regular_file() ? 1 : 0;
    EXPECT_EQ(files, 1);
}

// What was measured on a machine that was busy, or is another one by now.
TEST_F(RungSession, AKnownFrontierWhoseTimesHoldNoMoreIsMeasuredAnew) {
    width = 640;
    height = 300;
    remember(known());
    time_now = [](const frame::FramePlan&) { return 3 * kTimeHolds * 1.001; };
    port::Event down = press(XKB_KEY_comma), up = down;
    up.pressed = false;
    expect_same_left(last_frame({{300ms, {down, up}}, {500ms, {quit()}}}), rendered({}));
}

TEST_F(RungSession, WhatHasNoReferenceIsRefusedInOneLineAndNotRemembered) {
    settings.converge = Converge::off; // which has no reference either, and says so
    settings.arguments = {folder.write("line.obj", "v 0 0 0\nv 1 1 0\nl 1 2\n")};
    port::Event down = press(XKB_KEY_comma), up = down;
    up.pressed = false;
    for (const bool quiet : {false, true}) {
        settings.quiet = quiet;
        testing::internal::CaptureStderr();
        last_frame({{300ms, {down, up}}, {1000ms, {quit()}}});
        const std::string said = testing::internal::GetCapturedStderr();
        if (quiet)
            EXPECT_EQ(said, "");
        else
            EXPECT_EQ(said, "scanout: no frontier: " + settings.arguments.front() +
                                ": nothing to gain: it has no triangles, and lines and points have "
                                "no reference; name another model\n");
        EXPECT_FALSE(std::filesystem::exists(folder.file("cache")));
    }
}

// The camera looks past the model.
TEST_F(RungSession, APictureOfOneColourHasNoFrontier) {
    width = 64;
    height = 48;
    settings.quiet = false;
    settings.frame.background = {0, 0, 0, 255};
    settings.frame.lights.clear();
    settings.arguments = {folder.write("black.obj", "mtllib m.mtl\nusemtl black\nv 0 0 0\nv 1 0 0\n"
                                                    "v 0 1 0\nf 1 2 3\n")};
    folder.write("m.mtl", "newmtl black\nKd 0 0 0\nKs 0 0 0\n");
    port::Event down = press(XKB_KEY_comma), up = down;
    up.pressed = false;
    testing::internal::CaptureStderr();
    last_frame({{300ms, {down, up}}, {4s, {quit()}}});
    EXPECT_NE(
        testing::internal::GetCapturedStderr().find("every pixel of the picture has one colour"),
        std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder.file("cache")));
}

TEST_F(RungSession, LinesThatTheReferenceLeavesOutAreNamed) {
    settings.converge = Converge::off; // which has no reference either, and says so
    width = 64;
    height = 48;
    settings.quiet = false;
    settings.arguments = {
        folder.write("both.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 2 2 2\nl 1 4\n")};
    port::Event down = press(XKB_KEY_comma), up = down;
    up.pressed = false;
    testing::internal::CaptureStderr();
    last_frame({{300ms, {down, up}}, {500ms, {quit()}}});
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "scanout: warning: " + settings.arguments.front() +
                  ": 1 lines and 0 points have no area: they are not in the reference\n");
}

// Its times and errors are those of the view in which it was measured, and it says so when that is
// another one by now.
TEST_F(RungSession, APanelSaysWhenItBelongsToAnotherView) {
    width = 640;
    height = 300;
    remember(known());
    const auto letters = [&](std::vector<port::Event> then) {
        port::Event down = press(XKB_KEY_comma), up = down;
        up.pressed = false;
        const image::Image picture =
            last_frame({{300ms, {down, up}}, {500ms, then}, {2500ms, {quit()}}});
        int found = 0;
        for (int y = 0; y < height / 2; ++y)
            for (int x = width / 2; x < width; ++x)
                found += picture.at(x, y) == kBlockText ? 1 : 0;
        return found;
    };
    port::Event turn = press(XKB_KEY_Left), turned = turn;
    turned.pressed = false;
    const int before = letters({});
    EXPECT_GT(before, 100);
    EXPECT_GT(letters({turn, turned}), before + 100);
}

TEST_F(RungSession, AReplayTakesNoStepByTheClock) {
    width = 640;
    height = 300;
    remember(known());
    const std::string file = folder.file("a.png");
    port::HeadlessDisplay display = make_display();
    ASSERT_TRUE(play("rung_down\n+10 close\nframe " + file + "\n", display));
    EXPECT_EQ(*image::load(file), rendered({}));
}

} // namespace
} // namespace scanout::app
