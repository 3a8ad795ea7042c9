#include "app/options/command_line.h"
#include "app/options/help.h"
#include "app/options/options.h"
#include "app/options/text.h"
#include "app/options/values.h"
#include "app/picture/nearest.h"
#include "math/rotation.h"
#include "simd/targets.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::app {
namespace {

Result<Settings> parse(std::vector<std::string> words) {
    Result<CommandLine> line = parse_command_line(std::move(words));
    if (!line) return tl::unexpected(line.error());
    return std::move(line->settings);
}

std::string error_of(std::vector<std::string> words) {
    const Result<Settings> settings = parse(std::move(words));
    if (settings) return "(no error)";
    EXPECT_EQ(settings.error().exit, Exit::usage);
    EXPECT_EQ(settings.error().what.find('\n'), std::string::npos) << "an error is one line";
    return settings.error().what;
}

// What a default must leave unchanged, as far as options with defaults reach.
auto values(const Settings& s) {
    return std::tuple(s.frame.width, s.frame.height, s.frame.samples, s.frame.background,
                      s.frame.cull, s.frame.texture, s.frame.reflection, s.camera.azimuth_degrees,
                      s.camera.elevation_degrees, s.camera.distance, s.camera.fov_degrees,
                      s.camera.projection, s.camera.up, s.unnamed_colour, s.model.scale,
                      s.model.rotate_degrees, s.model.translate, s.threads, s.target, s.frames,
                      s.backend, s.max_difference, s.max_pixels);
}

TEST(Options, TheDefaultOfEachIsWhatAnUntouchedRunUses) {
    int held = 0;
    for (const Option& row : options()) {
        if (row.default_text.empty()) continue;
        Settings settings;
        ASSERT_TRUE(apply(row, row.default_text, settings)) << row.name;
        EXPECT_TRUE(values(settings) == values(Settings())) << row.name;
        ++held;
    }
    EXPECT_GT(held, 15);
}

// The look of the design, where nobody asks for another one.
TEST(Options, WithoutAnyAreTheLook) {
    const Settings s = *parse({"render", "a.obj", "-o", "a.png"});
    EXPECT_EQ(s.frame.samples, 4);
    EXPECT_EQ(s.camera.azimuth_degrees, 30);
    EXPECT_EQ(s.camera.elevation_degrees, 20);
    EXPECT_EQ(s.camera.distance, 0) << "it fits";
    EXPECT_EQ(s.frame.lights, scene::default_lights());
    EXPECT_EQ(s.unnamed_colour, Vec3(0.6F));
}

TEST(Options, AWayToSmoothEdgesTakesThePlaceOfTheSamplesThatNobodyAskedFor) {
    const auto samples = [](std::vector<std::string> more) {
        std::vector<std::string> words = {"render", "a.obj", "-o", "a.png"};
        words.insert(words.end(), more.begin(), more.end());
        return parse(std::move(words))->frame.samples;
    };
    EXPECT_EQ(samples({"--aa", "area"}), 1);
    EXPECT_EQ(samples({"--aa", "auto"}), 4);
    EXPECT_EQ(samples({"--samples", "8", "--aa", "area"}), 8) << "which the plan refuses";
    EXPECT_EQ(samples({"--aa", "area", "--samples", "8"}), 8);
}

TEST(Options, TheBaseColourIsAGreyOrAColour) {
    const auto base = [](const char* text) {
        return parse({"render", "a.obj", "-o", "a.png", "--base-colour", text})->unnamed_colour;
    };
    EXPECT_EQ(base("0.8"), Vec3(0.8F)) << "linear";
    EXPECT_EQ(base("0"), Vec3(0));
    EXPECT_EQ(base("#ff0000"), Vec3(1, 0, 0));
    EXPECT_EQ(base("white"), Vec3(1));
    for (const char* bad : {"1.5", "-0.1", "nan", "", "reddish"})
        EXPECT_NE(error_of({"render", "a.obj", "-o", "a.png", "--base-colour", bad})
                      .find("--base-colour"),
                  std::string::npos)
            << bad;
}

TEST(Options, ThePlaneOfProjectedShadowsIsTheGroundOrFourNumbers) {
    EXPECT_FALSE(parse({"render", "a.obj", "-o", "a.png"})->frame.shadow_plane);
    const auto plane = parse({"render", "a.obj", "-o", "a.png", "--shadow-plane", "0,-2.5,1e3,+4"})
                           ->frame.shadow_plane;
    ASSERT_TRUE(plane);
    EXPECT_EQ(plane->normal, DVec3(0, -2.5, 1e3));
    EXPECT_EQ(plane->offset, 4);
    EXPECT_FALSE(parse({"render", "a.obj", "-o", "a.png", "--shadow-plane", "0,1,0,4",
                        "--shadow-plane", "ground"})
                     ->frame.shadow_plane);
    for (const char* text :
         {"", "floor", "0,1,0", "0,1,0,0,0", "0,1,0,x", "nan,1,0,0", "0,inf,0,0"})
        EXPECT_NE(error_of({"render", "a.obj", "--shadow-plane", text}).find("NX,NY,NZ,D"),
                  std::string::npos)
            << text;
    EXPECT_NE(error_of({"render", "a.obj", "--shadow-plane", "0,0,0,1"}).find("must not be 0,0,0"),
              std::string::npos);
}

TEST(Options, EveryNameAndLetterIsUniqueWithinACommand) {
    for (const auto& [word, command] : kCommands) {
        std::set<std::string_view> names;
        std::set<char> letters = {'h'};
        for (const Option& row : options()) {
            if (!belongs(row, command)) continue;
            EXPECT_TRUE(names.insert(row.name).second) << row.name;
            EXPECT_TRUE(row.letter == 0 || letters.insert(row.letter).second) << row.name;
        }
    }
}

// By whatever row: some names mean one thing to one command and another to another.
bool takes(Command command, std::string_view name) {
    return std::any_of(options().begin(), options().end(), [&](const Option& row) {
        return row.name == name && belongs(row, command);
    });
}

TEST(Options, EveryOneStandsInTheHelpOfItsCommandsAndInTheTable) {
    const std::string table = options_markdown();
    for (const Option& row : options()) {
        const std::string name = "--" + std::string(row.name);
        EXPECT_FALSE(row.help.empty()) << name;
        EXPECT_NE(table.find("`" + name + "`"), std::string::npos) << name;
        for (const auto& [word, command] : kCommands)
            EXPECT_EQ(full_help_for(command).find(name + " ") != std::string::npos ||
                          full_help_for(command).find(name + "[") != std::string::npos ||
                          full_help_for(command).find(name + "\n") != std::string::npos,
                      takes(command, row.name))
                << name;
    }
}

TEST(Options, TheShortHelpHasTwentyOptionsAtMostAndSaysHowManyMore) {
    for (const auto& [word, command] : kCommands) {
        const std::string help = help_for(command), full = full_help_for(command);
        int shown = 0, all = 0;
        for (const Option& row : options()) {
            if (!belongs(row, command)) continue;
            ++all;
            const std::string start = row.letter != 0
                                          ? fmt::format("\n  -{}, --{}", row.letter, row.name)
                                          : fmt::format("\n      --{}", row.name);
            const auto has = [&](char next) {
                return help.find(start + next) != std::string::npos;
            };
            shown += has(' ') || has('[') || has('\n') ? 1 : 0;
        }
        EXPECT_LE(shown, 20) << word;
        EXPECT_GE(shown, std::min(all - 1, 3)) << word;
        EXPECT_LE(help.size(), full.size()) << word;
        EXPECT_NE(help.find("--help-all"), std::string::npos) << word;
    }
    EXPECT_NE(full_help_for(Command::render).find("auto flat gouraud"), std::string::npos)
        << "the techniques of --shading";
}

TEST(Options, HelpAndVersionCanBeAskedForInEachUsualWay) {
    const auto printed = [](std::vector<std::string> words) {
        return parse_command_line(std::move(words))->printout;
    };
    EXPECT_EQ(printed({"help"}), help_overview());
    EXPECT_EQ(printed({"--help"}), help_overview());
    EXPECT_EQ(printed({"help", "render"}), help_for(Command::render));
    EXPECT_EQ(printed({"render", "-h"}), help_for(Command::render));
    EXPECT_EQ(printed({"render", "a.obj", "--help-all"}), full_help_for(Command::render));
    EXPECT_EQ(printed({"--help-all", "list"}), full_help_for(Command::list));
    EXPECT_NE(error_of({"help", "rendr"}).find("did you mean 'render'"), std::string::npos);
    EXPECT_EQ(printed({"-V"}), printed({"--version"}));
    EXPECT_EQ(printed({"version"}), printed({"--version"}));
}

TEST(Options, OneGivenTwiceWithAnotherValueIsSaid) {
    const auto notes = [](std::vector<std::string> words) {
        return parse(std::move(words))->notes;
    };
    const std::vector<std::string> twice = notes({"render", "a.obj", "--fov", "30", "--fov", "40"});
    ASSERT_EQ(twice.size(), 1U);
    EXPECT_EQ(twice[0], "--fov is given 2 times; 40 counts, which is the last");
    EXPECT_TRUE(notes({"render", "a.obj", "--fov", "40", "--fov", "40"}).empty());
    EXPECT_TRUE(notes({"render", "a.obj", "--light", "key", "--light", "fill"}).empty());
}

TEST(Options, OneOfAnotherDisplayThanTheBackendsIsSaid) {
    const auto notes = [](std::vector<std::string> words) {
        words.insert(words.begin(), {"view", "a.obj"});
        return parse(std::move(words))->notes;
    };
    using Notes = std::vector<std::string>;
    EXPECT_EQ(notes({"--terminal", "kitty"}),
              Notes{"--terminal changes nothing: it goes with --backend terminal"});
    EXPECT_EQ(notes({"--terminal", "auto", "--backend", "drm"}).size(), 1U);
    EXPECT_EQ(notes({"--backend", "headless", "--connector", "HDMI-A-1"}),
              Notes{"--connector changes nothing: it goes with --backend drm"});
    EXPECT_EQ(notes({"--backend", "headless", "--device", "/dev/fb0", "--mode", "highest"}).size(),
              2U);
    EXPECT_EQ(notes({"--backend", "fbdev", "--mode", "highest"}).size(), 1U);
    for (const std::vector<std::string>& words :
         {Notes{"--backend", "terminal", "--terminal", "sixel"}, Notes{"--connector", "HDMI-A-1"},
          Notes{"--backend", "fbdev", "--device", "/dev/fb0"}, Notes{"--connector", "help"}})
        EXPECT_TRUE(notes(words).empty()) << words.front();
}

TEST(Options, NumbersAreTakenInTheirRangeAndRefusedOutsideIt) {
    for (const Option& row : options()) {
        if (!(row.max > row.min)) continue;
        Settings settings;
        EXPECT_TRUE(apply(row, fmt::format("{}", row.min), settings)) << row.name;
        EXPECT_TRUE(apply(row, fmt::format("{:.0f}", row.max), settings)) << row.name;
        EXPECT_FALSE(apply(row, fmt::format("{}", row.min - 1), settings)) << row.name;
        EXPECT_FALSE(apply(row, fmt::format("{:.0f}", row.max + 1), settings)) << row.name;
        EXPECT_FALSE(apply(row, "99999999999999999999999", settings)) << row.name;
        EXPECT_FALSE(apply(row, "4x", settings)) << row.name;
        EXPECT_FALSE(apply(row, "", settings)) << row.name;
        EXPECT_FALSE(apply(row, "nan", settings)) << row.name;
    }
}

TEST(Options, EachSpellingOfAValueMeansTheSame) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"render", "a.obj", "-o", "x.png"},
          {"render", "-ox.png", "a.obj"},
          {"render", "--output=x.png", "a.obj"},
          {"render", "--output", "y.png", "a.obj", "-o", "x.png"}}) {
        const Result<Settings> settings = parse(words);
        ASSERT_TRUE(settings) << settings.error().what;
        EXPECT_EQ(settings->output, "x.png");
        EXPECT_EQ(settings->arguments, std::vector<std::string>{"a.obj"});
    }
}

