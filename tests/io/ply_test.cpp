#include "io/ply/ply.h"
#include "io/vertex_colours.h"
#include "math/srgb.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct PlyRead {
    Result<PlyFile> result;
    std::string warnings;

    const geom::PolygonMesh& mesh() const { return result->polygons; }
    std::string error() const { return result ? "no error" : result.error().what; }
};

PlyRead read_ply_text(std::string_view file) {
    Warnings warnings;
    auto result = read_ply(file, "a.ply", warnings, nullptr);
    return {std::move(result), fmt::format("{}", fmt::join(warnings.lines(), "\n"))};
}

const std::string kPlySquare = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                               "property float y\nproperty float z\nelement face 1\n"
                               "property list uchar int vertex_indices\nend_header\n"
                               "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";

std::string with_other(std::string text, std::string_view from, std::string_view to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::vector<std::int32_t> corner_positions(const geom::PolygonMesh& m) {
    std::vector<std::int32_t> indices;
    for (const geom::Corner& c : m.corners)
        indices.push_back(c.position);
    return indices;
}

template <class T>
void append_value(std::string& bytes, T value, bool big_endian) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T)); // this test runs on little-endian machines
    if (big_endian) std::reverse(raw, raw + sizeof(T));
    bytes.append(raw, sizeof(T));
}

TEST(Ply, ReadsPolygonsOfText) {
    const PlyRead r = read_ply_text(kPlySquare);
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.warnings, "");
    EXPECT_THAT(r.mesh().positions,
                ElementsAre(DVec3(0), DVec3(1, 0, 0), DVec3(1, 1, 0), DVec3(0, 1, 0)));
    EXPECT_THAT(corner_positions(r.mesh()), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(r.mesh().face_begin, ElementsAre(0));
    EXPECT_TRUE(r.mesh().point_vertices.empty());
}

// The same model in every type a value can have, in both byte orders, faces before vertices,
// properties out of order, and one that nobody knows between them.
TEST(Ply, ReadsEveryTypeInBothByteOrders) {
    for (const bool big : {false, true}) {
        std::string file = fmt::format(
            "ply\nformat binary_{}_endian 1.0\nelement face 1\nproperty list ushort uint8 "
            "vertex_index\nproperty uint32 flags\nelement vertex 3\nproperty short z\nproperty "
            "double x\nproperty list uchar double extra\nproperty int8 y\nend_header\n",
            big ? "big" : "little");
        append_value<std::uint16_t>(file, 3, big);
        for (const char index : {2, 0, 1})
            file += index;
        append_value<std::uint32_t>(file, 0xffffffff, big);
        for (int i = 0; i < 3; ++i) {
            append_value<std::int16_t>(file, static_cast<std::int16_t>(-300 * i), big);
            append_value<double>(file, 0.1 * i, big);
            file += static_cast<char>(i);
            for (int k = 0; k < i; ++k)
                append_value<double>(file, 7, big);
            file += static_cast<char>(-i);
        }
        const PlyRead r = read_ply_text(file);
        ASSERT_TRUE(r.result) << r.error();
        EXPECT_EQ(r.warnings, "");
        EXPECT_THAT(r.mesh().positions,
                    ElementsAre(DVec3(0), DVec3(0.1, -1, -300), DVec3(0.2, -2, -600)));
        EXPECT_THAT(corner_positions(r.mesh()), ElementsAre(2, 0, 1));
    }
}

