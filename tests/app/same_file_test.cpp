#include "app/picture.h"
#include "app/same_file.h"
#include "support/temporary_folder.h"

#include <filesystem>

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

class SameFile : public ::testing::Test {
protected:
    test::TemporaryFolder folder_;
};

TEST_F(SameFile, AnOutputOverAnInputIsRefusedByNameAndByLink) {
    const std::string model = folder_.write("model.obj", "v 0 0 0\n");
    const std::string link = folder_.file("link.png");
    std::filesystem::create_symlink(model, link);
    EXPECT_FALSE(keep_apart({model}, {model}));
    EXPECT_FALSE(keep_apart({model}, {folder_.file("./model.obj")}));
    ASSERT_FALSE(keep_apart({model}, {link}));
    EXPECT_EQ(keep_apart({model}, {link}).error().exit, Exit::usage);
}

TEST_F(SameFile, TwoOutputsOfOneNameAreRefusedBeforeTheyExist) {
    const std::string out = folder_.file("new.png");
    EXPECT_FALSE(keep_apart({}, {out, folder_.file("./new.png")}));
    EXPECT_TRUE(keep_apart({}, {out, folder_.file("other.png")}));
}

TEST_F(SameFile, StandardOutputAndNoNameAreNobodysFile) {
    EXPECT_TRUE(keep_apart({"-", ""}, {"-", "-", "", ""}));
    EXPECT_TRUE(keep_apart({folder_.write("a.obj", "v 0 0 0\n")},
                           {folder_.file("a.png"), "/dev/null", "/dev/null"}));
}

TEST(Numbered, EveryPlaceholderIsReplaced) {
    EXPECT_EQ(numbered("turn-{n}/t{n}.png", 7, 100), "turn-07/t07.png");
    EXPECT_EQ(numbered("plain.png", 7, 100), "plain.png");
}

} // namespace
} // namespace scanout::app