TEST(Options, AnEqualsSignAfterALetterIsNoPartOfTheName) {
    EXPECT_EQ(parse({"render", "a.obj", "-o=x.png"})->output, "x.png");
    EXPECT_EQ(parse({"render", "a.obj", "-o", "-o=x.png"})->output, "-o=x.png")
        << "a value is a value";
    EXPECT_EQ(parse({"render", "a.obj", "-o=-"})->output, "-");
    EXPECT_EQ(parse({"render", "a.obj", "-s=64x48", "--hash"})->frame.width, 64);
    EXPECT_NE(error_of({"render", "a.obj", "-o="}).find("FILE"), std::string::npos);
}

TEST(Options, BehindTwoDashesEveryWordIsAFile) {
    using Words = std::vector<std::string>;
    EXPECT_EQ(parse({"render", "-o", "x.png", "--", "-a.obj"})->arguments, Words{"-a.obj"});
    EXPECT_EQ(parse({"--", "-a.obj", "--help", "-o=x", "--json", "b.json"})->arguments,
              (Words{"-a.obj", "--help", "-o=x", "--json", "b.json"}));
    EXPECT_EQ(parse({"view", "--", "--version"})->arguments, Words{"--version"});
    EXPECT_EQ(parse({"compare", "--", "-a.png", "-b.png"})->arguments, (Words{"-a.png", "-b.png"}));
}