// As scanners write them: rows of fixed size, decoded on all threads.
TEST(Ply, TheResultDoesNotDependOnTheNumberOfThreads) {
    constexpr std::size_t kVertices = 20000;
    std::string file =
        fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\n"
                    "property float y\nproperty float z\nproperty uchar red\nproperty uchar "
                    "green\nproperty uchar blue\nend_header\n",
                    kVertices);
    for (std::size_t i = 0; i < kVertices; ++i) {
        for (const std::size_t v : {i, i * i % 1009, i % 7})
            append_value<float>(file, static_cast<float>(v), false);
        for (const int shift : {0, 4, 8})
            file += static_cast<char>(i >> shift & 0xff);
    }
    Warnings warnings;
    Jobs jobs(3);
    const Reading how{&jobs};
    const auto one = read_ply(file, "a.ply", warnings, nullptr);
    const auto three = read_ply(file, "a.ply", warnings, nullptr, how);
    ASSERT_TRUE(one && three);
    ASSERT_EQ(one->polygons.positions.size(), kVertices);
    EXPECT_EQ(one->polygons.positions, three->polygons.positions);
    EXPECT_EQ(one->polygons.colours, three->polygons.colours);
    EXPECT_EQ(one->polygons.positions[12345], DVec3(12345, 12345 * 12345 % 1009, 12345 % 7));
    EXPECT_EQ(one->polygons.colours[0x123],
              Vec3(srgb_decode(std::uint8_t{0x23}), srgb_decode(std::uint8_t{0x12}),
                   srgb_decode(std::uint8_t{0x01})));
    EXPECT_EQ(one->polygons.point_vertices.size(), kVertices);
}

TEST(Ply, HeadersEndWithAnyLineEndAndABinaryBodyMayBeginWithOne) {
    const std::string head = "ply{0}format binary_little_endian 1.0{0}element vertex 1{0}property "
                             "uchar x{0}property uchar y{0}property uchar z{0}end_header{0}";
    for (const char* end : {"\n", "\r\n", "\r"}) {
        const PlyRead r = read_ply_text(fmt::format(fmt::runtime(head), end) + "\n\r\n");
        ASSERT_TRUE(r.result) << r.error();
        EXPECT_THAT(r.mesh().positions, ElementsAre(DVec3(10, 13, 10)));
    }
}

TEST(Ply, NormalsTextureCoordinatesAndColoursBelongToVertices) {
    const PlyRead r =
        read_ply_text("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float "
                      "y\nproperty float z\nproperty float nx\nproperty float ny\nproperty float "
                      "nz\nproperty float s\nproperty float t\nproperty uchar red\nproperty "
                      "uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int "
                      "vertex_indices\nend_header\n0 0 0 0 0 1 0 0 255 0 128\n1 0 0 0 0 1 1 0 0 "
                      "0 0\n0 1 0 0 1 0 0.5 1 0 0 0\n3 0 1 2\n");
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().normals[2], Vec3(0, 1, 0));
    EXPECT_EQ(r.mesh().uvs[2], DVec2(0.5, 1));
    EXPECT_EQ(r.mesh().colours[0], Vec3(1, 0, srgb_decode(std::uint8_t{128})));
    EXPECT_EQ(r.mesh().corners[2].normal, 2);
    EXPECT_EQ(r.mesh().corners[2].uv, 2);
}

TEST(Ply, FacesHaveTextureCoordinatesTexturesAndColoursOfTheirOwn) {
    const PlyRead r = read_ply_text(
        "ply\nformat ascii 1.0\ncomment TextureFile my skin.png\ncomment TextureFile b.png\n"
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 3\n"
        "property list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int "
        "texnumber\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 0 1 0 0 1 1 9 9 9\n3 2 1 0 0 -1 255 0 0\n3 0 2 1 0 -1 "
        "255 0 0\n");
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.result->textures[0].name, "my skin.png");
    EXPECT_EQ(r.result->textures[1].line, 4u);
    EXPECT_THAT(r.mesh().uvs, ElementsAre(DVec2(0), DVec2(1, 0), DVec2(0, 1)));
    EXPECT_EQ(r.mesh().corners[1].uv, 1);
    EXPECT_EQ(r.mesh().corners[3].uv, -1);
    EXPECT_THAT(r.mesh().face_material, ElementsAre(1, 2, 2));
    ASSERT_EQ(r.result->face_colours.size(), 1u);
    EXPECT_EQ(r.result->face_colours.materials()[0].diffuse, Vec3(1, 0, 0));
}

