// --texture-file, as a user meets it.
#include "app/program_fixture.h"

#include <filesystem>

#include <gmock/gmock.h>

namespace scanout::app {
namespace {

using ::testing::HasSubstr;

constexpr const char* kSquare = "v -1 -1 0\nv 1 -1 0\nv 1 1 0.5\nv -1 1 0\n"
                                "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n";
constexpr const char* kFace = "f 1/1/1 2/2/1 3/3/1 4/4/1\n";

class TextureFile : public Program {
protected:
    TextureFile() {
        std::filesystem::copy_file(SCANOUT_SOURCE_DIR "/models/spot/spot.png",
                                   folder.file("p.png"));
        const std::string with = std::string("mtllib a.mtl\n") + kSquare + "usemtl ";
        folder.write("a.mtl", "newmtl named\nKd 0.7 0.6 0.5\nmap_Kd p.png\n"
                              "newmtl bare\nKd 0.7 0.6 0.5\n");
        folder.write("named.obj", with + "named\n" + kFace);
        folder.write("bare.obj", with + "bare\n" + kFace);
        folder.write("none.obj", std::string(kSquare) + kFace);
        folder.write("no_uv.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nf 1 2 3\n");
    }
    std::string drawn(const std::string& words) {
        const Outcome outcome = run("render --size 64x48 --hash " + words);
        EXPECT_EQ(outcome.code, 0) << words << ": " << outcome.err;
        err = outcome.err;
        return outcome.out.substr(0, outcome.out.find(' '));
    }
    std::string err;
};

TEST_F(TextureFile, IsDrawnAsOneThatTheMaterialNames) {
    for (const char* renderer :
         {"", " --renderer textbook", " --reference --reference-samples 16"}) {
        const std::string named = drawn(std::string("named.obj") + renderer);
        EXPECT_EQ(drawn(std::string("bare.obj --texture-file p.png") + renderer), named);
        EXPECT_EQ(err, "");
        EXPECT_NE(drawn(std::string("bare.obj") + renderer), named);
    }
}

TEST_F(TextureFile, LeavesMaterialsAloneThatNameOneAndSaysSo) {
    std::filesystem::copy_file(SCANOUT_SOURCE_DIR "/models/spider/wal67ar_small.jpg",
                               folder.file("q.jpg"));
    EXPECT_EQ(drawn("named.obj --texture-file q.jpg"), drawn("named.obj"));
    drawn("named.obj --texture-file q.jpg");
    EXPECT_THAT(err, HasSubstr("changes nothing"));
}

TEST_F(TextureFile, LiesOnWhatHasNoMaterialInItsOwnColours) {
    const std::string plain = drawn("none.obj"), textured = drawn("none.obj --texture-file p.png");
    EXPECT_NE(textured, plain);
    EXPECT_EQ(drawn("none.obj --base-colour 0.1 --texture-file p.png"), textured);
}

TEST_F(TextureFile, SaysWhatIsMissing) {
    const std::string plain = drawn("no_uv.obj");
    EXPECT_EQ(drawn("no_uv.obj --base-colour 1 --texture-file p.png"),
              drawn("no_uv.obj --base-colour 1"));
    EXPECT_NE(drawn("no_uv.obj --texture-file p.png --mapping box"), plain);
    drawn("no_uv.obj --texture-file p.png");
    EXPECT_THAT(err, HasSubstr("--mapping"));
    EXPECT_EQ(refused("render none.obj --hash --texture-file nowhere.png"), 3);
    EXPECT_EQ(refused("render none.obj --hash --texture-file ''"), 2);
}

} // namespace
} // namespace scanout::app