TEST(Options, TheHelpOfEachCommandNamesTheTwoDashes) {
    for (const auto& [word, command] : kCommands)
        EXPECT_NE(full_help_for(command).find(" --  "), std::string::npos);
}

TEST(Options, AnEmptyWordIsNoFile) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{""}, {"render", "", "--hash"}, {"compare", "a.png", ""}})
        EXPECT_NE(error_of(words).find("empty"), std::string::npos);
}

TEST(Options, ACameraAboveTheZenithOrNowhereIsRefusedWithTheRange) {
    for (const char* text : {"0,1000", "0,90.1", "0,-91,2"})
        EXPECT_NE(error_of({"render", "a.obj", "--camera", text}).find("-90 to 90"),
                  std::string::npos)
            << text;
    for (const char* text : {"nan,0", "0,inf", "0,0,-nan"})
        EXPECT_NE(error_of({"render", "a.obj", "--camera", text}).find("finite"), std::string::npos)
            << text;
    EXPECT_TRUE(parse({"render", "a.obj", "--camera", "-7200.5,90"}));
}

TEST(Options, NegativeNumbersAreValuesAndNotOptions) {
    const Result<Settings> settings =
        parse({"render", "a.obj", "--camera", "-30,-20.5,3", "--rotate", "-1,+2,-3"});
    ASSERT_TRUE(settings) << settings.error().what;
    EXPECT_EQ(settings->camera.azimuth_degrees, -30);
    EXPECT_EQ(settings->camera.elevation_degrees, -20.5);
    EXPECT_EQ(settings->camera.distance, 3);
    EXPECT_EQ(settings->model.rotate_degrees, DVec3(-1, 2, -3));
}

