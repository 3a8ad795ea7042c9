// scanout synthesise from outside.
#include "app/program_fixture.h"
#include "image/codec.h"

#include <csignal>
#include <filesystem>

#include <unistd.h>

namespace scanout::app {
namespace {

class Synthesise : public Program {
protected:
    void write(const std::string& name, int width, int height) {
        image::Image out(width, height);
        std::uint32_t state = 1;
        for (image::Rgba8& p : out.pixels()) {
            state = state * 1664525U + 1013904223U;
            p = {static_cast<std::uint8_t>(state >> 24U), 60, 90, 255};
        }
        const image::Bytes bytes = *image::encode_png(out);
        folder.write(name, std::string(bytes.begin(), bytes.end()));
    }
    image::Image picture(const std::string& name) { return *image::load(folder.file(name)); }
};

TEST_F(Synthesise, MakesAnySizeWithTheSameBitsForEveryNumberOfThreads) {
    write("in.png", 24, 20);
    EXPECT_EQ(run("synthesise in.png -o a.png --size 61x33 --threads 1").code, 0);
    EXPECT_EQ(run("synthesise in.png -o b.png --size 61x33 --threads 3 --seed 1 --by patch").code,
              0);
    EXPECT_EQ(run("synthesise in.png -o c.png --size 61x33 --seed 2").code, 0);
    EXPECT_EQ(run("synthesise in.png -o d.png --by pixel --window 5 --size 20x10").code, 0);
    EXPECT_EQ(run("synthesise in.png -o e.png").code, 0);
    EXPECT_EQ(picture("a.png"), picture("b.png"));
    EXPECT_NE(picture("a.png"), picture("c.png"));
    EXPECT_EQ(picture("a.png").width(), 61);
    EXPECT_EQ(picture("d.png").height(), 10);
    EXPECT_EQ(picture("e.png").width(), 48);
}

TEST_F(Synthesise, CtrlCLeavesNothingBehind) {
    write("in.png", 64, 64);
    // The work takes minutes; timeout sends SIGINT after half a second.
    const Outcome outcome = run("--version >/dev/null; timeout -s INT 0.5 '" SCANOUT_BINARY
                                "' synthesise in.png -o out.png --by pixel --size 512x512");
    EXPECT_EQ(outcome.code, 124);
    for (const auto& entry : std::filesystem::directory_iterator(folder.file("")))
        EXPECT_EQ(entry.path().filename().string().find("out.png"), std::string::npos);
}

TEST_F(Synthesise, BadUseIsOneLine) {
    write("in.png", 24, 20);
    write("tiny.png", 2, 30);
    for (const char* words :
         {"synthesise", "synthesise in.png", "synthesise in.png -o in.png",
          "synthesise tiny.png -o x.png", "synthesise in.png -o x.png --window 21",
          "synthesise in.png -o x.png --window 2",
          "synthesise in.png -o x.png --by pixel --window 6",
          "synthesise in.png -o x.png --size 0x9", "synthesise in.png -o x.png --seed -1",
          "synthesise in.png -o x.png --by line", "synthesise in.png in.png -o x.png"})
        EXPECT_EQ(refused(words), 2) << words;
    EXPECT_EQ(refused("synthesise none.png -o x.png"), 3);
    EXPECT_EQ(refused("synthesise in.png -o no/x.png"), 3);
}

} // namespace
} // namespace scanout::app
