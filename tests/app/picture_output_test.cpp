// Pictures of a run in one file: animations, sheets, pairs; and runs that share the pictures.
#include "app/program_fixture.h"
#include "image/codec.h"

#include <nlohmann/json.hpp>

#include <gmock/gmock.h>

namespace scanout::app {
namespace {

using ::testing::HasSubstr;

constexpr const char* kTwoFaces = "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 6 1 1\nf 1 2 3\nf 2 4 3\n";

struct Pictures : Program {
    image::Image picture(const std::string& name) {
        auto loaded = image::load(folder.file(name));
        EXPECT_TRUE(loaded) << name;
        return loaded ? *std::move(loaded) : image::Image();
    }
    // `part` of `whole` from (left, top) on.
    static bool has_at(const image::Image& whole, const image::Image& part, int left, int top) {
        for (int y = 0; y < part.height(); ++y)
            for (int x = 0; x < part.width(); ++x)
                if (whole.at(left + x, top + y) != part.at(x, y)) return false;
        return true;
    }
};

TEST_F(Pictures, OfATurntableAreOneAnimatedPng) {
    ASSERT_EQ(run("render $m -s 40x30 --turntable 3 -o turn.apng --fps 12").code, 0);
    ASSERT_EQ(run("render $m -s 40x30 --turntable 3 --format apng -o turn.png --fps 12").code, 0);
    EXPECT_EQ(folder.read("turn.apng"), folder.read("turn.png"));
    ASSERT_EQ(run("render $m -s 40x30 --turntable 3 -o 'still-{n}.png'").code, 0);
    EXPECT_EQ(picture("turn.png"), picture("still-0.png"));
    const std::string file = folder.read("turn.apng");
    EXPECT_THAT(file, HasSubstr(std::string("acTL\0\0\0\3", 8)));
    EXPECT_EQ(refused("render $m --turntable 3 -o turn-x.png"), 2);
}

TEST_F(Pictures, OfATurntableAreAVideoStream) {
    ASSERT_EQ(run("render $m -s 40x30 --turntable 3 -o turn.y4m --fps 12").code, 0);
    const std::string file = folder.read("turn.y4m");
    EXPECT_TRUE(file.starts_with("YUV4MPEG2 W40 H30 F12:1 ")) << file.substr(0, 40);
    const std::size_t header = file.find('\n') + 1;
    EXPECT_EQ(file.size(), header + 3 * (6 + 3 * 40 * 30));
    EXPECT_EQ(run("render $m -s 40x30 --turntable 3 -o - --format y4m --fps 12").out, file);
}

TEST_F(Pictures, OfSeveralModelsAreASheet) {
    folder.write("two.obj", kTwoFaces);
    ASSERT_EQ(run("render $m two.obj -s 40x30 --turntable 2 --sheet 3x2 -o sheet.png").code, 0);
    ASSERT_EQ(run("render $m two.obj -s 40x30 --turntable 2 -o '{name}-{n}.png'").code, 0);
    const image::Image sheet = picture("sheet.png");
    EXPECT_EQ(sheet.width(), 8 + 3 * 48);
    EXPECT_EQ(sheet.height(), 8 + 2 * (30 + 21 + 8));
    EXPECT_TRUE(has_at(sheet, picture("model-0.png"), 8, 8));
    EXPECT_TRUE(has_at(sheet, picture("model-1.png"), 56, 8));
    EXPECT_TRUE(has_at(sheet, picture("two-0.png"), 104, 8));
    EXPECT_TRUE(has_at(sheet, picture("two-1.png"), 8, 67));
    const image::Image paper(40, 30, {255, 255, 255, 255});
    EXPECT_TRUE(has_at(sheet, paper, 56, 67)) << "no fifth picture";
    EXPECT_FALSE(has_at(sheet, image::Image(40, 21, {255, 255, 255, 255}), 8, 38)) << "its name";

    EXPECT_EQ(refused("render $m two.obj --turntable 2 --sheet 3x1 -o sheet.png"), 2);
    EXPECT_EQ(refused("render $m --sheet 3x1 -o '{name}.png'"), 2);
    EXPECT_EQ(refused("render $m --sheet 900x900 -o sheet.png"), 2);
    EXPECT_EQ(refused("render $m --sheet 3 -o sheet.png"), 2);
    EXPECT_EQ(refused("render $m two.obj -s 40x30 --sheet 2x1 -o two.obj --format png"), 2)
        << "an input";
}

TEST_F(Pictures, OfASheetWhereAModelCannotBeReadAreThoseOfTheOthers) {
    const Outcome drawn = run("render none.obj $m -s 40x30 --sheet 2x1 -o sheet.png");
    EXPECT_EQ(drawn.code, 3);
    ASSERT_EQ(run("render $m -s 40x30 -o model.png").code, 0);
    EXPECT_TRUE(has_at(picture("sheet.png"), picture("model.png"), 8, 8));
}

// The same model, moved in its file, is seen moved; without --pair both would look the same.
TEST_F(Pictures, OfAPairHaveOneCamera) {
    folder.write("moved.obj",
                 "v 2 0 0\nv 3 0 0\nv 2 1 0\nv 2 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const std::string front = " --view front --projection orthographic -s 120x40 ";
    ASSERT_EQ(run("render --pair $m moved.obj -o pair.png" + front).code, 0);
    ASSERT_EQ(run("render --pair $m moved.obj -o 'pair-{name}.png'" + front).code, 0);
    const image::Image both = picture("pair.png"), first = picture("pair-model.png"),
                       second = picture("pair-moved.png");
    EXPECT_TRUE(has_at(both, first, 8, 8));
    EXPECT_TRUE(has_at(both, second, 136, 8));
    const auto columns = [](const image::Image& image) { // first and last that show the model
        std::pair<int, int> seen(image.width(), -1);
        for (int x = 0; x < image.width(); ++x)
            for (int y = 0; y < image.height(); ++y)
                if (image.at(x, y) != image.at(0, 0))
                    seen = {std::min(seen.first, x), std::max(seen.second, x)};
        return seen;
    };
    // 3 units wide together, 1 high: 36 of 40 rows are the unit, 2 units are 72 columns.
    EXPECT_NEAR(columns(second).first - columns(first).first, 72, 1);
    EXPECT_NEAR(columns(second).second - columns(first).second, 72, 1);
    EXPECT_GT(columns(first).first, 4);
    EXPECT_LT(columns(second).second, 115);

    EXPECT_EQ(refused("render --pair $m -o pair.png"), 2);
    EXPECT_EQ(refused("render --pair $m moved.obj -o pair.png --rotate 0,20,0"), 2);
    EXPECT_EQ(refused("render --pair $m moved.obj -o pair.png --max-error 2"), 2);
    EXPECT_EQ(refused("render --pair $m none.obj -o pair.png"), 3);
}

TEST_F(Pictures, OfShardsTogetherAreThoseOfOneRun) {
    folder.write("two.obj", kTwoFaces);
    const std::string all = "render $m two.obj -s 40x30 --turntable 5 --hash";
    const std::vector<std::string> whole = run(all).lines();
    ASSERT_EQ(whole.size(), 10U);
    std::vector<std::string> parts(10);
    for (std::size_t i = 0; i < 4; ++i) {
        const auto lines = run(all + " --shard " + std::to_string(i + 1) + "/4").lines();
        ASSERT_EQ(lines.size(), i < 2 ? 3U : 2U);
        for (std::size_t k = 0; k < lines.size(); ++k)
            parts[i + 4 * k] = lines[k];
    }
    EXPECT_EQ(parts, whole);
    // Names are those of the whole run; a model without a picture in the shard is not read.
    ASSERT_EQ(run("render $m none.obj -s 40x30 -o '{name}-{n}.ppm' --turntable 2 --shard 2/4").code,
              0);
    EXPECT_EQ(folder.read("model-0.ppm"), "");
    EXPECT_NE(folder.read("model-1.ppm"), "");
    const Outcome nothing = run("render $m --json --quiet --shard 3/4");
    EXPECT_EQ(nothing.code, 0);
    EXPECT_EQ(nlohmann::json::parse(nothing.out), nlohmann::json::array());

    for (const char* wrong : {"0/2", "3/2", "2", "1/2/3", "a/b", "1/0"})
        EXPECT_EQ(refused(std::string("render $m --hash --shard ") + wrong), 2) << wrong;
    EXPECT_EQ(refused("render $m --turntable 4 -o turn.apng --shard 1/2"), 2);
    EXPECT_EQ(refused("render $m --turntable 4 -o turn.png --sheet 2x2 --shard 1/2"), 2);
}

} // namespace
} // namespace scanout::app