TEST(Options, DepthTestsWhoseNamesChangedSaySo) {
    const auto notes = [](const std::vector<std::string>& words) { return parse(words)->notes; };
    for (const auto& [name, shows] : {std::pair("less", "less shows the nearest now"),
                                      {"less_equal", "nearest now"},
                                      {"greater", "greater shows the farthest now"},
                                      {"greater_equal", "farthest now"}}) {
        const std::vector<std::string> said = notes({"render", "a.obj", "--depth-test", name});
        ASSERT_EQ(said.size(), 1U) << name;
        EXPECT_NE(said[0].find(shows), std::string::npos) << said[0];
    }
    for (const char* name : {"not_equal", "always", "auto"})
        EXPECT_TRUE(notes({"render", "a.obj", "--depth-test", name}).empty()) << name;
}

TEST(Options, TransformsAreDoneInTheOrderOfTheCommandLine) {
    const auto model_of = [](const std::vector<std::string>& words) {
        std::vector<std::string> all = {"render", "a.obj"};
        all.insert(all.end(), words.begin(), words.end());
        const Result<Settings> settings = parse(all);
        EXPECT_TRUE(settings) << settings.error().what;
        return settings ? settings->model : scene::ModelTransform();
    };
    // In the order of the model's own, they are these.
    const scene::ModelTransform plain =
        model_of({"--scale", "2", "--rotate", "0,0,90", "--translate", "1,0,0"});
    EXPECT_EQ(plain.scale, DVec3(2));
    EXPECT_EQ(plain.rotate_degrees, DVec3(0, 0, 90));
    EXPECT_EQ(plain.translate, DVec3(1, 0, 0));
    EXPECT_TRUE(plain.steps.empty());
    const auto other =
        model_of({"--translate", "1,0,0", "--rotate", "0,0,90", "--rotate", "0,90,0", "--about",
                  "4,5,6", "--scale", "1,2,3", "--about", "centre", "--shear", "y:0.5,2"});
    EXPECT_EQ(other.translate, DVec3(1, 0, 0));
    EXPECT_EQ(other.rotate_degrees, DVec3(0));
    ASSERT_EQ(other.steps.size(), 4U);
    EXPECT_EQ(other.steps[0].linear, rotation_z(90));
    EXPECT_EQ(other.steps[1].linear, rotation_y(90));
    EXPECT_EQ(other.steps[2].linear, scene::scaling({1, 2, 3}));
    EXPECT_EQ(other.steps[2].about, DVec3(4, 5, 6));
    EXPECT_FALSE(other.steps[1].about || other.steps[3].about);
    EXPECT_EQ(other.steps[3].linear * DVec3(1, 1, 1), DVec3(1, 3.5, 1));
    const auto matrix = model_of({"--matrix", "1,2,0,4,0,1,0,5,0,0,3,6,0,0,0,1"});
    ASSERT_EQ(matrix.steps.size(), 1U);
    EXPECT_EQ(matrix.steps[0].linear * DVec3(1, 10, 100), DVec3(21, 10, 300));
    EXPECT_EQ(matrix.steps[0].offset, DVec3(4, 5, 6));
}

