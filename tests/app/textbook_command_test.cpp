// --renderer: what it draws, and what it says of what it lacks.
#include "app/program_fixture.h"
#include "textbook/methods.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace scanout::app {
namespace {

TEST_F(Program, TextbookRenderersDraw) {
    std::set<std::string> hashes;
    for (const char* renderer : {"textbook", "compendium", "course", "software_graphics"}) {
        const Outcome outcome =
            run(std::string("render $m --hash --quiet -s 64x48 --renderer ") + renderer);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        hashes.insert(outcome.out);
    }
    EXPECT_GT(hashes.size(), 2U);
    // Of several parts each counts.
    EXPECT_EQ(run("render $m --hash -s 64x48 --renderer textbook --hidden none --line wu "
                  "--clip cohen_sutherland")
                  .code,
              0);
    const Outcome json = run("render $m --json --quiet -s 64x48 --renderer course");
    EXPECT_NE(json.out.find("\"covered_pixels\""), std::string::npos);
}

TEST_F(Program, WhatATextbookRendererLacksIsSaidInOneLine) {
    const std::pair<const char*, const char*> cases[] = {
        {"--renderer textbok", "did you mean 'textbook'?"},
        {"--renderer course --shadow map", "--renderer course has no --shadow map"},
        {"--renderer textbook --samples 4", "has no --samples 4"},
        {"--renderer textbook --edges all", "has no --edges all"},
        {"--renderer textbook --effect shadow=on", "has no effect shadow"},
        {"--renderer textbook --opacity 0.5", "has no --opacity 0.5"},
        {"--renderer textbook --budget 16ms", "has no --budget 16ms"},
        {"--renderer textbook --reference", "give one of them"},
        {"--fill x_scanline", "say --renderer textbook, too"},
        {"--renderer textbook --line wu", "the edges of --hidden none; say that, too"},
        {"--renderer textbook --clip liang_barsky", "the edges of --hidden none; say that, too"},
        {"--renderer textbook --hidden none --fill x_scanline", "leave out --fill"},
        {"--renderer textbook --hidden none --interpolation affine", "leave out --interpolation"},
        {"--renderer textbook --hidden none --clip four_cases", "--hidden none draws lines"},
        {"--renderer textbook --hidden warnock --fill x_scanline", "leave out --fill"},
        {"--renderer textbook --fill scanline", "wants one of flat_halves x_scanline"}};
    for (const auto& [words, says] : cases) {
        const Outcome outcome = run(std::string("render $m --hash ") + words);
        EXPECT_EQ(outcome.code, 2) << words;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
    // What they do anyway may be named.
    EXPECT_EQ(run("render $m --hash -s 64x48 --renderer textbook --samples 1 --aa none --shadow "
                  "auto --texture nearest")
                  .code,
              0);
    for (const char* command : {"view", "frontier", "explain"}) {
        const Outcome outcome = run(std::string(command) + " $m --renderer textbook");
        EXPECT_EQ(outcome.code, 2);
        EXPECT_NE(outcome.err.find("--renderer is for render"), std::string::npos) << outcome.err;
    }
}

// What the model itself calls for is left out with a warning: the highlight of rough surfaces is.
TEST_F(Program, ATextbookRendererWarnsOfTheHighlightThatItLeavesOut) {
    const std::string dice = "render " SCANOUT_SOURCE_DIR "/models/dice/dice.glb --hash -s 64x48 ",
                      says = "no highlight ggx: left out";
    EXPECT_NE(run(dice + "--renderer textbook").err.find(says), std::string::npos);
    EXPECT_EQ(run(dice).err.find(says), std::string::npos);
    EXPECT_EQ(run(dice + "--renderer textbook --effect highlight=off").err.find(says),
              std::string::npos);
    EXPECT_EQ(run("render $m --hash -s 64x48 --renderer textbook").err, "");
}

TEST_F(Program, ListRenderersNamesEveryMethod) {
    const Outcome listed = run("list renderers");
    for (const textbook::Part& part : textbook::parts())
        for (const textbook::Method& method : part.methods)
            EXPECT_NE(listed.out.find(
                          fmt::format("{:<14} {:<20} {}", part.name, method.name, method.blurb)),
                      std::string::npos)
                << method.name;
}

} // namespace
} // namespace scanout::app
