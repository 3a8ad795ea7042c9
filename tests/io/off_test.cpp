#include "io/off.h"
#include "math/srgb.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct OffRead {
    Result<OffFile> result;
    std::string warnings;

    const geom::PolygonMesh& mesh() const { return result->polygons; }
    std::string error() const { return result ? "no error" : result.error().what; }
};

OffRead read_off_text(std::string_view file) {
    Warnings warnings;
    auto result = read_off(file, "a.off", warnings, nullptr);
    return {std::move(result), fmt::format("{}", fmt::join(warnings.lines(), "\n"))};
}

TEST(Off, ReadsPolygonsLinesAndPointsAmongComments) {
    const OffRead r =
        read_off_text("# a comment\nOFF # another\n\n4 3 0\n0 0 0\n1 0 0 # a vertex\n1 1 0\n"
                      "\n0 1 0\n4 0 1 2 3\n2 0 1\n1 3\n");
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.warnings, "");
    EXPECT_EQ(r.mesh().positions.size(), 4u);
    EXPECT_EQ(r.mesh().faces(), 1u);
    EXPECT_EQ(r.mesh().corners[3].position, 3);
    EXPECT_THAT(r.mesh().line_vertices, ElementsAre(0, 1));
    EXPECT_THAT(r.mesh().point_vertices, ElementsAre(3));
}

TEST(Off, TheCountsMayFollowTheKeywordAndTheKeywordMayBeMissing) {
    for (const char* head : {"OFF 3 1 3\n", "3 1 3\n", "OFF\r\n3 1\r\n", "OFF BINARY_IS_NOT 3\n"}) {
        const OffRead r = read_off_text(std::string(head) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
        EXPECT_EQ(r.result.has_value(), std::string_view(head).find("NOT") == std::string::npos)
            << head << r.error();
    }
}

TEST(Off, KeywordsTellNormalsColoursAndTextureCoordinates) {
    const OffRead r =
        read_off_text("STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 255 0.5 0.25\n"
                      "1 0 0 0 0 1 0 128 0 255 1 0\n0 1 0 0 0 1 0 0 0 255 0 1\n3 0 1 2\n");
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().normals[0], Vec3(0, 0, 1));
    EXPECT_EQ(r.mesh().colours[0], Vec3(1, 0, 0));
    EXPECT_EQ(r.mesh().colours[1], Vec3(0, srgb_decode(std::uint8_t{128}), 0));
    EXPECT_EQ(r.mesh().uvs[0], DVec2(0.5, 0.25));
    EXPECT_EQ(r.mesh().corners[2].uv, 2);
    EXPECT_EQ(r.mesh().corners[2].normal, 2);
}

TEST(Off, ColoursStandBehindVerticesAndFacesOfThePlainKeyword) {
    const OffRead r =
        read_off_text("OFF\n3 3 0\n0 0 0 0.5 1 0\n1 0 0 1 1 1\n0 1 0 0 0 0\n3 0 1 2 255 0 0\n"
                      "3 0 2 1 1.0 0.0 0.0 1.0\n3 1 2 0 7\n");
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().colours[0], Vec3(static_cast<float>(linear_light_of_srgb(0.5)), 1, 0));
    EXPECT_THAT(r.mesh().face_material, ElementsAre(0, 0, -1));
    EXPECT_EQ(r.result->face_colours.materials()[0].diffuse, Vec3(1, 0, 0));
}

TEST(Off, WhatIsWrongWithALineLeavesTheOthers) {
    const OffRead r =
        read_off_text("OFF\n4 5 0\n0 0 0\n1 0 0\n0 1 0\n0 x 0\n3 0 1 9\n9 0 1 2\n-1\n3 0 1 2\n");
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().faces(), 1u);
    EXPECT_EQ(r.result->skipped, 4u);
    EXPECT_THAT(r.warnings, HasSubstr("a.off:6: a vertex needs three numbers"));
    EXPECT_THAT(r.warnings, HasSubstr("a.off:7: there is no vertex 9 (there are 4)"));
    EXPECT_THAT(r.warnings, HasSubstr("a.off: the file ends after 4 of 5 faces"));
}

TEST(Off, AFileThatCannotBeReadSaysWhy) {
    const std::pair<const char*, const char*> kCases[] = {
        {"OFF\n", "a.off:2: the counts of vertices and faces are missing"},
        {"OFF\n-1 2 3\n", "a.off:2: here the counts"},
        {"OFF BINARY\n1", "a.off:1: binary OFF is not read"},
        {"4OFF\n1 0 0\n", "a.off:1: a model of more than three dimensions"},
        {"nOFF\n3\n1 0 0\n", "a.off:1: a model of more than three dimensions"},
        {"OFF\n0 0 0\n", "a.off: an OFF file without vertices"},
        {"OFF\n4000000000 1 0\n", "a.off: an OFF file without vertices"},
        {"", "the file is empty"},
    };
    for (const auto& [file, error] : kCases) {
        const OffRead r = read_off_text(file);
        ASSERT_FALSE(r.result) << file;
        EXPECT_THAT(r.error(), HasSubstr(error)) << file;
    }
}

} // namespace
} // namespace scanout::io
