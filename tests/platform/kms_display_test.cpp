#include "fake_card.h"
#include "platform/drm/kms_display.h"
#include "platform/drm/open.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <rapidcheck/gtest.h>

namespace scanout::drm {
namespace {

using std::chrono::milliseconds;

image::Image noise(int width, int height, std::uint32_t seed) {
    image::Image picture(width, height);
    for (image::Rgba8& pixel : picture.pixels()) {
        seed = seed * 1664525 + 1013904223;
        pixel = {static_cast<std::uint8_t>(seed >> 24), static_cast<std::uint8_t>(seed >> 16),
                 static_cast<std::uint8_t>(seed >> 8), 255};
    }
    return picture;
}

struct Rig {
    FakeCard card;
    TestSeat seat;
    std::unique_ptr<KmsDisplay> display;

    Result<void> open(const Timeouts& timeouts = {}) {
        auto opened = open_first(
            {"/dev/dri/card0"},
            [&](const std::string&) -> Result<std::unique_ptr<Device>> {
                return std::make_unique<FakeDevice>(card);
            },
            {}, seat, timeouts);
        if (!opened) return tl::unexpected<Error>(opened.error());
        display = *std::move(opened);
        return {};
    }
    Result<void> present(const image::Image& frame, std::span<const image::Rect> damage) {
        if (auto shown = display->present(frame, damage); !shown) return shown;
        return display->dispatch();
    }
    Result<void> present_whole(std::uint32_t seed) {
        const image::Rect whole{0, 0, 8, 4};
        return present(noise(8, 4, seed), {&whole, 1});
    }
    // Waits for the display's timer or event, then dispatches.
    bool wait() {
        pollfd state{display->event_fd(), POLLIN, 0};
        return ::poll(&state, 1, 2000) == 1 && display->dispatch().has_value();
    }
    image::Image shown() { return card.screen(display->info().format); }
};

RC_GTEST_PROP(KmsDisplay, shows_every_frame_exactly_whatever_the_damage_and_the_pitch, ()) {
    Rig rig;
    rig.card.padding = *rc::gen::inRange<std::uint32_t>(0, 64);
    rig.card.only_16_bits = *rc::gen::arbitrary<bool>();
    RC_ASSERT(rig.open());
    image::Image frame = noise(8, 4, 1);
    const int frames = *rc::gen::inRange(1, 12);
    for (int i = 0; i < frames; ++i) {
        std::vector<image::Rect> damage;
        for (int k = *rc::gen::inRange(0, 3); k > 0; --k) {
            const int x = *rc::gen::inRange(0, 8), y = *rc::gen::inRange(0, 4);
            const image::Rect rect{x, y, *rc::gen::inRange(x, 9), *rc::gen::inRange(y, 5)};
            const image::Image other = noise(8, 4, *rc::gen::arbitrary<std::uint32_t>());
            for (int py = rect.y0; py < rect.y1; ++py)
                for (int px = rect.x0; px < rect.x1; ++px)
                    frame.at(px, py) = other.at(px, py);
            damage.push_back(rect);
        }
        RC_ASSERT(rig.present(frame, damage));
        RC_ASSERT(rig.display->ready());
        RC_ASSERT(rig.shown() == image::as_displayed(rig.display->info().format, frame));
    }
    RC_ASSERT(rig.card.padding_untouched());
    rig.card.check_front();
    RC_ASSERT(rig.card.front_writes == 0);
}

TEST(KmsDisplay, CopiesDamagedPixelsOnlyToEachBufferWhatItHasMissed) {
    Rig rig;
    ASSERT_TRUE(rig.open());
    const image::Image one = noise(8, 4, 1), two = noise(8, 4, 2);
    ASSERT_TRUE(rig.present_whole(1));
    ASSERT_TRUE(rig.present(one, {}));
    EXPECT_EQ(rig.shown(), one) << "this buffer had missed the whole frame";
    // Told that nothing differs, it copies nothing, even though the frame is another one.
    ASSERT_TRUE(rig.present(two, {}));
    EXPECT_EQ(rig.shown(), one);
    const image::Rect pixel{3, 2, 4, 3};
    image::Image expected = one;
    expected.at(3, 2) = two.at(3, 2);
    ASSERT_TRUE(rig.present(two, {&pixel, 1}));
    EXPECT_EQ(rig.shown(), expected);
    ASSERT_TRUE(rig.present(two, {}));
    EXPECT_EQ(rig.shown(), expected) << "the other buffer had missed the pixel";
    EXPECT_EQ(rig.card.front_writes, 0);
}

TEST(KmsDisplay, DamageOfManyFramesIsKeptWithinBoundsAndDrawnWhole) {
    FakeCard card;
    FakeDevice device(card);
    const image::PixelFormat format;
    auto buffer = Buffer::create(device, 8, 4, format);
    ASSERT_TRUE(buffer);
    buffer->draw(noise(8, 4, 1), format);
    for (int i = 0; i < 1000; ++i) {
        const image::Rect rect{i % 8, i % 4, i % 8 + 1, i % 4 + 1};
        buffer->damage({&rect, 1});
    }
    EXPECT_LE(buffer->draw(noise(8, 4, 2), format).size(), 65U);
    card.crtc.framebuffer = buffer->framebuffer();
    for (int i = 0; i < 8; ++i)
        EXPECT_EQ(card.screen(format).at(i, i % 4), noise(8, 4, 2).at(i, i % 4));
}

TEST(KmsDisplay, WaitsForTheFlipBeforeItDrawsAgain) {
    Rig rig;
    ASSERT_TRUE(rig.open());
    rig.card.hold_events = true;
    const image::Image black = rig.shown();
    ASSERT_TRUE(rig.present_whole(1));
    EXPECT_FALSE(rig.display->ready());
    EXPECT_EQ(rig.shown(), black) << "the flip has not happened yet";
    rig.card.refresh();
    ASSERT_TRUE(rig.wait());
    EXPECT_TRUE(rig.display->ready());
    EXPECT_EQ(rig.shown(), noise(8, 4, 1));
    EXPECT_EQ(rig.card.front_writes, 0);
}

TEST(KmsDisplay, TellsWhenAFrameReachedTheScreenByTheKernelsClock) {
    Rig rig;
    ASSERT_TRUE(rig.open({.flip = milliseconds(20)}));
    rig.card.hold_events = true;
    rig.card.refresh_time_ns = 123'456'789;
    ASSERT_TRUE(rig.present_whole(1));
    rig.card.refresh();
    ASSERT_TRUE(rig.wait());
    EXPECT_EQ(rig.display->shown_at_ns(), 123'456'789);
    ASSERT_TRUE(rig.present_whole(2));
    EXPECT_EQ(rig.display->shown_at_ns(), 0) << "not that of the frame before";
    rig.card.refresh();
    ASSERT_TRUE(rig.wait());
    EXPECT_EQ(rig.display->shown_at_ns(), 123'456'789);
    rig.seat.set(false);
    rig.seat.set(true);
    ASSERT_TRUE(rig.present_whole(3));
    EXPECT_EQ(rig.display->shown_at_ns(), 0) << "it was shown by the mode, which tells no time";
}

TEST(KmsDisplayDeathTest, PresentingBeforeTheFlipIsOurOwnMistake) {
    Rig rig;
    ASSERT_TRUE(rig.open());
    rig.card.hold_events = true;
    ASSERT_TRUE(rig.present_whole(1));
    EXPECT_DEATH((void)rig.present_whole(2), "ready");
}

TEST(KmsDisplay, AFlipWithoutAnEventCountsAsDoneAndTheLateEventIsIgnored) {
    Rig rig;
    ASSERT_TRUE(rig.open({.flip = milliseconds(20)}));
    rig.card.hold_events = true;
    ASSERT_TRUE(rig.present_whole(1));
    const FlipEvent late{rig.card.pending_tag, 7, 0};
    ASSERT_TRUE(rig.wait());
    EXPECT_TRUE(rig.display->ready());
    EXPECT_EQ(rig.shown(), noise(8, 4, 1)) << "setting the mode made it certain";
    ASSERT_TRUE(rig.present_whole(2));
    rig.card.events.push_back(late);
    ASSERT_TRUE(rig.display->dispatch());
    EXPECT_FALSE(rig.display->ready()) << "the late event is not the second flip's";
    rig.card.refresh();
    ASSERT_TRUE(rig.display->dispatch());
    EXPECT_TRUE(rig.display->ready());
    EXPECT_EQ(rig.card.front_writes, 0);
}

TEST(KmsDisplay, ABusyCardIsAskedAgain) {
    Rig rig;
    ASSERT_TRUE(rig.open({.busy = milliseconds(2)}));
    rig.card.failing = "flip";
    rig.card.error = EBUSY;
    ASSERT_TRUE(rig.present_whole(1));
    EXPECT_FALSE(rig.display->ready());
    ASSERT_TRUE(rig.wait());
    EXPECT_FALSE(rig.display->ready());
    rig.card.failing = "";
    ASSERT_TRUE(rig.wait());
    ASSERT_TRUE(rig.display->dispatch());
    EXPECT_TRUE(rig.display->ready());
    EXPECT_EQ(rig.shown(), noise(8, 4, 1));
}

TEST(KmsDisplay, IsPacedOnlyWhenTheDriverCountsRefreshes) {
    for (const std::uint32_t step : {0U, 1U}) {
        Rig rig;
        rig.card.sequence_step = step;
        ASSERT_TRUE(rig.open());
        for (std::uint32_t seed : {1U, 2U, 3U})
            ASSERT_TRUE(rig.present_whole(seed));
        EXPECT_EQ(rig.display->paced(), step != 0);
    }
}

TEST(KmsDisplay, AfterASwitchOfTheConsoleSetsTheModeAndShowsTheWholeFrame) {
    Rig rig;
    ASSERT_TRUE(rig.open());
    for (int i = 0; i < 3; ++i)
        ASSERT_TRUE(rig.present(noise(8, 4, 1), {})); // both are up to date
    rig.card.hold_events = true;
    ASSERT_TRUE(rig.present(noise(8, 4, 1), {}));
    rig.seat.set(false);
    EXPECT_TRUE(rig.display->lost());
    EXPECT_FALSE(rig.display->ready());
    rig.card.crtc.framebuffer = 99; // the other console's
    rig.card.pending_framebuffer = 0;
    rig.seat.set(true);
    EXPECT_FALSE(rig.display->lost());
    ASSERT_TRUE(rig.display->ready()) << "the flip of before will never come";
    EXPECT_TRUE(rig.display->stale());
    ASSERT_TRUE(rig.present(noise(8, 4, 5), {}));
    EXPECT_FALSE(rig.display->stale());
    EXPECT_EQ(rig.shown(), noise(8, 4, 5)) << "whole, though nothing was said to differ";
    // The other buffer is behind by everything too.
    rig.card.hold_events = false;
    ASSERT_TRUE(rig.present(noise(8, 4, 6), {}));
    EXPECT_EQ(rig.shown(), noise(8, 4, 6));
}

TEST(KmsDisplay, AwayAndBackBetweenTwoQuestionsIsStale) {
    Rig rig;
    ASSERT_TRUE(rig.open());
    ASSERT_TRUE(rig.present_whole(1));
    EXPECT_FALSE(rig.display->stale());
    rig.seat.set(false);
    rig.seat.set(true);
    EXPECT_FALSE(rig.display->lost());
    EXPECT_TRUE(rig.display->stale());
    ASSERT_TRUE(rig.present(noise(8, 4, 1), {}));
    EXPECT_FALSE(rig.display->stale());
}

TEST(KmsDisplay, ACardTakenAwayBeforeTheSeatSaysSoIsNoError) {
    for (const Errno error : {EACCES, EPERM}) {
        Rig rig;
        ASSERT_TRUE(rig.open());
        rig.card.failing = "flip";
        rig.card.error = error;
        ASSERT_TRUE(rig.present_whole(1));
        EXPECT_TRUE(rig.display->lost());
        rig.seat.set(false);
        rig.card.failing = "";
        rig.seat.set(true);
        EXPECT_FALSE(rig.display->lost());
        ASSERT_TRUE(rig.present(noise(8, 4, 2), {}));
        EXPECT_EQ(rig.shown(), noise(8, 4, 2));
    }
}

TEST(KmsDisplay, ACardTakenForGoodIsTriedAgainAfterAWhile) {
    Rig rig;
    ASSERT_TRUE(rig.open({.lost = milliseconds(10)}));
    rig.card.failing = "flip";
    rig.card.error = EACCES;
    ASSERT_TRUE(rig.present_whole(1));
    ASSERT_TRUE(rig.display->lost());
    rig.card.failing = "";
    ASSERT_TRUE(rig.wait());
    EXPECT_FALSE(rig.display->lost());
    ASSERT_TRUE(rig.present(noise(8, 4, 2), {}));
    EXPECT_EQ(rig.shown(), noise(8, 4, 2));
}

TEST(KmsDisplay, AnUnpluggedConnectorGetsItsModeAgainWhenItIsBack) {
    for (const Errno error : {ENOENT, EINVAL}) {
        Rig rig;
        ASSERT_TRUE(rig.open({.lost = milliseconds(10)}));
        ASSERT_TRUE(rig.present_whole(1));
        rig.card.failing = "flip";
        rig.card.error = error;
        rig.card.counts.clear();
        ASSERT_TRUE(rig.present_whole(2));
        EXPECT_EQ(rig.shown(), noise(8, 4, 2)) << "the mode was set again";
        rig.card.failing = "";
        ASSERT_TRUE(rig.present_whole(3));
        EXPECT_EQ(rig.shown(), noise(8, 4, 3)) << "and flips go on";
        EXPECT_EQ(rig.card.calls.back(), "read_events");
        EXPECT_EQ(rig.card.calls[rig.card.calls.size() - 2], "flip");
    }
}

TEST(KmsDisplay, ADriverWithoutFlipsIsDrawnOnInPlaceAndToldWhatChanged) {
    Rig rig;
    rig.card.failing = "flip";
    rig.card.error = EINVAL;
    ASSERT_TRUE(rig.open());
    for (std::uint32_t seed = 1; seed < 5; ++seed) {
        ASSERT_TRUE(rig.present_whole(seed));
        EXPECT_EQ(rig.shown(), noise(8, 4, seed));
    }
    EXPECT_EQ(rig.card.calls[rig.card.calls.size() - 2], "dirty");
    EXPECT_FALSE(rig.display->paced());
}

TEST(KmsDisplay, PutsBackWhatWasOnTheScreen) {
    Rig rig;
    ASSERT_TRUE(rig.open());
    ASSERT_TRUE(rig.present_whole(1));
    rig.display.reset();
    EXPECT_EQ(rig.card.crtc.framebuffer, 99U);
    EXPECT_TRUE(rig.card.everything_freed());
}

TEST(KmsDisplay, LeavesTheScreenAloneWhenItIsNotItsOwn) {
    Rig rig;
    ASSERT_TRUE(rig.open());
    rig.seat.set(false);
    const auto before = std::count(rig.card.calls.begin(), rig.card.calls.end(), "set_crtc");
    rig.display.reset();
    EXPECT_EQ(std::count(rig.card.calls.begin(), rig.card.calls.end(), "set_crtc"), before);
    EXPECT_TRUE(rig.card.everything_freed());
}

TEST(KmsDisplay, EveryCallThatFailsAtStartIsOneClearLineAndFreesEverything) {
    for (const char* call :
         {"connectors", "take_master", "crtc", "create_dumb", "add_framebuffer", "map", "set_crtc"})
        for (const int after : {0, 1}) {
            Rig rig;
            rig.card.failing = call;
            rig.card.after = after;
            const auto opened = rig.open();
            if (after == 1 && rig.card.counts[call] < 2) continue; // there was no second call
            ASSERT_FALSE(opened) << call << after;
            EXPECT_EQ(opened.error().exit, Exit::no_display);
            EXPECT_NE(opened.error().what.find("/dev/dri/card0: "), std::string::npos);
            EXPECT_NE(opened.error().what.find("Input/output error"), std::string::npos) << call;
            EXPECT_EQ(opened.error().what.find('\n'), std::string::npos);
            EXPECT_TRUE(rig.card.everything_freed()) << call << after;
            EXPECT_EQ(rig.card.crtc.framebuffer, 99U) << "the screen is as before";
        }
}

TEST(KmsDisplay, FallsBackTo16BitsWhereTheDriverHasNo32) {
    Rig rig;
    rig.card.only_16_bits = true;
    ASSERT_TRUE(rig.open());
    EXPECT_EQ(rig.display->info().format.bits_per_pixel, 16);
    ASSERT_TRUE(rig.present_whole(1));
    EXPECT_EQ(rig.shown(), image::as_displayed(rig.display->info().format, noise(8, 4, 1)));
}

} // namespace
} // namespace scanout::drm
