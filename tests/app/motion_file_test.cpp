// Motions as people write them, and their mistakes.
#include "app/moving/motion_file.h"
#include "math/quaternion.h"
#include "math/srgb.h"
#include "support/temporary_folder.h"

#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::app {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Result<scene::Motion> parsed(const std::string& text, Warnings& warnings) {
    return parse_motion(text, "m.toml", {}, scene::default_lights(), warnings);
}
scene::Motion good(const std::string& text) {
    Warnings warnings;
    Result<scene::Motion> motion = parsed(text, warnings);
    EXPECT_TRUE(motion) << motion.error().what;
    EXPECT_TRUE(warnings.empty());
    return motion ? *std::move(motion) : scene::Motion();
}

struct Moved {
    scene::ModelTransform model;
    scene::CameraOptions camera;
    std::vector<scene::Light> lights = scene::default_lights();
};
Moved moved(const scene::Motion& motion, double seconds) {
    Moved now;
    motion.move(seconds, now.model, now.camera);
    motion.move_lights(seconds, now.lights);
    return now;
}

TEST(MotionFile, SaysWhatMovesAndHow) {
    const scene::Motion motion = good(R"(
[model.translate]
keys = [{ time = 0, value = [0, 0, 0] }, { time = 2, value = [4, 0, 2] }]
[model.scale]
ease = "in"
keys = [{ time = 0, value = 1 }, { time = 2, value = [3, 1, 1] }]
[camera]
fov = { by = "step", keys = [{ time = 0, value = 30 }, { time = 1, value = 60 }] }
azimuth.keys = [{ time = 1, value = 10 }]
[light.fill.colour]
keys = [{ time = 0, value = "#ff8000" }]
[light.key.power]
keys = [{ time = 0, value = 0, ease = "out" }, { time = 2, value = 1 }]
)");
    EXPECT_EQ(motion.duration, 2);
    EXPECT_FALSE(motion.loops);
    const Moved now = moved(motion, 1);
    EXPECT_EQ(now.model.moved, DVec3(2, 0, 1));
    EXPECT_EQ(now.model.scale, DVec3(1.5, 1, 1));
    EXPECT_EQ(now.camera.fov_degrees, 60);
    EXPECT_EQ(now.camera.azimuth_degrees, 10);
    EXPECT_EQ(now.lights[0].power, 0.75);
    EXPECT_EQ(now.lights[1].colour, Vec3(1, srgb_decode(128), 0));
    EXPECT_EQ(moved(motion, 9).model.moved, DVec3(4, 0, 2)) << "it stays at its end";
}

TEST(MotionFile, ALoopBeginsAgainAfterTheDurationOrTheLastKey) {
    const std::string tracks = R"(
[camera.azimuth]
keys = [{ time = 0, value = 0 }, { time = 2, value = 20 }]
[camera.elevation]
end = "loop"
keys = [{ time = 0, value = 0 }, { time = 0.5, value = 10 }]
)";
    const scene::Motion one = good("end = \"loop\"\n" + tracks);
    EXPECT_EQ(one.duration, 2);
    EXPECT_EQ(moved(one, 3).camera.azimuth_degrees, 10);
    EXPECT_EQ(moved(one, 1.25).camera.elevation_degrees, 5) << "a loop of its own";
    const scene::Motion longer = good("end = \"loop\"\nduration = 4\n" + tracks);
    EXPECT_EQ(moved(longer, 3).camera.azimuth_degrees, 20);
    EXPECT_EQ(moved(longer, 5).camera.azimuth_degrees, 10);
}

TEST(MotionFile, ASplineOfALoopClosesSmoothly) {
    const scene::Motion motion = good(R"(
end = "loop"
[camera.azimuth]
by = "spline"
keys = [{ time = 0, value = 0 }, { time = 1, value = 5 }, { time = 2, value = 0 }]
)");
    // Flat at the key that lies between two alike.
    EXPECT_NEAR(moved(motion, 1.999).camera.azimuth_degrees, 0, 1e-4);
    EXPECT_NEAR(moved(motion, 2.001).camera.azimuth_degrees, 0, 1e-4);
}

