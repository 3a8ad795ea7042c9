// A motion in the viewer: Space plays it, steps of the virtual clock carry it on.
#include "app/moving/motion_file.h"
#include "app/picture/picture_key.h"
#include "viewer_bench.h"

#include <string>

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

constexpr const char* kAcross =
    "[model.translate]\nkeys = [{ time = 0, value = [0, 0, 0] }, { time = 2, value = [2, 0, 0] }]\n"
    "[light.key.power]\nkeys = [{ time = 0, value = 0 }, { time = 2, value = 1 }]\n"
    "[camera.azimuth]\nkeys = [{ time = 0, value = 0 }, { time = 2, value = 0 }]\n"
    "[camera.elevation]\nkeys = [{ time = 0, value = 0 }]\n";

Settings playing(const std::string& text, std::optional<double> time = {}) {
    Settings settings;
    Warnings warnings;
    settings.motion = *parse_motion(text, "m.toml", {}, settings.frame.lights, warnings);
    settings.time = time;
    return settings;
}

double place(const Bench& bench) {
    return bench.view().translation.x - Bench(playing(kAcross, 0)).view().translation.x;
}

TEST(ViewerMotion, PlaysUntilItsEndAndSpacePausesIt) {
    Bench bench(playing(kAcross));
    EXPECT_TRUE(bench.viewer.turning());
    bench.viewer.advance_to(30);
    EXPECT_NEAR(place(bench), 0.5, 1e-12);
    EXPECT_EQ(bench.viewer.lights(bench.mesh)[0].power, 0.25);
    bench.act(Id::toggle_turntable);
    EXPECT_EQ(bench.viewer.answer(), "motion: rests at 0.50 s");
    EXPECT_FALSE(bench.viewer.turning());
    EXPECT_FALSE(bench.look().turntable) << "Space is the motion's";
    bench.viewer.advance_to(90);
    EXPECT_NEAR(place(bench), 0.5, 1e-12);
    bench.act(Id::toggle_turntable);
    EXPECT_EQ(bench.viewer.answer(), "motion: plays at 0.50 s");
    bench.viewer.advance_to(1000);
    EXPECT_NEAR(place(bench), 2, 1e-12);
    EXPECT_FALSE(bench.viewer.turning()) << "at its end nothing is left to draw";
    bench.act(Id::toggle_turntable);
    EXPECT_NEAR(place(bench), 0, 1e-12) << "from its beginning";
    EXPECT_TRUE(bench.viewer.turning());
}

TEST(ViewerMotion, BeginsAtATimeAndWaits) {
    Bench bench(playing(kAcross, 1.5));
    EXPECT_FALSE(bench.viewer.turning());
    EXPECT_NEAR(place(bench), 1.5, 1e-12);
    bench.act(Id::toggle_turntable);
    bench.viewer.advance_to(15);
    EXPECT_NEAR(place(bench), 1.75, 1e-12);
    bench.viewer.advance_to(600);
    bench.act(Id::toggle_turntable);
    EXPECT_EQ(bench.viewer.motion_time(), 0);
    bench.act(Id::reset);
    EXPECT_EQ(bench.viewer.motion_time(), 1.5);
    EXPECT_FALSE(bench.viewer.turning());
}

TEST(ViewerMotion, ALoopGoesOnForEver) {
    Bench bench(playing("end = \"loop\"\n" + std::string(kAcross)));
    bench.viewer.advance_to(60 * 1'000'001);
    EXPECT_TRUE(bench.viewer.turning());
    EXPECT_NEAR(place(bench), 1, 1e-9);
}

TEST(ViewerMotion, StepsGiveTheSameHoweverTheyAreCut) {
    Bench once(playing(kAcross)), often(playing(kAcross));
    once.viewer.advance_to(77);
    for (int step = 1; step <= 77; ++step)
        often.viewer.advance_to(step);
    EXPECT_EQ(once.look(), often.look());
}

TEST(ViewerMotion, UndoLeavesTheTimeAlone) {
    Bench bench(playing(kAcross));
    bench.viewer.advance_to(10);
    bench.act(Id::rotate_left);
    bench.viewer.advance_to(20);
    bench.act(Id::undo);
    EXPECT_EQ(bench.look().pose.yaw, 0);
    EXPECT_EQ(bench.look().motion_steps, 20);
}

TEST(ViewerMotion, AKeyThatChoosesAViewTakesTheCameraFromIt) {
    const std::string camera = "[camera.azimuth]\nkeys = [{ time = 0, value = 50 }]\n"
                               "[camera.elevation]\nkeys = [{ time = 0, value = 10 }]\n";
    Bench bench(playing(camera, 0)), plain;
    EXPECT_NE(bench.view().world_axes, plain.view().world_axes);
    bench.act(Id::view_front);
    plain.act(Id::view_front);
    EXPECT_EQ(bench.view().world_axes, plain.view().world_axes);
    bench.act(Id::reset);
    EXPECT_NE(bench.view().world_axes, plain.view().world_axes);
}

TEST(ViewerMotion, AMomentIsThePictureWhetherItPlaysOrRests) {
    Bench bench(playing(kAcross));
    bench.viewer.advance_to(30);
    const PictureKey plays = picture_key(bench.look(), 0);
    bench.act(Id::toggle_turntable);
    EXPECT_EQ(picture_key(bench.look(), 0), plays);
    bench.act(Id::toggle_turntable);
    bench.viewer.advance_to(31);
    EXPECT_FALSE(picture_key(bench.look(), 0) == plays);
}

} // namespace
} // namespace scanout::app