TEST(Options, TransformsThatAreNoneAreRefused) {
    const auto error = [](const char* option, const char* text) {
        return error_of({"render", "a.obj", option, text});
    };
    EXPECT_NE(error("--matrix", "1,2,3,0,4,5,6,0,7,8,9,0,0,0,0,1").find("singular"),
              std::string::npos);
    EXPECT_NE(error("--matrix", "1,0,0,0,0,1,0,0,0,0,1,0,0,0,1,1").find("last row"),
              std::string::npos);
    EXPECT_NE(error("--matrix", "1,0,0,0").find("--matrix"), std::string::npos);
    for (const char* text : {"x", "x:1", "w:1,2", "x1,2", "x:1,2,3", ""})
        EXPECT_NE(error("--shear", text).find("x:0.5,0"), std::string::npos) << text;
    for (const char* text : {"1,0,0", "1,0:30", ":30", "1,0,0:x"})
        EXPECT_NE(error("--rotate-axis", text).find("1,1,0:30"), std::string::npos) << text;
    EXPECT_NE(error("--rotate-axis", "0,0,0:30").find("0,0,0"), std::string::npos);
    EXPECT_NE(error("--about", "here").find("--about"), std::string::npos);
}

TEST(Options, AWindowSaysAllThatTheOthersSay) {
    const Result<Settings> settings = parse({"render", "a.obj", "--frustum", "-1,2,-3,4,5,6"});
    ASSERT_TRUE(settings) << settings.error().what;
    ASSERT_TRUE(settings->camera.window);
    EXPECT_EQ(settings->camera.window->right, 2);
    EXPECT_EQ(settings->camera.window->bottom, -3);
    EXPECT_EQ(settings->camera.near, 5);
    EXPECT_EQ(settings->camera.far, 6);
    EXPECT_EQ(parse({"render", "a.obj", "--ortho", "-1,2,-3,4,-5,6"})->camera.projection,
              scene::Projection::orthographic);
    for (const std::vector<std::string>& other : {std::vector<std::string>{"--fov", "30"},
                                                  {"--near", "1"},
                                                  {"--far", "1"},
                                                  {"--projection", "orthographic"},
                                                  {"--screen-fit", "width"},
                                                  {"--ortho", "0,1,0,1,0,1"}})
        EXPECT_NE(error_of({"render", "a.obj", "--frustum", "-1,2,-3,4,5,6", other[0], other[1]})
                      .find("exclude each other"),
                  std::string::npos)
            << other[0];
}

TEST(Options, AModelAfterABareJsonIsNotTakenForTheFileToWrite) {
    Result<Settings> settings = parse({"render", "--json", "a.obj"});
    ASSERT_TRUE(settings) << settings.error().what;
    EXPECT_EQ(settings->json, "-");
    EXPECT_EQ(settings->arguments, std::vector<std::string>{"a.obj"});
    settings = parse({"render", "a.obj", "--json", "out.json"});
    ASSERT_TRUE(settings);
    EXPECT_EQ(settings->json, "out.json");
    EXPECT_EQ(parse({"render", "a.obj", "--json=x"})->json, "x");
    EXPECT_FALSE(parse({"render", "a.obj"})->json.has_value());
}

TEST(Options, ATargetWithCommasIsAPointAndElseAnInstructionSet) {
    const Result<Settings> settings =
        parse({"render", "a.obj", "--target", "1,2,3", "--eye", "4,5,6"});
    ASSERT_TRUE(settings) << settings.error().what;
    EXPECT_EQ(*settings->camera.target, DVec3(1, 2, 3));
    EXPECT_EQ(settings->target, "auto");
    const std::string set = simd::targets().back().name;
    EXPECT_EQ(parse({"render", "a.obj", "--target", set})->target, set);
    EXPECT_NE(error_of({"render", "a.obj", "--target", set + "x"}).find("did you mean '" + set),
              std::string::npos);
}

