// Live switches, overlays and inertia in a whole session: what stands on the display.
#include "app/overlay/overlay_text.h"
#include "app/overlay/text_block.h"
#include "app/session_fixture.h"

#include <xkbcommon/xkbcommon-keysyms.h>

namespace scanout::app {
namespace {

class SwitchSession : public Session {
protected:
    // The picture after the actions of a script.
    image::Image after(const std::string& actions) {
        const std::string file = folder.file("frame.png");
        port::HeadlessDisplay display = make_display();
        const Result<void> played = play(actions + "\nframe " + file + "\n", display);
        EXPECT_TRUE(played) << played.error().what;
        return *image::load(file);
    }
};

TEST_F(SwitchSession, AreDrawnAsTheCommandLineWouldAskForThem) {
    const image::Image plain = rendered({});
    const image::Image flat = after("shading_next"), switched = after("aa_previous\nexposure_up\n"
                                                                      "background_next");
    settings.frame.shading = "flat";
    EXPECT_EQ(flat, rendered({}));
    settings.frame.shading = "auto";
    settings.frame.aa = "area";
    settings.frame.samples = 1;
    settings.frame.exposure = 0.5;
    settings.frame.background = {200, 40, 40, 255};
    EXPECT_EQ(switched, rendered({}));
    settings.frame = Settings().frame;
    EXPECT_EQ(after("aa_previous\nexposure_up\nundo\nundo"), plain);
    EXPECT_NE(switched, plain);
}

TEST_F(SwitchSession, WhatCannotRunSaysThePlansReason) {
    width = 1000; // room for the message
    EXPECT_EQ(last_frame({{300ms, {press(XKB_KEY_F6)}}, {300ms, {quit()}}}),
              with_message(rendered({}),
                           "shadow: attached (off: no light that reaches anything casts shadows)"));
    settings.frame.tone = "filmic";
    EXPECT_EQ(last_frame({{300ms, {press(XKB_KEY_F4)}}, {300ms, {quit()}}}),
              with_message(rendered({}), "texture filter: nearest (changes nothing: no texture is "
                                         "read)"));
}

// On the smallest screen and on a large one, page by page.
TEST_F(SwitchSession, TheHelpSheetStandsOnThePictureAsItsPagesSay) {
    for (const auto& [w, h] : {std::pair(320, 200), std::pair(1920, 1080)}) {
        width = w;
        height = h;
        Viewer viewer(settings, width, height, 1);
        viewer.set_pages({100, 1, 1});
        ModelSlot slot;
        slot.put(*load_model(settings.arguments.front(), settings, jobs, {}), settings.frame);
        std::string script = "toggle_help";
        const int pages = w == 320 ? 2 : 1;
        for (int page = 1; page <= pages; ++page, script += "\ntoggle_help") {
            viewer.apply({ActionId::toggle_help, {}, {}, false}, slot.mesh());
            image::Image expected = rendered({});
            draw_overlay(expected, overlay_text(viewer, slot, settings, "", KeyMap::standard()));
            EXPECT_EQ(after(script), expected) << w << " page " << page;
        }
    }
}

TEST_F(SwitchSession, TheWarningsOfTheFileAreReadInFull) {
    settings.arguments = {
        folder.write("bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\nwombat\n")};
    width = 640;
    height = 480;
    const LoadedModel model = *load_model(settings.arguments.front(), settings, jobs, {});
    ASSERT_FALSE(model.warnings.empty());
    Overlay overlay;
    overlay.warnings = {fmt::format("{} warning{} of the file", model.warnings.size(),
                                    model.warnings.size() == 1 ? "" : "s")};
    for (const std::string& warning : model.warnings) {
        std::string_view start = "- ";
        for (const std::string& part :
             broken_into_lines(warning, letters_across(width, height) - 2)) {
            overlay.warnings.push_back(std::string(start) + part);
            start = "  ";
        }
    }
    overlay.warnings.emplace_back("the same key closes");
    image::Image expected = rendered({});
    draw_overlay(expected, overlay);
    EXPECT_EQ(after("toggle_warnings"), expected);
    EXPECT_EQ(after("toggle_warnings\ntoggle_warnings"), rendered({}));
}

// A thrown model moves frame by frame, comes to rest, and then nothing is drawn any more.
TEST_F(SwitchSession, InertiaEndsAndTheProcessorIsIdle) {
    settings.inertia = true;
    settings.no_pointer = true;
    port::Event down, up, motion;
    down.kind = up.kind = port::EventKind::button;
    down.pressed = true;
    motion.kind = port::EventKind::motion;
    motion.x = 30;
    const std::vector<TimedInput::Entry> thrown = {{300ms, {down}},  {20ms, {motion}},
                                                   {20ms, {motion}}, {20ms, {motion}},
                                                   {20ms, {motion}}, {1ms, {up}}};
    const auto frames_in = [&](std::chrono::milliseconds time) {
        std::vector<TimedInput::Entry> entries = thrown;
        entries.push_back({time, {quit()}});
        return run(entries);
    };
    settings.inertia = false;
    EXPECT_LE(frames_in(1000ms), 6U);
    settings.inertia = true;
    EXPECT_GE(frames_in(1000ms), 15U) << "it goes on";
    port::HeadlessDisplay display = make_display();
    std::vector<TimedInput::Entry> entries = thrown;
    entries.push_back({4000ms, {}});
    entries.push_back({2000ms, {quit()}});
    struct Looking final : port::Input {
        Looking(std::vector<TimedInput::Entry> e, port::HeadlessDisplay& d)
            : timed(std::move(e)), display(d) {}
        int event_fd() const override { return timed.event_fd(); }
        Result<void> dispatch(std::vector<port::Event>& events) override {
            seen.push_back(display.frames());
            return timed.dispatch(events);
        }
        std::string description() const override { return "looking"; }
        TimedInput timed;
        port::HeadlessDisplay& display;
        std::vector<std::size_t> seen;
    } input(std::move(entries), display);
    auto session = ViewSession::create(settings, {display, input, jobs, {}, {}, {}, false});
    ASSERT_TRUE((*session)->run());
    ASSERT_GE(input.seen.size(), 2U);
    EXPECT_EQ(input.seen.back(), input.seen[input.seen.size() - 2]) << "two seconds at rest";
}

} // namespace
} // namespace scanout::app
