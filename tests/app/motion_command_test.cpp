// --motion from outside: moments, frames, names, and what goes together.
#include "program_fixture.h"

#include <string>

#include <gmock/gmock.h>

namespace scanout::app {
namespace {

using testing::HasSubstr;

class MotionCommand : public Program {
protected:
    std::string error_of(const std::string& words, int code = 2) {
        const Outcome outcome = run("render $m --size 64x48 " + words);
        EXPECT_EQ(outcome.code, code) << words;
        return outcome.err;
    }
    std::string around = folder.write(
        "around.toml", "end = \"loop\"\n[model.rotate]\nkeys = [{ time = 0, value = [0, 0, 0] }, "
                       "{ time = 2, value = [0, 360, 0] }]\n");
    std::string walk =
        folder.write("walk.toml", "[model.translate]\nkeys = [{ time = 0, value = [0, 0, 0] }, "
                                  "{ time = 1, value = [0.5, 0, 0] }]\n");
};

// The turntable is a motion: the same bits.
TEST_F(MotionCommand, OnceAroundIsTheTurntable) {
    EXPECT_EQ(hash_of("--motion around.toml --frames 0..15 --fps 8"), hash_of("--turntable 16"));
    EXPECT_NE(hash_of("--motion around.toml --frames 1..2 --fps 8"),
              hash_of("--motion around.toml --frames 0..1 --fps 8"));
}

TEST_F(MotionCommand, AFrameIsItsMomentWhicheverFramesAreDrawn) {
    const std::string all = hash_of("--motion walk.toml --frames 0..4 --fps 4");
    EXPECT_EQ(all.substr(3 * 17), hash_of("--motion walk.toml --frames 3..4 --fps 4"));
    EXPECT_EQ(all.substr(0, 17), hash_of("--motion walk.toml"));
    EXPECT_EQ(all.substr(2 * 17, 17), hash_of("--motion walk.toml --time 0.5"));
    EXPECT_EQ(all.substr(4 * 17), hash_of("--motion walk.toml --time 1000")) << "it stays there";
    EXPECT_EQ(all.substr(17, 17), hash_of("--motion walk.toml --frames 1..2 --fps 4 --shard 1/2"));
    EXPECT_NE(all.substr(0, 17), all.substr(17, 17));
}

TEST_F(MotionCommand, ALightAndACameraMove) {
    folder.write("light.toml", "[light.key.power]\nkeys = [{ time = 0, value = 0.8 }, "
                               "{ time = 1, value = 0.2 }]\n");
    EXPECT_EQ(hash_of("--motion light.toml"), hash_of(""));
    EXPECT_NE(hash_of("--motion light.toml --time 1"), hash_of(""));
    folder.write("lamp.toml", "[light.lamp.at]\nkeys = [{ time = 0, value = [0, 0, 3] }, "
                              "{ time = 1, value = [3, 0, 0] }]\n");
    EXPECT_EQ(hash_of("--motion lamp.toml --time 1 --light point:0,0,0:name=lamp"),
              hash_of("--light point:3,0,0:name=lamp"));
    folder.write("eye.toml", "[camera.eye]\nkeys = [{ time = 0, value = [2, 3, 4] }]\n");
    EXPECT_EQ(hash_of("--motion eye.toml --look-at 0,0,0 --eye 9,9,9"),
              hash_of("--look-at 0,0,0 --eye 2,3,4"));
}

TEST_F(MotionCommand, FilesAreNamedByTheirFrames) {
    EXPECT_EQ(
        run("render $m -s 8x8 --motion walk.toml --frames 8..11 --fps 8 -o f-{frame}-{n}.ppm").code,
        0);
    for (const char* const name : {"f-08-0.ppm", "f-09-1.ppm", "f-10-2.ppm", "f-11-3.ppm"})
        EXPECT_NE(folder.read(name), "") << name;
    EXPECT_THAT(error_of("--motion walk.toml --frames 0..3 -o f.png"),
                HasSubstr("4 pictures want {frame} in the name, as in turn-{frame}.png"));
}

TEST_F(MotionCommand, WhatHoldsManyPicturesHoldsAllOfAMotion) {
    const auto frames = [&](const std::string& words) {
        const Outcome outcome = run("render $m -s 8x8 --hash " + words);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.lines().size();
    };
    EXPECT_EQ(frames("--motion walk.toml --fps 4 -o a.y4m"), 5U) << "its end, too";
    EXPECT_EQ(frames("--motion around.toml --fps 4 -o a.apng"), 8U) << "the end is the beginning";
    EXPECT_EQ(frames("--motion around.toml --fps 4 -o a-{frame}.png"), 8U);
    EXPECT_EQ(frames("--motion around.toml --fps 1 -o a.png --sheet 2x1"), 2U);
    EXPECT_EQ(frames("--motion around.toml --fps 4 -o a.png"), 1U);
    EXPECT_EQ(frames("--motion around.toml --fps 4 -o a.apng --time 1"), 1U);
    EXPECT_EQ(frames("--frames 3"), 1U) << "times, as ever";
}

TEST_F(MotionCommand, WhatDoesNotGoTogetherIsSaid) {
    EXPECT_THAT(error_of("--hash --time 1"), HasSubstr("--time is of a motion: say --motion FILE"));
    EXPECT_THAT(error_of("--hash --frames 0..1"), HasSubstr("--frames A..B is of a motion"));
    EXPECT_THAT(error_of("--hash --motion walk.toml --frames 0..1 --time 1"),
                HasSubstr("give one of them"));
    EXPECT_THAT(error_of("--hash --motion walk.toml --turntable 4"), HasSubstr("give one of them"));
    EXPECT_THAT(error_of("--hash --motion walk.toml --frames 2..1"),
                HasSubstr("first and the last"));
    EXPECT_THAT(error_of("--hash --motion walk.toml --frames 0.."), HasSubstr("as in 0..47"));
    EXPECT_THAT(error_of("--hash --motion walk.toml --frames 0..100000"),
                HasSubstr("there may be 100000"));
    EXPECT_THAT(error_of("--hash --motion walk.toml --time -1"), HasSubstr("must be 0 to"));
    EXPECT_THAT(error_of("--hash --motion none.toml", 3), HasSubstr("none.toml"));
    folder.write("bad.toml", "[model.rotate]\nkeys = 4\n");
    EXPECT_THAT(error_of("--hash --motion bad.toml", 3), HasSubstr("bad.toml:2: model.rotate"));
    folder.write("long.toml", "[camera.azimuth]\nkeys = [{ time = 1e6, value = 1 }]\n");
    EXPECT_THAT(error_of("-o a.apng --motion long.toml"), HasSubstr("say which by --frames A..B"));
}

} // namespace
} // namespace scanout::app
