// scanout generate from outside: pictures and models by formulas. tests/cli/completions.py asks for
// the documents.
#include "app/command/commands.h"
#include "app/program_fixture.h"
#include "formula/formula.h"
#include "image/codec.h"

namespace scanout::app {
namespace {

class Generate : public Program {
protected:
    image::Image picture(const std::string& name) { return *image::load(folder.file(name)); }
};

TEST_F(Generate, EveryFormulaMakesAPictureAndAModelThatCanBeDrawn) {
    for (const formula::Formula& f : formula::formulas()) {
        const std::string name(f.name);
        EXPECT_NE(generated_words().find(name), std::string::npos);
        const std::string detail = " --detail " + std::to_string(std::min(f.of_model, 5));
        const Outcome drawn = run("generate " + name + " -o p.png --size 40x30" + detail);
        EXPECT_EQ(drawn.code, 0) << drawn.err;
        EXPECT_EQ(drawn.out + drawn.err, "");
        EXPECT_EQ(picture("p.png").width(), 40);
        EXPECT_EQ(picture("p.png").height(), 30);
        const std::string size = f.height_field ? " --size 20x15" : "";
        const Outcome made = run("generate " + name + " -o m.obj" + size + detail);
        EXPECT_EQ(made.code, 0) << made.err;
        EXPECT_EQ(made.out + made.err, "");
        const Outcome shown = run("render m.obj --size 32x32 --hash --fail-if-empty");
        EXPECT_EQ(shown.code, 0) << name << shown.err;
        EXPECT_EQ(shown.err, "") << name;
    }
}

TEST_F(Generate, TheSameNumbersGiveTheSameBits) {
    EXPECT_EQ(run("generate terrain -o a.obj --size 30x20 --seed 3 --threads 1").code, 0);
    EXPECT_EQ(run("generate terrain -o b.obj --size 30x20 --seed 3 --threads 3").code, 0);
    EXPECT_EQ(run("generate terrain -o c.obj --size 30x20 --seed 4").code, 0);
    EXPECT_EQ(folder.read("a.obj"), folder.read("b.obj"));
    EXPECT_NE(folder.read("a.obj"), folder.read("c.obj"));
    const std::string info = run("info a.obj").out;
    EXPECT_NE(info.find("600"), std::string::npos) << info; // vertices
}

TEST_F(Generate, WhatChangesNothingIsSaid) {
    EXPECT_NE(run("generate koch -o k.png --seed 3").err.find("--seed changes nothing"),
              std::string::npos);
    EXPECT_NE(run("generate koch -o k.obj --size 9x9").err.find("--size changes nothing"),
              std::string::npos);
    EXPECT_EQ(run("generate man -o scanout.1").code, 0);
    EXPECT_EQ(folder.read("scanout.1"), run("generate man").out);
    EXPECT_TRUE(run("generate koch -o - --size 9x9 --format ppm").out.starts_with("P6"));
}

TEST_F(Generate, BadUseIsOneLine) {
    for (const char* words :
         {"generate", "generate koch", "generate koch terrain -o x.png", "generate koh -o x.png",
          "generate koch -o x.stl", "generate koch -o x.png --detail 11",
          "generate zone_plate -o x.png --detail 0", "generate fern -o x.png --detail 100001",
          "generate fern -o x.png --detail 1.5", "generate fern -o x.png --size 9",
          "generate terrain -o x.obj --size 1x9", "generate terrain -o x.png --seed -4"})
        EXPECT_EQ(refused(words), 2) << words;
    EXPECT_EQ(refused("generate koch -o no/folder/x.png"), 3);
    EXPECT_EQ(refused("generate koch -o no/folder/x.obj"), 3);
    EXPECT_NE(run("generate koh -o x.png").err.find("did you mean 'koch'"), std::string::npos);
}

} // namespace
} // namespace scanout::app