TEST(Options, TheFirstWordIsACommandOrAModel) {
    EXPECT_EQ(parse({"a.obj", "b.obj"})->command, Command::view);
    EXPECT_EQ(parse({"view", "a.obj"})->command, Command::view);
    EXPECT_EQ(parse({"--size", "9x9", "a.obj"}).value().command, Command::view);
    EXPECT_EQ(parse({"compare", "a.png", "b.png"})->command, Command::compare);
    EXPECT_NE(error_of({"rendr", "a.obj"}).find("did you mean 'render'"), std::string::npos);
    EXPECT_NE(error_of({"zzzzzzz"}).find("--help"), std::string::npos);
    EXPECT_NE(error_of({}).find("--help"), std::string::npos);
}

TEST(Options, AMisspeltOptionIsAnsweredWithTheNearestName) {
    EXPECT_NE(error_of({"render", "a.obj", "--smaples", "4"}).find("did you mean '--samples'"),
              std::string::npos);
    EXPECT_NE(error_of({"render", "a.obj", "--cul=back"}).find("did you mean '--cull'"),
              std::string::npos);
    EXPECT_NE(error_of({"render", "a.obj", "--cull", "bakc"}).find("did you mean 'back'"),
              std::string::npos);
    EXPECT_NE(
        error_of({"render", "a.obj", "--max-diff", "4"}).find("--max-diff is for compare, not"),
        std::string::npos);
    EXPECT_NE(error_of({"render", "a.obj", "-Z"}).find("-Z"), std::string::npos);
}

TEST(Options, WhatPlacesTheCameraTwiceOrHalfIsRefused) {
    EXPECT_NE(error_of({"render", "a.obj", "--eye", "1,2,3"}).find("--look-at"), std::string::npos);
    EXPECT_NE(error_of({"render", "a.obj", "--look-at", "1,2,3"}).find("--eye"), std::string::npos);
    EXPECT_NE(error_of({"render", "a.obj", "--view", "iso", "--camera", "1,2"}).find("one of them"),
              std::string::npos);
}

TEST(Values, ImpossibleSizesAreRefused) {
    for (const char* text :
         {"", "x", "640", "640x", "x480", "0x480", "640x0", "-1x5", "640x480x2", "16385x1",
          "1x16385", "16384x16384", "99999999999999999999x1", "6 40x480", "1e3x5"})
        EXPECT_FALSE(parse_size(text)) << text;
    EXPECT_EQ(parse_size("16384x8192")->width, 16384);
    EXPECT_EQ(parse_size("1x1")->height, 1);
}

TEST(Values, ColoursAreHexadecimalOrNamed) {
    EXPECT_EQ(*parse_colour("#102030"), (image::Rgba8{0x10, 0x20, 0x30, 255}));
    EXPECT_EQ(*parse_colour("#fA0"), (image::Rgba8{0xff, 0xaa, 0x00, 255}));
    EXPECT_EQ(*parse_colour("white"), (image::Rgba8{255, 255, 255, 255}));
    for (const char* text : {"", "#", "#12", "#12345g", "#1234567", "whit", "102030"})
        EXPECT_FALSE(parse_colour(text)) << text;
}

RC_GTEST_PROP(Values, AnyTextIsReadOrRefusedAndNeverThrows, (const std::string& text)) {
    (void)parse_integer(text);
    (void)parse_real(text);
    (void)parse_list(text, 1, 3);
    (void)parse_size(text);
    (void)parse_colour(text);
    Settings settings;
    for (const Option& row : options())
        (void)apply(row, text, settings);
}

RC_GTEST_PROP(Nearest, DistanceIsAMetricAsFarAsSpellingNeedsOne,
              (const std::string& a, const std::string& b)) {
    RC_ASSERT(edit_distance(a, a) == 0);
    RC_ASSERT(edit_distance(a, b) == edit_distance(b, a));
    RC_ASSERT((edit_distance(a, b) == 0) == (a == b));
    RC_ASSERT(edit_distance(a, a + "x") == 1);
}

TEST(Nearest, OneSwapOneLetterMoreOrLessCountsOne) {
    EXPECT_EQ(edit_distance("samples", "smaples"), 1);
    EXPECT_EQ(edit_distance("cull", "cul"), 1);
    EXPECT_EQ(edit_distance("view", "vieew"), 1);
    const std::array<std::string_view, 2> names = {"render", "compare"};
    EXPECT_EQ(nearest_name("rendre", names), "render");
    EXPECT_EQ(nearest_name("xyz", names), "");
}

} // namespace
} // namespace scanout::app
