// Pictures that must not change: tests/golden/*.png, 64x64, compared exactly. With
// SCANOUT_UPDATE_GOLDEN=1 in the environment the files are written anew (look at them before you
// keep them); a picture that differs is left with the difference beside the test's program.
#include "base/write_file.h"
#include "image/codec.h"
#include "image/compare.h"
#include "image/hash.h"
#include "io/load.h"
#include "support/axes.h"
#include "support/scenes.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

namespace scanout::test {
namespace {

bool updating() {
    const char* value = std::getenv("SCANOUT_UPDATE_GOLDEN");
    return value != nullptr && std::string(value) == "1";
}

std::string golden_path(const std::string& name) {
    return std::string(SCANOUT_SOURCE_DIR) + "/tests/golden/" + name + ".png";
}

void write_png(const std::string& path, const image::Image& picture) {
    const auto bytes = image::encode_png(picture);
    ASSERT_TRUE(bytes) << bytes.error().what;
    const auto written = write_file(path, *bytes);
    ASSERT_TRUE(written) << written.error().what;
}

void expect_golden(const std::string& name, const image::Image& got) {
    const std::string path = golden_path(name);
    if (updating()) write_png(path, got);
    const auto expected = image::load(path);
    ASSERT_TRUE(expected) << expected.error().what;
    const image::Difference difference = image::compare(got, *expected);
    if (difference.same_size && difference.differing_pixels == 0) return;
    const std::filesystem::path folder =
        std::filesystem::path(SCANOUT_BINARY).parent_path() / "golden";
    std::filesystem::create_directories(folder);
    write_png(folder / (name + "-got.png"), got);
    write_png(folder / (name + "-expected.png"), *expected);
    write_png(folder / (name + "-difference.png"), image::difference_image(got, *expected));
    ADD_FAILURE() << name << ": " << difference.differing_pixels << " pixels differ, by up to "
                  << difference.max_difference << "; see " << folder / (name + "-difference.png");
}

class Golden : public testing::TestWithParam<Shot> {};
TEST_P(Golden, IsDrawnToTheBit) {
    expect_golden(GetParam().name, draw(GetParam(), {.threads = 2}));
}
INSTANTIATE_TEST_SUITE_P(All, Golden, testing::ValuesIn(golden_shots()),
                         [](const auto& tested) { return tested.param.name; });

TEST(GoldenImages, ShowEveryTechniqueOfTheTable) {
    std::map<std::string, image::Image> pictures;
    for (const Shot& s : golden_shots())
        ASSERT_TRUE(pictures.emplace(s.name, draw(s)).second) << s.name << " twice";
    for (const auto& [axis, names] : axes()) {
        std::string neighbour;
        // Dither is a code at most. Rungs of ambient occlusion are much the same but for thin
        // things.
        const int tolerance = axis == "dither" || axis == "ambient_occlusion" ? 0 : 2;
        for (const std::string& name : names) {
            const std::string golden = axis + "_" + name;
            ASSERT_EQ(pictures.count(golden), 1U) << "no golden image shows " << golden;
            // One that looks like its neighbour would not show that the wrong one ran.
            // Two promise to look like another, below.
            if (!neighbour.empty() && golden != "depth_float_32" &&
                (neighbour != "interpolate_adaptive" || golden != "interpolate_perspective")) {
                EXPECT_GT(
                    image::compare(pictures[neighbour], pictures[golden], tolerance).over_tolerance,
                    40)
                    << neighbour << " and " << golden;
            }
            neighbour = golden;
        }
    }
    const image::Image& exact = pictures["interpolate_perspective"];
    EXPECT_GT(image::compare(exact, pictures["interpolate_affine_8"], 2).over_tolerance, 40);
    EXPECT_EQ(image::compare(exact, pictures["interpolate_adaptive"], 1).over_tolerance, 0);
    // 1 - z in a float is as coarse as 24 bits wherever z is below a half; ties fall otherwise.
    EXPECT_LT(
        image::compare(pictures["depth_fixed_24"], pictures["depth_float_32"], 2).over_tolerance,
        8);
    EXPECT_GT(image::compare(pictures["perspective"], pictures["orthographic"], 2).over_tolerance,
              100);
    EXPECT_GT(image::compare(pictures["perspective"], pictures["samples_8"], 2).over_tolerance,
              100);
}

TEST(GoldenImages, SpotFromItsFile) {
    const std::string path = std::string(SCANOUT_SOURCE_DIR) + "/models/spot/spot.obj";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    Warnings warnings;
    const auto loaded = io::load(path, {}, warnings);
    ASSERT_TRUE(loaded) << loaded.error().what;
    Shot s = shot("spot");
    s.scene = *loaded;
    s.camera.azimuth_degrees = 210;
    s.camera.elevation_degrees = 20;
    s.options.samples = 4;
    expect_golden("spot", draw(s, {.threads = 2}));
}

} // namespace
} // namespace scanout::test