TEST(MotionFile, DegreesTurnTheShortWayWhereTheyAreAskedTo) {
    const std::string keys =
        "keys = [{ time = 0, value = [0, 0, 0] }, { time = 1, value = [0, 270, 0] }]";
    const DMat3 straight = *moved(good("[model.rotate]\n" + keys), 0.5).model.turn;
    const DMat3 shortest = *moved(good("[model.rotate]\nby = \"slerp\"\n" + keys), 0.5).model.turn;
    EXPECT_NEAR(straight[0][2], -matrix_of(quaternion_of_degrees({0, -135, 0}))[0][2], 1e-15);
    EXPECT_NEAR(shortest[0][2], matrix_of(quaternion_of_degrees({0, -45, 0}))[0][2], 1e-15);
}

TEST(MotionFile, TangentsAreTheKeysOwn) {
    const scene::Motion motion = good(R"(
[camera.azimuth]
by = "hermite"
keys = [{ time = 0, value = 0, out = 8 }, { time = 2, value = 0, in = -8 }]
)");
    EXPECT_EQ(moved(motion, 1).camera.azimuth_degrees, 4);
}

TEST(MotionFile, AQuaternionOfLengthZeroTurnsNothingWithAWarning) {
    Warnings warnings;
    const auto motion =
        parsed("[model.turn]\nkeys = [{ time = 0, value = [0, 0, 0, 0] }]", warnings);
    ASSERT_TRUE(motion);
    EXPECT_EQ(*moved(*motion, 0).model.turn, DMat3(1));
    ASSERT_EQ(warnings.lines().size(), 1U);
    EXPECT_EQ(warnings.lines()[0], "m.toml:2: model.turn: a quaternion of length 0 turns nothing");
}

