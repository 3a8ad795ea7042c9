// The program as a whole: help, exit codes, files, render and compare.
#include "app/message.h"
#include "app/program_fixture.h"
#include "app/report/report.h"
#include "image/codec.h"
#include "image/hash.h"
#include "simd/targets.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

namespace scanout::app {
namespace {

TEST_F(Program, AnOutputThatTakesNoMoreIsNoMistakeOfTheProgram) {
    for (const char* what : {"options", "techniques --json"}) {
        const Outcome outcome =
            run(std::string("list ") + what + " >/dev/full 2>\"$d\"stderr </dev/null #");
        EXPECT_EQ(outcome.code, 3) << what;
        const std::string err = folder.read("stderr");
        EXPECT_EQ(err.find("mistake"), std::string::npos) << err;
        EXPECT_NE(err.find("No space left"), std::string::npos) << err;
    }
}

TEST_F(Program, HelpAndVersionGoToStandardOutput) {
    EXPECT_NE(run("--help").out.find("scanout render"), std::string::npos);
    EXPECT_NE(run("--version").out.find("scanout "), std::string::npos);
    for (const char* command :
         {"view", "render", "explain", "frontier", "doctor", "info", "compare", "spectrum",
          "colour", "synthesise", "list", "generate"}) {
        const Outcome outcome = run(std::string(command) + " --help");
        EXPECT_EQ(outcome.code, 0);
        EXPECT_EQ(outcome.err, "");
        EXPECT_NE(outcome.out.find("--help"), std::string::npos) << command;
        for (const char* title : {"\nOutput:\n", "\nPicture:\n", "\nGeneral:\n"}) // once at most
            EXPECT_EQ(outcome.out.find(title), outcome.out.rfind(title)) << command << title;
    }
    for (const char* what : {"techniques", "formats", "targets", "keys", "options", "displays",
                             "connectors", "modes", "renderers"})
        EXPECT_EQ(run(std::string("list ") + what).code, 0) << what;
}

TEST_F(Program, WrongUseIsExitTwo) {
    for (const char* words : {"",
                              "rendr $m",
                              "render",
                              "render $m",
                              "render $m $m -o $d/x.png",
                              "render $m --hash --size 0x0",
                              "render $m --hash --size 20000x20000",
                              "render $m --hash --samples 3",
                              "render $m -o $d/x.obj",
                              "render $m -o $d/x.png --turntable 3",
                              "render $m -o - --hash",
                              "render $m -o - --json --format ppm",
                              "render $m --hash --texture none-such",
                              "render $m --hash --eye 1,1,1 --look-at 1,1,1",
                              "compare $m",
                              "list",
                              "list keyz",
                              "view",
                              "render $m -o $d/a.png --format ppm",
                              "render $m -o $d/a.PPM --format raw",
                              "render '' --hash",
                              "render $m --hash --camera 0,1000",
                              "view $m --backend vulkan",
                              "render $m --hash --pixel-format rgb999"})
        EXPECT_EQ(refused(words), 2) << words;
}

TEST_F(Program, FilesThatCannotBeUsedAreExitThree) {
    folder.write("empty.obj", "# nothing\n");
    folder.write("model.xyz", kTetrahedron);
    folder.write("bad.txt", "scanout-actions 1\n0 fly\n");
    for (const char* words :
         {"render $d/absent.obj --hash", "render $d/empty.obj --hash", "render $d/model.xyz --hash",
          "explain $d", "render $m -o $d/no/such/folder/x.png", "compare $d/a.png $d/b.png",
          "view $d/absent.obj", "view $m --backend headless --replay $d/absent",
          "view $m --backend headless --replay $d/bad.txt", "render $m -o /dev/full --format ppm"})
        EXPECT_EQ(refused(words), 3) << words;
}

// Every way in which a name comes back to the terminal: an error, a warning, what was written, the

// line of compare, the frame of a replay, JSON.

TEST_F(Program, NoNameDrivesTheTerminal) {
    const std::string evil = "\x1b[2J\xc2\x9b\n\xff";
    const std::string cow = folder.write("cow" + evil + ".obj",
                                         "mtllib no" + evil + ".mtl\n" + std::string(kTetrahedron));
    const std::string red = folder.file("red" + evil + ".png");
    folder.write("play", "scanout-actions 1\nframe " + folder.file("f\x1b[2J\xc2\x9b.png") + "\n");
    const image::Bytes small = *image::encode_png(image::Image(1, 1));
    folder.write("small.png", std::string(small.begin(), small.end()));
    for (const std::string& words :
         {"render '" + cow + "x' --hash",
          "render '" + cow + "' --size 9x9 --verbose -o '" + red + "'",
          "compare '" + red + "' $d/small.png", "compare '" + red + "' $d/small.png --json",
          "render '" + cow + "' --size 9x9 --json", "'zz" + evil + "'", "list '" + evil + "'",
          "view '" + cow + "' --backend headless --size 9x9 --replay $d/play"}) {
        const Outcome outcome = run(words);
        std::string text = outcome.out + outcome.err;
        EXPECT_TRUE(text.find("\\x1b[2J") != std::string::npos ||
                    text.find("\\u001b[2J") != std::string::npos)
            << text;
        text.erase(std::remove(text.begin(), text.end(), '\n'), text.end());
        EXPECT_EQ(text, escaped(text)) << words;
    }
}

TEST_F(Program, WhatCannotConvergeSaysSoWhereItWasAskedTo) {
    folder.write("play", "scanout-actions 1\n0 quit\n");
    const std::string quits = "view $m --backend headless --size 9x9 --replay $d/play";
    const std::string warning = "scanout: warning: --converge on changes nothing: with --";
    for (const char* option : {"", " --record $d/a", " --no-times"}) {
        const Outcome outcome = run(quits + " --converge on" + option);
        EXPECT_EQ(outcome.code, 0);
        EXPECT_TRUE(outcome.err.starts_with(warning)) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
    EXPECT_EQ(run(quits).err, "");
    EXPECT_EQ(run(quits + " --converge off").err, "");
    EXPECT_EQ(run(quits + " --converge on --quiet").err, "");
}

// K's line, as a shell reads it, draws what was on the screen.

TEST_F(Program, TheCommandOfAViewDrawsThePictureWithTheOptionsThatWereGiven) {
    folder.write("play", "scanout-actions 1\n0 rotate_left\nprint_view\n+1 frame " +
                             folder.file("seen.png") + "\n");
    const std::string always = "view $m --backend headless --size 64x48 --replay $d/play ";
    const auto noted = [&](const std::string& options) {
        const Outcome outcome = run(always + options);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.out.substr(outcome.out.find("scanout render "));
    };
    const std::string plain = noted("");
    const image::Image before = *image::load(folder.file("seen.png"));
    for (const char* options :
         {"--background white", "--background '#ff8000'", "--samples 8", "--light point:1,2,3",
          "--light none --light 'ambient:0.7:name=it is'\\''s'", "--effect directional_light=off",
          "--render-scale half", "--exposure -1 --tone filmic", "--pixel-format rgb565",
          "--allow-outside --background white --scale 1,2,-1 --rotate 10,20,30 --fov 60"}) {
        const std::string command = noted(options);
        const image::Image seen = *image::load(folder.file("seen.png"));
        EXPECT_NE(seen, before) << options << ": else nothing is tested";
        std::string words = command.substr(std::string("scanout ").size());
        words.replace(words.find("-o view.png\n"), std::string::npos, "-o $d/drawn.png");
        EXPECT_EQ(run(words).code, 0) << words;
        EXPECT_EQ(*image::load(folder.file("drawn.png")), seen) << command;
    }
    EXPECT_EQ(plain.find("--background"), std::string::npos) << "it was not given";
    EXPECT_EQ(noted("--allow-outside").find("--allow-outside "),
              std::string("scanout render ").size() + model.size() + 1);
}

// What is wrong is the first half of a message.

TEST_F(Program, EveryRefusalSaysWhatToDo) {
    struct Row {
        const char *words, *advice;
    };
    for (const Row& row :
         {Row{"render nofile.obj --hash", "check the name"},
          {"render $m -o nodir/a.png", "make the folder first"},
          {"render $m -o $m/a.png", "name a folder"},
          {"render '' --hash", "is a variable empty?"},
          {"render $m b.obj -o a.png", "2 models want {name} in the name"},
          {"render $m - --hash", "draw it alone"},
          {"list techniques shado", "did you mean 'shadow'?"},
          {"list keys all", "takes no more words"},
          {"render --hash", "as in `scanout render"},
          {"render $m -o", "-o wants FILE; give it"},
          {"render $m --cull", "--cull wants material|none|back|front; give it"},
          {"render $m --hash=yes", "write --hash alone"},
          {"render $m --hash --max-diff 3", "leave it out"},
          {"render $m -o $d/a.png --format ppm", "says png, --format says ppm; leave"},
          {"render $m --hash --json=nodir/a.json", "make the folder first"},
          {"compare nofile.png $m", "check the name"},
          {"compare a.png", "a.png was named"},
          {"view nofile.obj", "check the name"},
          {"view $m $d/none.obj --backend headless --record nodir/a", "make the folder first"},
          {"view $m --backend headless --replay nofile", "check the name"}}) {
        const Outcome outcome = run(row.words);
        EXPECT_NE(outcome.err.find(row.advice), std::string::npos)
            << row.words << ": " << outcome.err;
    }
}

TEST_F(Program, AFileThatBeginsWithADashStandsBehindTwoDashes) {
    folder.write("-a.obj", kTetrahedron);
    EXPECT_EQ(run("render --hash --size 9x9 -- -b.obj").code, 3) << "there is no such file";
    const Outcome drawn = run("render --hash --size 9x9 -o=-b.png -- -a.obj");
    EXPECT_EQ(drawn.code, 0) << drawn.err;
    EXPECT_FALSE(folder.read("-b.png").empty());
    const Outcome hint = run("render --hash -a.obj");
    EXPECT_NE(hint.err.find("-- -a.obj"), std::string::npos) << hint.err;
}

TEST_F(Program, AFailedWriteLeavesNothingBehind) {
    const std::size_t before = folder.count();
    std::filesystem::create_directory(folder.file("x.png"));
    EXPECT_EQ(refused("render $m --size 32x32 -o $d/x.png"), 3);
    EXPECT_EQ(folder.count(), before + 3) << "the folder, stdout and stderr";
}

TEST_F(Program, StandardOutputGetsTheBytesOfTheFile) {
    for (const char* format : {"png", "ppm", "pam", "raw"}) {
        EXPECT_EQ(run(std::string("render $m --size 33x21 -o $d/a.") + format).code, 0);
        const Outcome outcome = run(std::string("render $m --size 33x21 -o - --format ") + format);
        EXPECT_EQ(outcome.out, folder.read(std::string("a.") + format)) << format;
        EXPECT_FALSE(outcome.out.empty());
    }
}

TEST_F(Program, ThePictureDoesNotDependOnThreads) {
    EXPECT_EQ(hash_of("--threads 1"), hash_of("--threads 3"));
    EXPECT_NE(hash_of("--threads 1"), hash_of("--view iso"));
    EXPECT_EQ(hash_of("--view right"), hash_of("--camera 90,0"));
    EXPECT_EQ(hash_of("").size(), 17U);
}

TEST_F(Program, APixelFormatGivesTheBytesOfADisplayAndTheHashOfWhatItShows) {
    ASSERT_EQ(run("render $m --size 64x48 --view iso -o $d/full.png").code, 0);
    ASSERT_EQ(run("render $m --size 64x48 --view iso -o $d/narrow.png --pixel-format rgb565").code,
              0);
    ASSERT_EQ(run("render $m --size 64x48 --view iso -o $d/narrow.raw --pixel-format rgb565").code,
              0);
    const image::PixelFormat narrow = *image::pixel_format("rgb565");
    const image::Image shown = image::as_displayed(narrow, *image::load(folder.file("full.png")));
    EXPECT_EQ(*image::load(folder.file("narrow.png")), shown);
    EXPECT_EQ(folder.read("narrow.raw").size(), 64U * 48U * 2U);
    EXPECT_EQ(hash_of("--view iso --pixel-format rgb565"),
              image::hash_text(image::frame_hash(shown)) + "\n");
}

TEST_F(Program, APixelFormatIsDitheredOnceOrAsAsked) {
    const std::string draw = "render $m --size 64x48 --view iso ";
    const auto picture = [&](const std::string& name, const std::string& options) {
        EXPECT_EQ(run(draw + "-o $d/" + name + " " + options).code, 0) << options;
        return name.ends_with(".png") ? *image::load(folder.file(name)) : image::Image();
    };
    const image::PixelFormat narrow = *image::pixel_format("rgb565");
    const image::Image full = picture("full.png", "");
    const image::Image plain = image::without_dither(narrow, full);
    const image::Image dithered = image::as_displayed(narrow, full);
    EXPECT_NE(plain, dithered);
    EXPECT_EQ(picture("none.png", "--pixel-format rgb565 --dither none"), plain);
    EXPECT_EQ(picture("auto.png", "--pixel-format rgb565"), dithered);
    EXPECT_EQ(picture("bayer.png", "--pixel-format rgb565 --dither bayer"), dithered)
        << "of the codes that are nearest to the light, not of dithered ones";
    picture("none.raw", "--pixel-format rgb565 --dither none");
    picture("plain.raw", "--pixel-format rgb565");
    EXPECT_NE(folder.read("none.raw"), folder.read("plain.raw"));
    std::string bytes(folder.read("none.raw").size(), '\0');
    for (int y = 0; y < plain.height(); ++y)
        image::encode_row(narrow, plain.row(y), 0, y,
                          reinterpret_cast<std::uint8_t*>(bytes.data()) + y * plain.width() * 2);
    EXPECT_EQ(folder.read("none.raw"), bytes);
}

TEST_F(Program, ATurntableNumbersItsPicturesAndBeginsWithThePlainOne) {
    const std::string camera = "--camera 30,20,3 "; // else all of the turn is made to fit
    ASSERT_EQ(run("render $m --size 40x30 " + camera + "--turntable 11 -o $d/t-{n}.png").code, 0);
    ASSERT_EQ(run("render $m --size 40x30 " + camera + "-o $d/plain.png").code, 0);
    EXPECT_EQ(folder.read("t-00.png"), folder.read("plain.png"));
    EXPECT_NE(folder.read("t-01.png"), folder.read("plain.png"));
    EXPECT_FALSE(folder.read("t-10.png").empty());
    EXPECT_TRUE(folder.read("t-11.png").empty());
}

TEST_F(Program, JsonHoldsWhatTheDesignNames) {
    const Outcome outcome = run("render $m --size 64x48 --frames 3 --json --threads 2");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(json["model"]["vertices"], 4);
    EXPECT_EQ(json["model"]["faces"], 4);
    EXPECT_EQ(json["model"]["triangles"], 4);
    EXPECT_EQ(json["model"]["skipped"], 0);
    EXPECT_GT(json["model"]["bytes"], 0);
    ASSERT_EQ(json["frames"].size(), 3U);
    EXPECT_EQ(json["frames"][2]["hash"].get<std::string>() + "\n", hash_of(""));
    EXPECT_EQ(json["frames"][0]["width"], 64);
    EXPECT_EQ(json["frames"][0]["height"], 48);
    EXPECT_EQ(json["triangles"]["submitted"], 4);
    EXPECT_LE(json["ms"]["min"], json["ms"]["median"]);
    EXPECT_LE(json["ms"]["median"], json["ms"]["p95"]);
    for (const char* key : {"load", "first", "encode", "stages"})
        EXPECT_TRUE(json["ms"].contains(key)) << key;
    EXPECT_GT(json["rss_start_bytes"], 100'000);
    EXPECT_GT(json["peak_rss_bytes"], json["rss_start_bytes"]);
    EXPECT_EQ(json["threads"], 2);
    EXPECT_EQ(json["target"], simd::chosen_target());
    EXPECT_TRUE(json["warnings"].empty());
}

TEST_F(Program, CompareSaysSameSizesDifferOrPixelsDiffer) {
    const auto write = [&](const char* name, const image::Image& picture) {
        const image::Bytes bytes = *image::encode_png(picture);
        folder.write(name, std::string(bytes.begin(), bytes.end()));
    };
    image::Image picture(8, 6, {10, 20, 30, 255});
    write("a.png", picture);
    write("small.png", image::Image(7, 6, {10, 20, 30, 255}));
    picture.at(3, 2).g = 25;
    write("b.png", picture);
    EXPECT_EQ(run("compare $d/a.png $d/a.png").code, 0);
    EXPECT_EQ(run("compare $d/a.png $d/small.png").code, 21);
    const Outcome differs = run("compare $d/b.png $d/a.png --json");
    EXPECT_EQ(differs.code, 22);
    const auto json = nlohmann::json::parse(differs.out);
    EXPECT_EQ(json["max_difference"], 5);
    EXPECT_EQ(json["differing_pixels"], 1);
    EXPECT_EQ(*image::load(folder.file("b-got.png")), picture);
    EXPECT_EQ(image::load(folder.file("b-expected.png"))->at(3, 2).g, 20);
    EXPECT_EQ(image::load(folder.file("b-difference.png"))->at(3, 2).g, 80);
    EXPECT_EQ(run("compare $d/b.png $d/a.png --max-diff 4").code, 22);
    EXPECT_EQ(run("compare $d/b.png $d/a.png --max-diff 5").code, 0);
    EXPECT_EQ(run("compare $d/b.png $d/a.png --max-pixels 1").code, 0);
}

// A figure alone, its limit, and the heat map; formulas are the test's own.

TEST_F(Program, CompareMeasuresOneFigure) {
    const auto write = [&](const char* name, const image::Image& picture) {
        const image::Bytes bytes = *image::encode_png(picture);
        folder.write(name, std::string(bytes.begin(), bytes.end()));
    };
    image::Image picture(8, 6, {255, 255, 255, 255});
    write("a.png", picture);
    picture.at(3, 2).g = 0; // of 48 pixels, one of three channels is off by all
    write("b.png", picture);
    write("small.png", image::Image(7, 6));
    const auto figure = [&](const std::string& metric) {
        const Outcome outcome = run("compare $d/a.png $d/b.png --metric " + metric);
        EXPECT_EQ(outcome.code, 0) << metric; // no limit
        EXPECT_EQ(outcome.err, "") << metric;
        return outcome.out;
    };
    const double rmse = std::sqrt(1.0 / (48 * 3));
    EXPECT_EQ(figure("max"), "255\n");
    EXPECT_NEAR(std::stod(figure("rmse")), rmse, 1e-6);
    EXPECT_NEAR(std::stod(figure("rmse_codes")), 255 * rmse, 1e-6);
    EXPECT_NEAR(std::stod(figure("psnr")), -20 * std::log10(rmse), 1e-6);
    EXPECT_GT(std::stod(figure("flip")), 0.001);
    EXPECT_LT(std::stod(figure("ssim")), 0.999);
    EXPECT_EQ(run("compare $d/a.png $d/a.png --metric psnr").out, "inf\n");

    EXPECT_EQ(run("compare $d/a.png $d/b.png --metric rmse --limit 0.1").code, 0);
    const Outcome over = run("compare $d/a.png $d/b.png --metric rmse --limit 0.08");
    EXPECT_EQ(over.code, 22);
    EXPECT_NE(over.err.find("rmse is above --limit 0.08"), std::string::npos) << over.err;
    EXPECT_EQ(run("compare $d/a.png $d/b.png --metric psnr --limit 21").code, 0);
    EXPECT_EQ(run("compare $d/a.png $d/b.png --metric psnr --limit 22").code, 22);
    EXPECT_EQ(run("compare $d/a.png $d/small.png --metric ssim").code, 21);

    EXPECT_EQ(run("compare $d/a.png $d/b.png --metric max --heatmap $d/heat.png").code, 0);
    const image::Image heat = *image::load(folder.file("heat.png"));
    EXPECT_EQ(heat.at(3, 2), (image::Rgba8{0xfc, 0xfd, 0xbf, 255}));
    EXPECT_EQ(heat.at(4, 2), (image::Rgba8{0, 0, 4, 255}));

    EXPECT_EQ(run("compare $d/a.png $d/b.png --metric ssim --heatmap $d/heat.png").code, 0);
    const image::Image unlike = *image::load(folder.file("heat.png"));
    EXPECT_GT(unlike.at(4, 2).r, 0) << "its window holds the pixel that differs";
    EXPECT_NE(unlike.at(4, 2), heat.at(3, 2));

    const auto json = nlohmann::json::parse(run("compare $d/a.png $d/b.png --json").out);
    EXPECT_NEAR(double{json["rmse"]}, rmse, 1e-6);
    EXPECT_NEAR(double{json["share_off_by_more_than_one"]}, 1.0 / 48, 1e-6);
    EXPECT_LT(double{json["ssim"]}, 0.999);
    EXPECT_EQ(refused("compare $d/a.png $d/b.png --limit 1"), 2);
    EXPECT_EQ(refused("compare $d/a.png $d/b.png --metric max --max-diff 1"), 2);
    EXPECT_EQ(refused("compare $d/a.png $d/b.png --heatmap $d/heat.jpg"), 2);
    EXPECT_EQ(refused("compare $d/a.png $d/b.png --heatmap $d/a-difference.png"), 2);
    EXPECT_EQ(refused("compare $d/a.png $d/b.png --heatmap - --json"), 2);
    const Outcome piped = run("compare $d/a.png $d/b.png --metric max --heatmap -");
    EXPECT_TRUE(piped.out.ends_with("IEND\xae\x42\x60\x82")) << "more than a PNG";
    EXPECT_EQ(piped.err, "255\n");
    EXPECT_EQ(refused("compare $d/a.png $d/b.png --heatmap $d/a.png"), 2);
}

// All of its files, and what stands in them.

// A model whose reference does not fit: the bytes are said, and times are measured all the same.

// Errors alone do not depend on the clock: the same text, with any number of threads.

// An axis that nothing calls for leaves one point, whose time is measured all the same.

TEST(Report, PercentilesAreTheNearestRank) {
    EXPECT_EQ(percentile({}, 0.5), 0);
    EXPECT_EQ(percentile({3, 1, 2}, 0), 1);
    EXPECT_EQ(percentile({3, 1, 2}, 0.5), 2);
    EXPECT_EQ(percentile({4, 1, 2, 3}, 0.5), 2);
    EXPECT_EQ(percentile({4, 1, 2, 3}, 0.95), 4);
}

// Rungs by --budget and --max-error: measured by the first run, remembered by the next ones.

// Whoever draws one model after the other gets a picture of each: where nothing can be chosen, the

// one that is asked for, and a line that says why.

} // namespace
} // namespace scanout::app
