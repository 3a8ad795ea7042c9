// The lines at which faces and positions of PLY and OFF files stand.
#include "io/off.h"
#include "io/ply/ply.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::io {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Line 13 has two corners, line 15 a vertex that is not there.
constexpr const char* kPly = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                             "property float y\nproperty float z\nelement face 4\n"
                             "property list uchar int vertex_indices\nend_header\n"
                             "0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n3 0 1 7\n3 2 1 0\n";

TEST(PlyLines, AreThoseOfTheRows) {
    for (const bool lines : {false, true}) {
        Warnings warnings;
        const auto read = read_ply(kPly, "a.ply", warnings, nullptr, {.lines = lines});
        ASSERT_TRUE(read);
        ASSERT_EQ(read->polygons.faces(), 2U);
        if (lines) {
            EXPECT_THAT(read->position_lines, ElementsAre(10, 11, 12));
            EXPECT_THAT(read->face_lines, ElementsAre(14, 16));
        } else {
            EXPECT_THAT(read->position_lines, IsEmpty());
            EXPECT_THAT(read->face_lines, IsEmpty());
        }
    }
}

// Faces before their vertices, of which the file has fewer than its header tells.
TEST(PlyLines, StayWithTheirFacesWhereOthersAreDropped) {
    Warnings warnings;
    const auto read =
        read_ply("ply\nformat ascii 1.0\nelement face 3\nproperty list uchar int vertex_indices\n"
                 "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                 "end_header\n3 0 1 3\n3 0 1 2\n3 2 1 0\n0 0 0\n1 0 0\n0 1 0\n",
                 "a.ply", warnings, nullptr, {.lines = true});
    ASSERT_TRUE(read);
    EXPECT_THAT(read->face_lines, ElementsAre(11, 12));
    EXPECT_EQ(read->polygons.faces(), 2U);
}

TEST(OffLines, AreThoseOfTheStatements) {
    for (const bool lines : {false, true}) {
        Warnings warnings;
        const auto read = read_off("OFF\n# a comment\n3 4 0\n0 0 0\n\n1 0 0\n# another\n0 1 0\n"
                                   "3 0 1 2\n2 0 1\n3 0 1 9\n3 2 1 0\n",
                                   "a.off", warnings, nullptr, {.lines = lines});
        ASSERT_TRUE(read);
        ASSERT_EQ(read->polygons.faces(), 2U);
        if (lines) {
            EXPECT_THAT(read->position_lines, ElementsAre(4, 6, 8));
            EXPECT_THAT(read->face_lines, ElementsAre(9, 12));
        } else {
            EXPECT_THAT(read->position_lines, IsEmpty());
            EXPECT_THAT(read->face_lines, IsEmpty());
        }
    }
}

} // namespace
} // namespace scanout::io