TEST(MotionFile, AMistakeIsOneLineWithItsPlaceAndWhatToDo) {
    const std::string key = "keys = [{ time = 0, value = [0, 0, 0] }]\n";
    const std::vector<std::pair<std::string, std::string>> mistakes = {
        {"", "m.toml: nothing moves: write a table such as [model.rotate]"},
        {"[model.rotate\n", "m.toml:1: "},
        {"\n[model.rotate]\nkeys = [}\n", "m.toml:3: "},
        {"[modle.rotate]\n" + key,
         "m.toml:1: there is no 'modle'; did you mean 'model'?; a motion"},
        {"\n[model.rotat]\n" + key,
         "m.toml:2: there is no 'rotat'; did you mean 'rotate'?; model has translate rotate"},
        {"[light.kye.power]\n" + key,
         "m.toml:1: there is no light 'kye'; did you mean 'key'?; there are: key fill hemisphere"},
        {"[light.hemisphere.size]\n" + key, "m.toml:1: there is no 'size'"},
        {"[light.key]\ncone = { keys = [] }\n", "m.toml:2: there is no 'cone'; key (a light of "
                                                "kind directional) has at colour power size"},
        {"[model]\nrotate = 5\n", "m.toml:2: model.rotate must be a table"},
        {"[model.rotate]\nby = \"linear\"\n", "m.toml:1: model.rotate has no keys: write keys = ["},
        {"[model.rotate]\nkeys = []\n", "m.toml:2: model.rotate has no keys"},
        {"[model.rotate]\nkeys = [3]\n", "m.toml:2: a key must be a table"},
        {"[model.rotate]\nby = \"lienar\"\n" + key,
         "m.toml:2: by wants one of step linear slerp spline hermite, in quotes; not 'lienar'; did "
         "you mean 'linear'?"},
        {"[model.rotate]\nby = linear\n" + key, "m.toml:2: "},
        {"[model.translate]\nby = \"slerp\"\n" + key, "m.toml:2: slerp is of rotations"},
        {"[model.rotate]\nease = \"inn\"\n" + key,
         "m.toml:2: ease wants one of none in out in-out"},
        {"[model.rotate]\nby = \"step\"\nease = \"in\"\n" + key,
         "m.toml:1: model.rotate: by = \"step\" says how it moves already: leave ease out"},
        {"end = \"loops\"\n[model.rotate]\n" + key, "m.toml:1: end wants one of hold loop"},
        {"duration = 0\n[model.rotate]\n" + key, "m.toml:1: duration is 0 s: it must be above 0"},
        {"duration = \"2\"\n[model.rotate]\n" + key, "m.toml:1: duration wants a number"},
        {"[model.rotate]\nkeys = [{ time = 0 }]\n",
         "m.toml:2: model.rotate: a key wants a time and a value, as in { time = 0, value = [0, "
         "90"},
        {"[model.rotate]\nkeys = [\n{ time = 2, value = [0, 0, 0] },\n{ time = 1, value = [0, 0, "
         "0] "
         "}]\n",
         "m.toml:4: model.rotate: time is 1 s, after a key at 2 s: put the keys in order of time"},
        {"[model.rotate]\nkeys = [{ time = -1, value = [0, 0, 0] }]\n",
         "m.toml:2: model.rotate: time is -1 s: it must be 0 to"},
        {"[model.rotate]\nkeys = [{ time = inf, value = [0, 0, 0] }]\n",
         "m.toml:2: time wants a number"},
        {"[model.rotate]\nkeys = [{ time = 0, value = [0, 0] }]\n",
         "m.toml:2: model.rotate wants 3 numbers, as in value = [0, 90, 0]"},
        {"[model.rotate]\nkeys = [{ time = 0, value = 5 }]\n", "m.toml:2: model.rotate wants 3"},
        {"[camera.fov]\nkeys = [{ time = 0, value = [45] }]\n",
         "m.toml:2: camera.fov wants 1 number, as in value = 45"},
        {"[camera.fov]\nkeys = [{ time = 0, value = 180 }]\n",
         "m.toml:2: camera.fov is 180: it must be 0.1 to 175"},
        {"[model.rotate]\nkeys = [{ time = 0, value = [0, \"0\", 0] }]\n",
         "m.toml:2: model.rotate wants a number"},
        {"[model.rotate]\nkeys = [{ time = 0, value = [0, 0, 0], eas = \"in\" }]\n",
         "m.toml:2: there is no 'eas'; did you mean 'ease'?; a key has"},
        {"[model.rotate]\nkeys = [{ time = 0, value = [0, 0, 0], in = [0, 0, 0] }]\n",
         "m.toml:2: model.rotate: in and out are tangents of by = \"hermite\", not of \"linear\""},
        {"[light.key.colour]\nkeys = [{ time = 0, value = \"#12345\" }]\n",
         "m.toml:2: key.colour wants #rrggbb or a name, not '#12345'"},
        {"[model.rotate]\n" + key + "[model.turn]\nkeys = [{ time = 0, value = [0, 0, 0, 1] }]\n",
         "m.toml:3: model.rotate and model.turn both turn it: leave one out"},
        {"[camera.eye]\n" + key, "m.toml:1: camera.eye wants camera.look-at as well"},
        {"[camera.look-at]\n" + key, "m.toml:1: camera.look-at wants camera.eye as well"},
    };
    for (const auto& [text, line] : mistakes) {
        Warnings warnings;
        const auto motion = parsed(text, warnings);
        ASSERT_FALSE(motion) << text;
        EXPECT_THAT(motion.error().what, StartsWith(line)) << text;
        EXPECT_EQ(motion.error().what.find('\n'), std::string::npos) << motion.error().what;
        EXPECT_EQ(motion.error().exit, Exit::unreadable);
    }
}

TEST(MotionFile, IsThatOfTheOption) {
    const test::TemporaryFolder folder;
    Settings settings;
    EXPECT_TRUE(read_motion(settings)) << "there is none";
    EXPECT_FALSE(settings.motion);
    settings.motion_file = folder.file("none.toml");
    const auto missing = read_motion(settings);
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().what, HasSubstr("none.toml"));
    settings.motion_file =
        folder.write("m.toml", "camera.azimuth.keys = [{ time = 3, value = 1 }]\n");
    EXPECT_TRUE(read_motion(settings));
    EXPECT_EQ(settings.motion->duration, 3);
}

} // namespace
} // namespace scanout::app