TEST(Ply, StripsTurnEveryOtherTriangleAndMinusOneBeginsAnewOne) {
    const PlyRead r =
        read_ply_text("ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float "
                      "y\nproperty float z\nelement tristrips 1\nproperty list int int "
                      "vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 0 0\n2 1 "
                      "0\n8 0 1 2 3 -1 3 1 4\n");
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_THAT(corner_positions(r.mesh()), ElementsAre(0, 1, 2, 2, 1, 3, 3, 1, 4));
}

TEST(Ply, EdgesAreLines) {
    const PlyRead r =
        read_ply_text("ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float "
                      "y\nproperty float z\nelement edge 2\nproperty int vertex1\nproperty int "
                      "vertex2\nend_header\n0 0 0\n1 0 0\n0 1\n0 7\n");
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_THAT(r.mesh().line_vertices, ElementsAre(0, 1));
    EXPECT_THAT(r.warnings, HasSubstr("a.ply:14: its vertices are not there"));
    EXPECT_TRUE(r.mesh().point_vertices.empty());
}

TEST(Ply, GaussianSplatsAreTheirPoints) {
    const PlyRead r =
        read_ply_text("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
                      "y\nproperty float z\nproperty float f_dc_0\nproperty float f_dc_1\n"
                      "property float f_dc_2\nproperty float opacity\nend_header\n1 2 3 0 100 "
                      "-100 1\n");
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().colours[0], Vec3(static_cast<float>(linear_light_of_srgb(0.5)), 1, 0));
    EXPECT_THAT(r.warnings, HasSubstr("Gaussian splats are shown as their points"));
}

// A fault costs its row and one line with its place.
TEST(Ply, WhatIsWrongWithARowLeavesTheOthers) {
    const struct {
        const char *from, *to, *warning;
        std::size_t faces;
    } kCases[] = {
        {"4 0 1 2 3", "4 0 1 2 4", "a.ply:14: there is no vertex 4 (the header tells of 4)", 0},
        {"4 0 1 2 3", "4 0 1 2 -1", "a.ply:14: there is no vertex -1", 0},
        {"4 0 1 2 3", "4 0 1 2 0.5", "a.ply:14: there is no vertex 0.5", 0},
        {"4 0 1 2 3", "4 0 1 2 1e30", "a.ply:14: there is no vertex", 0},
        {"4 0 1 2 3", "5 0 1 2 3", "a.ply:14: the line ends too early", 0},
        {"4 0 1 2 3", "2 0 1", "a.ply:14: a face of 2 corners", 0},
        {"4 0 1 2 3", "255 0 1 2", "a.ply:14: a list of 255 entries", 0},
        {"4 0 1 2 3", "-4 0 1 2 3", "a.ply:14: a list of -4 entries", 0},
        {"4 0 1 2 3", "4 0 1 two 3", "a.ply:14: 'two' is not a finite number", 0},
        {"4 0 1 2 3", "4 0 1 2 3 9", "a.ply:14: more numbers than the header tells", 1},
        {"face 1", "face 4000000000", "the file ends in face 2 of 4000000000", 1},
        {"1 1 0\n", "1 nan 0\n", "a.ply:12: 'nan' is not a finite number", 1},
        {"vertex 4", "vertex 5", "the file ends in face 1 of 1", 0},
        {"format ascii 1.0", "format ascii 1.1", "a.ply:2: version '1.1'", 1},
        {"element face", "Created by a program\nelement face", "a.ply:7: 'Created' is no statement",
         1},
        {"property float z", "property float z\nproperty list uchar int extra", "", 1},
        {"property float z", "property float z w", "a.ply:6: 'w' behind the property's", 1},
    };
    for (const auto& c : kCases) {
        const PlyRead r = read_ply_text(with_other(kPlySquare, c.from, c.to));
        ASSERT_TRUE(r.result) << c.to << ": " << r.error();
        EXPECT_EQ(r.mesh().faces(), c.faces) << c.to;
        EXPECT_THAT(r.warnings, HasSubstr(c.warning)) << c.to;
    }
}

