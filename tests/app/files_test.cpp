#include "app/files.h"
#include "app/picture/picture.h"
#include "support/temporary_folder.h"

#include <filesystem>

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

TEST(FileName, IsThePathsLastPart) {
    EXPECT_EQ(file_name_of("models/spot/spot.obj"), "spot.obj");
    EXPECT_EQ(file_name_of("spot.obj"), "spot.obj");
}

class Files : public ::testing::Test {
protected:
    test::TemporaryFolder folder_;
};

TEST_F(Files, AnOutputOverAnInputIsRefusedByNameAndByLink) {
    const std::string model = folder_.write("model.obj", "v 0 0 0\n");
    const std::string link = folder_.file("link.png");
    std::filesystem::create_symlink(model, link);
    EXPECT_FALSE(check_outputs({model}, {model}));
    EXPECT_FALSE(check_outputs({model}, {folder_.file("./model.obj")}));
    ASSERT_FALSE(check_outputs({model}, {link}));
    EXPECT_EQ(check_outputs({model}, {link}).error().exit, Exit::usage);
}

TEST_F(Files, TwoOutputsOfOneNameAreRefusedBeforeTheyExist) {
    const std::string out = folder_.file("new.png");
    EXPECT_FALSE(check_outputs({}, {out, folder_.file("./new.png")}));
    EXPECT_TRUE(check_outputs({}, {out, folder_.file("other.png")}));
    EXPECT_FALSE(check_outputs({}, {"new.png", "./new.png"}));
}

TEST_F(Files, StandardOutputAndNoNameAreNobodysFile) {
    EXPECT_TRUE(check_outputs({"-", ""}, {"-", "-", "", ""}));
    EXPECT_TRUE(check_outputs({folder_.write("a.obj", "v 0 0 0\n")},
                              {folder_.file("a.png"), "/dev/null", "/dev/null"}));
}

TEST_F(Files, OneOutputAloneTakesStandardOutput) {
    EXPECT_TRUE(check_standard_output({"-", "", "a.png"}));
    EXPECT_FALSE(check_standard_output({"-", "a.png", "-"}));
}

TEST_F(Files, AnOutputWithoutAFolderIsRefusedBeforeAnythingIsDone) {
    const std::string file = folder_.write("file", "");
    for (const std::string& out :
         {folder_.file("no/such/a.png"), file + "/a.png", folder_.file("")}) {
        const Result<void> checked = check_outputs({}, {out});
        ASSERT_FALSE(checked) << out;
        EXPECT_EQ(checked.error().exit, Exit::unreadable);
        EXPECT_NE(checked.error().what.find("; "), std::string::npos) << checked.error().what;
    }
    EXPECT_TRUE(check_outputs({}, {"a.png", "/a.png", folder_.file("a.png"), "./b.png"}));
}

TEST_F(Files, WhatCannotBeReadIsNamedWithWhatToDo) {
    EXPECT_TRUE(check_readable(folder_.write("a.obj", "")));
    const std::string absent = folder_.file("b.obj");
    EXPECT_EQ(check_readable(absent).error().what,
              absent + ": cannot be opened: No such file or directory; "
                       "check the name and its folder");
}

TEST(Numbered, EveryPlaceholderIsReplaced) {
    Settings settings;
    settings.turntable = 100;
    EXPECT_EQ(numbered("turn-{n}/t{n}.png", settings, 7), "turn-07/t07.png");
    EXPECT_EQ(numbered("plain.png", settings, 7), "plain.png");
    settings.range = FrameRange{95, 104};
    EXPECT_EQ(numbered("{n}-{frame}.png", settings, 3), "3-098.png");
}

} // namespace
} // namespace scanout::app
