// --animation from outside, on a model that is shipped.
#include "program_fixture.h"

#include <string>

#include <gmock/gmock.h>

namespace scanout::app {
namespace {

using testing::HasSubstr;

class AnimationCommand : public Program {
protected:
    void SetUp() override { model = SCANOUT_SOURCE_DIR "/models/worm/worm.glb"; }
};

TEST_F(AnimationCommand, AFrameIsItsMomentAndRoundsAreAlike) {
    const std::string all = hash_of("--animation wave --frames 0..5 --fps 4");
    EXPECT_EQ(all.substr(3 * 17), hash_of("--animation 0 --frames 3..5 --fps 4"));
    EXPECT_EQ(all.substr(17, 17), hash_of("--animation wave --time 0.25"));
    EXPECT_EQ(all.substr(17, 17), hash_of("--animation wave --time 2.25"));
    EXPECT_NE(all.substr(0, 17), all.substr(17, 17));
    EXPECT_NE(hash_of("--animation swallow --time 0.75"), hash_of("--animation swallow"));
}

TEST_F(AnimationCommand, GoesWithAMotion) {
    folder.write("m.toml", "[model.rotate]\nkeys = [{ time = 0, value = [0, 0, 0] }, "
                           "{ time = 1, value = [0, 90, 0] }]\n");
    EXPECT_NE(hash_of("--animation wave --time 0.5 --motion m.toml"),
              hash_of("--animation wave --time 0.5"));
}

TEST_F(AnimationCommand, WhatIsNotThereIsSaid) {
    const Outcome none = run("render $m --hash --animation run");
    EXPECT_EQ(none.code, 2);
    EXPECT_THAT(none.err,
                HasSubstr("there is no animation 'run'; there are: 0 'wave', 1 'swallow'"));
    const Outcome piped = run("render - --hash --animation wave --frames 0..1 < " + model);
    EXPECT_EQ(piped.code, 2);
    EXPECT_THAT(piped.err, HasSubstr("- is read once"));
    model = folder.write("model.obj", kTetrahedron);
    const Outcome still = run("render $m --hash --animation wave");
    EXPECT_EQ(still.code, 2);
    EXPECT_THAT(still.err, HasSubstr("model.obj: has no animations: leave --animation out"));
}

} // namespace
} // namespace scanout::app
