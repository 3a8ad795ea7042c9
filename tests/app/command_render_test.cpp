// scanout render of several models, and what it says of pictures that show nothing.
#include "app/program_fixture.h"

#include <nlohmann/json.hpp>

#include <gmock/gmock.h>

namespace scanout::app {
namespace {

using ::testing::HasSubstr;

TEST_F(Program, DrawsSeveralModelsEachToItsOwnFile) {
    folder.write("two.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                            "vertex 0 1 0\nendloop\nendfacet\nendsolid\n");
    const Outcome drawn = run("render $m two.stl -o 'out-{name}-{n}.ppm' --turntable 2 -s 32x24 "
                              "--json --quiet");
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    for (const char* name :
         {"out-model-0.ppm", "out-model-1.ppm", "out-two-0.ppm", "out-two-1.ppm"})
        EXPECT_TRUE(folder.read(name).starts_with("P6\n32 24\n")) << name;
    const auto json = nlohmann::json::parse(drawn.out);
    ASSERT_EQ(json.size(), 2U);
    EXPECT_EQ(json[1]["model"]["triangles"], 1);
    EXPECT_EQ(json[0]["frames"].size(), 2U);
    const Outcome hashes = run("render $m two.stl --hash -s 32x24");
    ASSERT_EQ(hashes.lines().size(), 2U);
    EXPECT_EQ(hashes.lines()[0] + "\n", run("render $m --hash -s 32x24").out);
}

TEST_F(Program, DrawsTheOtherModelsWhereOneCannotBeRead) {
    const Outcome drawn = run("render $m none.obj -o '{name}.ppm' -s 32x24");
    EXPECT_EQ(drawn.code, 3);
    EXPECT_THAT(drawn.err, HasSubstr("none.obj: cannot be opened"));
    EXPECT_FALSE(folder.read("model.ppm").empty());
}

TEST_F(Program, RefusesModelsThatWouldBeWrittenToOneFile) {
    folder.write("model.stl", "solid\nendsolid\n");
    EXPECT_EQ(refused("render $m model.stl -o '{name}.png'"), 2);
}

TEST_F(Program, CountsPixelsThatShowTheModelAndFailsWhereThereIsNoneIfAsked) {
    const auto covered = [&](const std::string& words) {
        const Outcome drawn = run("render $m --json --quiet -s 64x48 " + words);
        return nlohmann::json::parse(drawn.out)["frames"][0]["covered_pixels"].get<int>();
    };
    // Not lit: every pixel whose centre the model covers has its colour, and the reference agrees
    // but for pixels that an edge crosses.
    const int drawn = covered("");
    EXPECT_GT(drawn, 200);
    EXPECT_LT(drawn, 64 * 48);
    EXPECT_GE(covered("--reference --reference-samples 16"), drawn);
    const std::string away = "--translate 100,0,0 --camera 0,0,4 ";
    EXPECT_EQ(covered(away), 0);
    EXPECT_EQ(run("render $m --hash --quiet " + away).code, 0);
    EXPECT_EQ(run("render $m --hash --quiet --fail-if-empty " + away).code, 4);
    EXPECT_EQ(run("render $m --hash --quiet --fail-if-empty").code, 0);
}

TEST_F(Program, EveryListIsJsonToo) {
    for (const char* what : {"displays", "connectors", "modes", "techniques", "formats", "targets",
                             "keys", "options", "renderers"}) {
        const Outcome listed = run(std::string("list --json ") + what);
        ASSERT_EQ(listed.code, 0) << what << listed.err;
        const auto rows = nlohmann::json::parse(listed.out);
        ASSERT_TRUE(rows.is_array()) << what;
        for (const auto& row : rows)
            EXPECT_TRUE(row.is_object()) << what;
    }
    const auto rows = nlohmann::json::parse(run("list techniques render-scale --json").out);
    ASSERT_GT(rows.size(), 3U);
    for (const auto& row : rows)
        EXPECT_EQ(row["axis"], "render_scale");
    EXPECT_EQ(run("list techniques render-scale").lines().size(), rows.size());
}

} // namespace
} // namespace scanout::app
