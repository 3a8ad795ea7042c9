// Views given back: --like a screenshot or a state, --state, and folders of models.
#include "app/program_fixture.h"
#include "image/codec.h"

#include <filesystem>

#include <gmock/gmock.h>

namespace scanout::app {
namespace {

using ::testing::HasSubstr;

struct ViewFile : Program {
    // Turns the model, and writes a screenshot.
    void take_screenshot() {
        folder.write("turn.actions",
                     "scanout-actions 1\n0 view_right\n+1 rotate_left\n+1 scale_up\n"
                     "+1 screenshot\n+1 frame seen.png\n");
        ASSERT_EQ(run("view $m --backend headless -s 64x48 --samples 8 --replay turn.actions "
                      "--state state --quiet")
                      .code,
                  0);
    }
};

TEST_F(ViewFile, OfAScreenshotAreDrawnAgain) {
    take_screenshot();
    ASSERT_EQ(run("render $m --like scanout-model-001.png -o again.png").code, 0);
    ASSERT_EQ(run("render $m -s 64x48 --samples 8 -o plain.png").code, 0);
    const auto picture = [&](const char* name) { return *image::load(folder.file(name)); };
    EXPECT_EQ(picture("again.png"), picture("scanout-model-001.png"));
    EXPECT_NE(picture("again.png"), picture("plain.png"));
    // What the command line says counts; another camera takes the view's shift away with its own.
    folder.write("aside", "# A view of scanout\n--camera 0,0,4 --shift 1,0 --samples 2\n");
    const std::string elsewhere = "render $m --hash -s 64x48 --samples 2 --camera 10,0,5";
    EXPECT_EQ(run(elsewhere + " --like aside").out, run(elsewhere).out);
    EXPECT_NE(run("render $m --hash -s 64x48 --like aside").out, run(elsewhere).out);
    ASSERT_EQ(run("render $m --like scanout-model-001.png -s 32x24 -o small.png").code, 0);
    EXPECT_EQ(picture("small.png").width(), 32);
}

TEST_F(ViewFile, OfAStateAreGoneOnWith) {
    take_screenshot();
    EXPECT_THAT(folder.read("state"), HasSubstr("--samples 8"));
    folder.write("look.actions", "scanout-actions 1\n0 frame now.png\n");
    ASSERT_EQ(run("view $m --backend headless -s 64x48 --replay look.actions --state state").code,
              0);
    const auto picture = [&](const char* name) { return *image::load(folder.file(name)); };
    EXPECT_EQ(picture("now.png"), picture("scanout-model-001.png"));
    const std::string state = folder.read("state");
    ASSERT_EQ(run("view $m --backend headless -s 64x48 --replay look.actions --state state").code,
              0);
    EXPECT_EQ(folder.read("state"), state) << "a view that stays is the same view";
    ASSERT_EQ(run("render $m --like state -o again.png").code, 0);
    EXPECT_EQ(picture("again.png"), picture("scanout-model-001.png"));
}

TEST_F(ViewFile, AreRefusedWhereAFileHoldsNone) {
    ASSERT_EQ(run("render $m -s 8x8 -o plain.png").code, 0);
    folder.write("text", "--samples 8\n");
    folder.write("broken.png", "\x89PNG\r\n\x1a\nrubbish");
    folder.write("wrong", "# A view of scanout: x\n--no-such-option 3\n");
    for (const char* file : {"plain.png", "text", "broken.png", "none.png"})
        EXPECT_EQ(refused(std::string("render $m --hash --like ") + file), 3) << file;
    EXPECT_EQ(refused("render $m --hash --like wrong"), 2);
    EXPECT_EQ(refused("view $m --state model.obj --backend headless"), 3);
}

TEST_F(ViewFile, OfAFolderAreOfItsModelsByName) {
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (const char* path : {"parts/in", "empty"})
        std::filesystem::create_directories(folder.file(path));
    for (const char* name : {"parts/b.obj", "parts/a.obj", "parts/notes.txt", "parts/in/c.obj"})
        folder.write(name, triangle);
    folder.write("empty/readme.md", "");
    const Outcome drawn = run("render parts -s 16x12 -o '{name}.ppm' --verbose");
    ASSERT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_LT(drawn.err.find("wrote a.ppm"), drawn.err.find("wrote b.ppm"));
    EXPECT_EQ(drawn.err.find("wrote c.ppm"), std::string::npos);
    EXPECT_EQ(drawn.err.find("notes"), std::string::npos);
    EXPECT_EQ(refused("render empty --hash"), 3);
    EXPECT_EQ(run("render parts $m -s 16x12 --hash").lines().size(), 3U);
}

} // namespace
} // namespace scanout::app
