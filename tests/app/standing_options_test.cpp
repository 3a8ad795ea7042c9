// Options for every run, from a file and from SCANOUT_OPTIONS.
#include "app/options/command_line.h"
#include "app/options/standing_options.h"
#include "support/temporary_folder.h"

#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>

namespace scanout::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(SplitWords, AsAShellWithoutExpansion) {
    EXPECT_THAT(*split_words("  --up z\t--light 'point:1, 2' "),
                ElementsAre("--up", "z", "--light", "point:1, 2"));
    EXPECT_THAT(*split_words(R"(--device=/dev/"my card" '' $HOME)"),
                ElementsAre("--device=/dev/my card", "", "$HOME"));
    EXPECT_THAT(*split_words(" \n"), IsEmpty());
    EXPECT_THAT(split_words("--light 'a").error().what, HasSubstr("not closed"));
}

std::string parent_of(const std::string& path) {
    return std::filesystem::path(path).parent_path().string();
}

// A user whose file and variable hold these texts.
class User {
public:
    User(std::string_view file, const char* variable) {
        std::filesystem::create_directory(folder_.file("scanout"));
        folder_.write("scanout/options", std::string(file));
        ::setenv("XDG_CONFIG_HOME", parent_of(folder_.file("scanout")).c_str(), 1);
        ::setenv("SCANOUT_OPTIONS", variable, 1);
    }
    ~User() {
        ::unsetenv("XDG_CONFIG_HOME");
        ::unsetenv("SCANOUT_OPTIONS");
    }
    Result<Settings> runs(std::vector<std::string> words) const {
        Result<CommandLine> line = parse_command_line(std::move(words), read_standing_options);
        if (!line) return tl::unexpected(line.error());
        return std::move(line->settings);
    }
    std::string file() const { return folder_.file("scanout/options"); }

private:
    test::TemporaryFolder folder_;
};

TEST(StandingOptions, TheCommandLineGoesBeforeTheVariableAndThatBeforeTheFile) {
    const User user("# mine\n--size 320x200 --up z\n\n--background '#102030'\n", "--size 640x480");
    const Result<Settings> settings = user.runs({"render", "a.obj"});
    ASSERT_TRUE(settings) << settings.error().what;
    EXPECT_EQ(settings->frame.width, 640);
    EXPECT_EQ(settings->camera.up, scene::UpAxis::plus_z);
    EXPECT_EQ(settings->frame.background, (image::Rgba8{0x10, 0x20, 0x30, 255}));
    EXPECT_EQ(settings->given.size(), 3U) << "each once, for the command line that K notes";
    EXPECT_EQ(user.runs({"render", "a.obj", "-s", "64x48"})->frame.width, 64);
    EXPECT_EQ(user.runs({"render", "a.obj", "--no-config"})->frame.width, 1280);
}

TEST(StandingOptions, WhatTheCommandLineExcludesIsLeftOut) {
    const User user("--view iso\n--light key\n--budget 5ms\n--aa area", "");
    const Result<Settings> camera = user.runs({"render", "a.obj", "--camera", "10,20"});
    ASSERT_TRUE(camera) << camera.error().what;
    EXPECT_EQ(camera->named_view, "");
    EXPECT_EQ(user.runs({"render", "a.obj", "--reference"})->limits.any(), false);
    EXPECT_EQ(user.runs({"render", "a.obj", "--samples", "4"})->frame.aa, "auto");
    EXPECT_EQ(
        user.runs({"render", "a.obj", "--light", "fill"})->frame.lights.size(),
        user.runs({"render", "a.obj", "--light", "fill", "--no-config"})->frame.lights.size());
}

TEST(StandingOptions, ThoseOfOtherCommandsAreLeftOut) {
    const User user("--max-diff 3 --backend headless\n", "--turntable=4");
    EXPECT_TRUE(user.runs({"render", "a.obj"}));
    EXPECT_EQ(user.runs({"render", "a.obj"})->turntable, 4);
    EXPECT_EQ(user.runs({"compare", "a.png", "b.png"})->max_difference, 3);
    EXPECT_EQ(user.runs({"view", "a.obj"})->backend, Backend::headless);
}

TEST(StandingOptions, AMistakeIsNamedWithItsPlaceAndStopsNoHelp) {
    const User file("--up z\n--smaples 4\n", "");
    EXPECT_EQ(file.runs({"render", "a.obj"}).error().what,
              file.file() + ":2: there is no option --smaples; did you mean '--samples'?");
    EXPECT_TRUE(file.runs({"render", "--help"}));
    EXPECT_TRUE(file.runs({"render", "a.obj", "--no-config"}));
    const User values("", "--size 3");
    EXPECT_THAT(values.runs({"render", "a.obj"}).error().what,
                HasSubstr("SCANOUT_OPTIONS: --size "));
    EXPECT_THAT(User("", "spot.obj").runs({"render", "a.obj"}).error().what,
                HasSubstr("'spot.obj' is no option"));
    EXPECT_THAT(User("", "--size").runs({"render", "a.obj"}).error().what, HasSubstr("wants WxH"));
    EXPECT_THAT(User("", "--hash=on").runs({"render", "a.obj"}).error().what,
                HasSubstr("takes no value"));
    EXPECT_THAT(User("--up 'z", "").runs({"render", "a.obj"}).error().what,
                HasSubstr("options:1: a quote"));
}

TEST(StandingOptions, AFolderInThePlaceOfTheFileIsSaid) {
    const User user("", "");
    std::filesystem::remove(user.file());
    EXPECT_TRUE(user.runs({"render", "a.obj"}));
    std::filesystem::create_directory(user.file());
    EXPECT_THAT(user.runs({"render", "a.obj"}).error().what, HasSubstr("is a folder"));
}

} // namespace
} // namespace scanout::app