TEST(Ply, AFileThatCannotBeReadSaysWhy) {
    const struct {
        const char *from, *to, *error;
    } kCases[] = {
        {"ply\n", "plx\n", "a.ply: not a PLY file"},
        {"end_header", "end_head", "a.ply: the header has no end ('end_header')"},
        {"format ascii", "format utf8", "a.ply:2: format 'utf8' is not known"},
        {"format ascii 1.0\n", "", "a.ply:2: 'element' stands where the 'format' line belongs"},
        {"vertex 4", "vertex -4", "a.ply:3: element 'vertex' has no count"},
        {"vertex 4", "vertex", "a.ply:3: element 'vertex' has no count"},
        {"property float x", "property half x", "a.ply:4: type 'half' is not known"},
        {"list uchar", "list float", "a.ply:8: the length of a list is no whole number"},
        {"property float z", "property float w", "a.ply: its vertices have no x, y and z"},
        {"vertex 4", "vertex 0", "a.ply: a PLY file without vertices"},
    };
    for (const auto& c : kCases) {
        const PlyRead r = read_ply_text(with_other(kPlySquare, c.from, c.to));
        ASSERT_FALSE(r.result) << c.to;
        EXPECT_EQ(r.result.error().exit, Exit::unreadable);
        EXPECT_THAT(r.error(), HasSubstr(c.error)) << c.to;
    }
}

TEST(Ply, ABinaryFileThatIsCutShortShowsItsStart) {
    std::string file = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
                       "property float y\nproperty float z\nelement face 2\nproperty list uchar "
                       "int vertex_indices\nend_header\n";
    for (const float v : {0, 0, 0, 1, 0, 0, 0, 1, 0})
        append_value<float>(file, v, false);
    const std::size_t vertices_end = file.size();
    for (int face = 0; face < 2; ++face) {
        file += '\3';
        for (const std::int32_t v : {0, 1, 2})
            append_value<std::int32_t>(file, v, false);
    }
    for (std::size_t cut = vertices_end; cut < file.size(); ++cut) {
        const PlyRead r = read_ply_text(file.substr(0, cut));
        ASSERT_TRUE(r.result) << r.error();
        EXPECT_EQ(r.mesh().faces(), (cut - vertices_end) / 13) << cut;
        EXPECT_THAT(r.warnings, HasSubstr("the file ends in face")) << cut;
    }
    const PlyRead r = read_ply_text(file.substr(0, vertices_end - 1));
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().positions.size(), 2u);
    EXPECT_THAT(r.warnings, HasSubstr("the file ends in vertex 3 of 3"));
}

RC_GTEST_PROP(Ply, AnyBytesBehindAHeaderEndInAMeshWhoseIndicesHold, ()) {
    const std::string head =
        "ply\nformat binary_little_endian 1.0\nelement face 3\nproperty list char short "
        "vertex_indices\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
        "z\nend_header\n";
    const auto bytes = *rc::gen::arbitrary<std::string>();
    const PlyRead r = read_ply_text(head + bytes);
    if (!r.result) return;
    for (const geom::Corner& c : r.mesh().corners)
        RC_ASSERT(c.position >= 0 && c.position < static_cast<int>(r.mesh().positions.size()));
    RC_ASSERT(r.mesh().face_material.size() == r.mesh().faces());
}

TEST(VertexColours, AreDisplayValuesAndBytesWhereAllAreWhole) {
    Warnings warnings;
    std::vector<Vec3> colours = {Vec3(0, 0.5F, 1),
                                 Vec3(-1, 2, std::numeric_limits<float>::quiet_NaN())};
    decode_vertex_colours(colours, "a", warnings);
    EXPECT_EQ(colours[0], Vec3(0, static_cast<float>(linear_light_of_srgb(0.5)), 1));
    EXPECT_EQ(colours[1], Vec3(0, 1, 0));
    EXPECT_TRUE(warnings.empty());
    colours = {Vec3(0, 128, 255), Vec3(1)};
    decode_vertex_colours(colours, "a", warnings);
    EXPECT_EQ(colours[0], Vec3(0, srgb_decode(std::uint8_t{128}), 1));
    EXPECT_EQ(warnings.count("vertex colours"), 1u);
}

} // namespace
} // namespace scanout::io
