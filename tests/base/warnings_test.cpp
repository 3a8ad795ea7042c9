#include "base/warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::test {
namespace {

using ::testing::ElementsAre;

TEST(Warnings, SaysEachKindOnceWithItsFirstPlaceAndCountsTheRest) {
    Warnings warnings;
    EXPECT_TRUE(warnings.empty());
    warnings.add("bad face", "cube.obj:12: face wants vertex 9, the file has 8");
    warnings.add("no map", "cube.mtl:3: wood.png: No such file or directory");
    for (int line = 13; line < 1013; ++line)
        warnings.add("bad face", "cube.obj: another");
    EXPECT_FALSE(warnings.empty());
    EXPECT_EQ(warnings.count("bad face"), 1001U);
    EXPECT_EQ(warnings.count("no map"), 1U);
    EXPECT_EQ(warnings.count("never seen"), 0U);
    EXPECT_THAT(
        warnings.lines(),
        ElementsAre("cube.obj:12: face wants vertex 9, the file has 8 (and 1000 more like it)",
                    "cube.mtl:3: wood.png: No such file or directory"));
}

TEST(Warnings, CountsManyAtOnceOfAKindThatHasALine) {
    Warnings warnings;
    warnings.add_more("bad face", 5); // no line yet, so nothing that could be said
    EXPECT_TRUE(warnings.lines().empty());
    warnings.add("bad face", "a:1: first");
    warnings.add_more("bad face", 0);
    EXPECT_THAT(warnings.lines(), ElementsAre("a:1: first"));
    warnings.add_more("bad face", 7);
    EXPECT_EQ(warnings.count("bad face"), 8U);
    EXPECT_THAT(warnings.lines(), ElementsAre("a:1: first (and 7 more like it)"));
}

} // namespace
} // namespace scanout::test
