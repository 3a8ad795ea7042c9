#include "folder.h"
#include "io/obj/obj.h"
#include "math/srgb.h"
#include "same.h"

#include <cmath>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::io {
namespace {

using test::all_lines;
using test::warned;
using ::testing::ElementsAre;

struct Read {
    Result<ObjFile> file = fail(Exit::internal, "not read");
    Warnings warnings;
    const geom::PolygonMesh& mesh() const { return file->polygons; }
};

Read read(std::string_view text) {
    Read r;
    r.file = read_obj(text, "x.obj", r.warnings);
    // In parts it is the same, whatever a test is about.
    EXPECT_EQ(test::difference_in_parts(r.file, r.warnings, text,
                                        {text.size() / 40 + 1, text.size() / 7 + 3},
                                        [](std::string_view t, Warnings& w, const Reading& how) {
                                            return read_obj(t, "x.obj", w, {}, how);
                                        }),
              "");
    return r;
}

constexpr std::string_view kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string with_square(std::string_view rest) {
    return std::string(kSquare) + std::string(rest);
}

using Corners = std::vector<std::tuple<int, int, int>>;

Corners corners(const geom::PolygonMesh& m) {
    Corners out;
    for (const geom::Corner& c : m.corners)
        out.emplace_back(c.position, c.uv, c.normal);
    return out;
}

// Everything a reader could get wrong, in one comparable value.
std::string described(std::string_view text) {
    const Read r = read(text);
    if (!r.file) return r.file.error().what;
    const geom::PolygonMesh& m = r.mesh();
    std::string out;
    for (const DVec3& p : m.positions)
        out += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    for (const DVec2& p : m.uvs)
        out += fmt::format("vt {} {}\n", p.x, p.y);
    for (const Vec3& p : m.normals)
        out += fmt::format("vn {} {} {}\n", p.x, p.y, p.z);
    for (const Vec3& p : m.colours)
        out += fmt::format("c {} {} {}\n", p.x, p.y, p.z);
    for (std::size_t f = 0; f < m.faces(); ++f) {
        out += fmt::format("f {} m{}:", m.face_begin[f], m.face_material[f]);
        for (std::size_t i = m.face_begin[f]; i < m.face_end(f); ++i)
            out += fmt::format(" {}/{}/{}", m.corners[i].position, m.corners[i].uv,
                               m.corners[i].normal);
        out += "\n";
    }
    out += fmt::format("s {}\nl {} {}\np {}\n", fmt::join(m.face_smoothing, " "),
                       fmt::join(m.line_begin, " "), fmt::join(m.line_vertices, " "),
                       fmt::join(m.point_vertices, " "));
    for (const NameAtLine& n : r.file->materials)
        out += "usemtl " + n.name + "\n";
    for (const NameAtLine& n : r.file->libraries)
        out += "mtllib " + n.name + "\n";
    return out;
}

constexpr std::string_view kEverything = R"(# a comment
mtllib some file.mtl
o object
v 0 0 0
v 1.5 0 0
v 1 1 -2e-3
v 0 1 0
vt 0 0
vt 1 0.25
vn 0 0 1
g group
usemtl red paint
s 1
f 1/1/1 2/2/1 3/1/1 4/2/1
f 1//1 2//1 3//1
usemtl blue
s off
f 1/1 2/2 3/1
f 1 2 3
l 1 2 3
p 1 2
)";

std::string replaced(std::string text, std::string_view what, std::string_view by) {
    for (std::size_t i = text.find(what); i != std::string::npos;
         i = text.find(what, i + by.size()))
        text.replace(i, what.size(), by);
    return text;
}

TEST(Obj, ReadsEveryStatement) {
    const Read r = read(kEverything);
    ASSERT_TRUE(r.file) << r.file.error().what;
    EXPECT_EQ(all_lines(r.warnings), "");
    const geom::PolygonMesh& m = r.mesh();
    ASSERT_EQ(m.positions.size(), 4u);
    EXPECT_EQ(m.positions[2], DVec3(1, 1, -2e-3));
    EXPECT_EQ(m.uvs[1], DVec2(1, 0.25));
    EXPECT_EQ(m.normals[0], Vec3(0, 0, 1));
    EXPECT_THAT(m.face_begin, ElementsAre(0, 4, 7, 10));
    EXPECT_EQ(corners(m), (Corners{{0, 0, 0},
                                   {1, 1, 0},
                                   {2, 0, 0},
                                   {3, 1, 0},
                                   {0, -1, 0},
                                   {1, -1, 0},
                                   {2, -1, 0},
                                   {0, 0, -1},
                                   {1, 1, -1},
                                   {2, 0, -1},
                                   {0, -1, -1},
                                   {1, -1, -1},
                                   {2, -1, -1}}));
    EXPECT_THAT(m.face_material, ElementsAre(0, 0, 1, 1));
    EXPECT_THAT(m.face_smoothing, ElementsAre(1, 1, 0, 0));
    EXPECT_THAT(m.line_vertices, ElementsAre(0, 1, 2));
    EXPECT_THAT(m.line_material, ElementsAre(1));
    EXPECT_THAT(m.point_vertices, ElementsAre(0, 1));
    EXPECT_EQ(r.file->materials[0].name, "red paint");
    EXPECT_EQ(r.file->materials[0].line, 12u);
    EXPECT_EQ(r.file->libraries[0].name, "some file.mtl");
}

TEST(Obj, LineEndsAndBlanksDoNotChangeWhatIsRead) {
    const std::string text(kEverything);
    const std::string expected = described(text);
    EXPECT_EQ(described(replaced(text, "\n", "\r\n")), expected) << "CRLF";
    EXPECT_EQ(described(replaced(text, "\n", "\r")), expected) << "CR alone";
    EXPECT_EQ(described(replaced(text, "\n", "\n\n \t\n")), expected) << "empty lines";
    EXPECT_EQ(described(replaced(text, "\n", " \t\n")), expected) << "blanks at the end";
    EXPECT_EQ(described(replaced(text, "\n", "\n \t ")), expected) << "blanks at the start";
    EXPECT_EQ(described(replaced(text, " 1", "\t  1")), expected) << "tabs";
    EXPECT_EQ(described("\xef\xbb\xbf" + text), expected) << "byte-order mark";
    EXPECT_EQ(described(text.substr(0, text.size() - 1)), expected) << "no line end at the end";
    EXPECT_EQ(described(replaced(text, " 1", " \\\n 1")), expected) << "continuation lines";
    EXPECT_EQ(described(replaced(text, " 1", " \\\r\n1")), expected) << "continuation lines, CRLF";
    EXPECT_EQ(described(replaced(text, " 1", "\\ \n 1")), expected)
        << "blanks behind the backslash";
    EXPECT_EQ(described(replaced(text, "v 0 0 0\n", "v 0 0 0 # note\n")), expected)
        << "comment behind";
}

// What is cut out of a file takes nothing with it but its own line: the rest is read as before.
RC_GTEST_PROP(Obj, AnyFileOfBytesIsReadWithoutAnIndexOutOfRange, ()) {
    static constexpr std::string_view kPieces[] = {"v ",        "vt ",
                                                   "vn ",       "f ",
                                                   "l ",        "p ",
                                                   "s ",        "usemtl ",
                                                   "mtllib ",   "\n",
                                                   "\r",        "\\",
                                                   "/",         "//",
                                                   " ",         "1",
                                                   "-1",        "2",
                                                   "0",         "3",
                                                   "-3",        "1e400",
                                                   "nan",       "#MRGB ff00ff00",
                                                   "#",         "999999999999",
                                                   "off",       ".5",
                                                   "surf",      "\"",
                                                   "\t",        "-",
                                                   "v 1 2 3\n", "v 1 2 3 .1 .2 .3\n",
                                                   "f 1 2 3\n", "f 1/1/1 2/2/2 3//3\n"};
    const auto choice = *rc::gen::container<std::vector<std::size_t>>(
        rc::gen::inRange<std::size_t>(0, std::size(kPieces)));
    std::string text = "v 0 0 0\n";
    for (const std::size_t c : choice)
        text += kPieces[c];
    text += '\0';
    const Read r = read(text);
    if (!r.file) return;
    const geom::PolygonMesh& m = r.mesh();
    RC_ASSERT(m.face_material.size() == m.faces());
    RC_ASSERT(m.face_smoothing.empty() || m.face_smoothing.size() == m.faces());
    RC_ASSERT(m.colours.empty() || m.colours.size() == m.positions.size());
    RC_ASSERT(m.line_material.size() == m.line_begin.size());
    RC_ASSERT(m.point_material.size() == m.point_vertices.size());
    for (std::size_t f = 0; f < m.faces(); ++f)
        RC_ASSERT(m.face_end(f) >= m.face_begin[f] + 3);
    for (const geom::Corner& c : m.corners) {
        RC_ASSERT(c.position >= 0 && static_cast<std::size_t>(c.position) < m.positions.size());
        RC_ASSERT(c.uv >= -1 && c.uv < static_cast<int>(m.uvs.size()));
        RC_ASSERT(c.normal >= -1 && c.normal < static_cast<int>(m.normals.size()));
    }
    for (const std::uint32_t v : m.line_vertices)
        RC_ASSERT(v < m.positions.size());
    for (const std::uint32_t v : m.point_vertices)
        RC_ASSERT(v < m.positions.size());
}

RC_GTEST_PROP(Obj, NegativeIndicesNameTheSameVerticesAsPositiveOnes, ()) {
    const int vertices = *rc::gen::inRange(3, 50);
    std::string positive, negative;
    for (int i = 1; i <= vertices; ++i) {
        const std::string v = fmt::format("v {} 0 0\nvt {} 0\nvn {} 0 1\n", i, i, i);
        positive += v;
        negative += v;
        if (i < 3) continue;
        positive += "f";
        negative += "f";
        for (int k = 0; k < 3; ++k) {
            const int index = *rc::gen::inRange(1, i + 1), back = index - i - 1;
            positive += fmt::format(" {}/{}/{}", index, index, index);
            negative += fmt::format(" {}/{}/{}", back, back, back);
        }
        positive += "\n";
        negative += "\n";
    }
    RC_ASSERT(described(positive) == described(negative));
}

TEST(Obj, AFaceMayNameVerticesThatComeLater) {
    const Read r =
        read("f 1/1/1 2/1/1 3/1/1\nl 1 2\np 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n");
    ASSERT_TRUE(r.file);
    EXPECT_EQ(all_lines(r.warnings), "");
    EXPECT_EQ(corners(r.mesh()), (Corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
}

// HARD-CASES 61
TEST(Obj, IndicesThatNameNothingCostTheirElementAndNoOther) {
    for (const char* bad : {"0",
                            "5",
                            "-5",
                            "2147483647",
                            "2147483648",
                            "4294967297",
                            "-2147483648",
                            "-4294967297",
                            "9223372036854775807",
                            "-9223372036854775808",
                            "18446744073709551617",
                            "99999999999999999999999",
                            "x",
                            "1x",
                            "1.5",
                            "/1",
                            "//1",
                            "1/x",
                            "1/1/x",
                            "--1",
                            "-",
                            "1/1/1/1"}) {
        const Read r =
            read(with_square(fmt::format("vt 0 0\nvn 0 0 1\nusemtl a\nf 1 2 3\nf 1 2 {} 4\n"
                                         "l 1 {}\np {}\nusemtl b\nf 2 3 4\nl 1 2\np 4\n",
                                         bad, bad, bad)));
        ASSERT_TRUE(r.file) << bad;
        EXPECT_EQ(
            corners(r.mesh()),
            (Corners{{0, -1, -1}, {1, -1, -1}, {2, -1, -1}, {1, -1, -1}, {2, -1, -1}, {3, -1, -1}}))
            << bad;
        EXPECT_THAT(r.mesh().face_begin, ElementsAre(0, 3)) << bad;
        EXPECT_THAT(r.mesh().face_material, ElementsAre(0, 1)) << bad;
        EXPECT_THAT(r.mesh().line_vertices, ElementsAre(0, 1)) << bad;
        EXPECT_THAT(r.mesh().line_material, ElementsAre(1)) << bad;
        EXPECT_THAT(r.mesh().point_vertices, ElementsAre(3)) << bad;
        EXPECT_EQ(r.file->skipped, 3u) << bad;
        EXPECT_TRUE(warned(r.warnings, {"x.obj:9: ", "vertex"})) << bad << all_lines(r.warnings);
    }
}

TEST(Obj, FacesThatPointPastTheEndLeaveSmoothingAndMaterialsInStep) {
    const Read r = read(
        with_square("s 1\nusemtl a\nf 1 2 9\ns 2\nusemtl b\nf 1 2 3\nf 1 2 8\ns 3\nf 2 3 4\n"));
    ASSERT_TRUE(r.file);
    EXPECT_THAT(r.mesh().face_smoothing, ElementsAre(2, 3));
    EXPECT_THAT(r.mesh().face_material, ElementsAre(1, 1));
    EXPECT_THAT(r.mesh().face_begin, ElementsAre(0, 3));
    EXPECT_TRUE(warned(r.warnings, {"x.obj:7: the face wants vertex 9, the file has 4", "1 more"}));
}

TEST(Obj, WhatUsesAVertexThatCouldNotBeReadIsSkippedWithItsLine) {
    for (const char* bad : {"nan 0 0", "0 inf 0", "0 0 -1e400", "0 0"}) {
        const Read r = read(with_square(
            fmt::format("f 1 2 3\nv {}\nf 1 2 3 5\nl 1 5\np 1 5\nf 5 1 6\nl 1 2\nf 2 5 3\n"
                        "l 5 2 3\np 2 -2\nv 2 2 2\nv 3 3 3\nf 4 6 7\n",
                        bad)));
        ASSERT_TRUE(r.file) << bad;
        EXPECT_EQ(
            corners(r.mesh()),
            (Corners{{0, -1, -1}, {1, -1, -1}, {2, -1, -1}, {3, -1, -1}, {5, -1, -1}, {6, -1, -1}}))
            << bad;
        EXPECT_THAT(r.mesh().line_vertices, ElementsAre(0, 1)) << bad;
        EXPECT_THAT(r.mesh().point_vertices, ElementsAre(0, 1, 3)) << bad;
        EXPECT_EQ(r.file->skipped, 1u + 3 + 2 + 1) << bad;
        EXPECT_TRUE(warned(r.warnings, {"x.obj:7: the face uses vertex 5, which is not three "
                                        "finite numbers; skipped (and 2 more like it)"}))
            << all_lines(r.warnings);
        EXPECT_TRUE(warned(r.warnings, {"x.obj:8: the line uses vertex 5", "1 more"}));
        EXPECT_TRUE(warned(r.warnings, {"x.obj:9: the point uses vertex 5"}));
    }
}

// What points ahead is judged at the end of the file, after what stands behind it.
TEST(Obj, TheLineThatIsToldIsTheLowestOfItsKind) {
    const Read r = read(with_square("v 5 nan 5\nf 1 2 9\nf 1 2 3\nf 0 1 2\nl 1 9\nl 0 1\np 9\np 0\n"
                                    "f 1 2 x\nbogus\n"));
    ASSERT_TRUE(r.file);
    EXPECT_EQ(r.file->skipped, 9u);
    EXPECT_EQ(all_lines(r.warnings),
              "x.obj:5: 'nan' is not a finite number; this vertex is not used\n"
              "x.obj:6: the face wants vertex 9, the file has 5; skipped (and 2 more like it)\n"
              "x.obj:9: the line wants vertex 9, the file has 5; skipped (and 1 more like it)\n"
              "x.obj:11: the point wants vertex 9, the file has 5; skipped (and 1 more like it)\n"
              "x.obj:14: 'bogus' is no statement that OBJ readers know; skipped\n");
}

TEST(Obj, TextureCoordinatesAndNormalsThatDoNotExistAreLeftAway) {
    const Read r = read(with_square("vt 0 0\nvn 0 0 1\nf 1/9/1 2/1/9 3/0/-2\nf 1// 2/1/ 3//\n"));
    ASSERT_TRUE(r.file);
    EXPECT_EQ(corners(r.mesh()),
              (Corners{{0, -1, 0}, {1, 0, -1}, {2, -1, -1}, {0, -1, -1}, {1, 0, -1}, {2, -1, -1}}));
    EXPECT_EQ(r.file->skipped, 0u);
    EXPECT_EQ(r.warnings.lines().size(), 3u) << all_lines(r.warnings);
}

TEST(Obj, FacesOfFewerThanThreeCornersAreSkipped) {
    const Read r = read(with_square("f\nf 1\nf 1 2\nf 1 2 3\nl\nl 1\n"));
    ASSERT_TRUE(r.file);
    EXPECT_EQ(r.mesh().faces(), 1u);
    EXPECT_EQ(r.file->skipped, 5u);
    EXPECT_TRUE(warned(r.warnings, {"x.obj:5: a face needs 3 corners, this one has 0", "2 more"}));
}

TEST(Obj, AVertexThatCannotBeReadKeepsItsNumber) {
    for (const char* bad : {"v nan 0 0", "v 0 inf 0", "v 1 2", "v", "v 1,5 0 0", "v 0x1p3 0 0",
                            "v 1e400 0 0", "v 1 2 1.#IND"}) {
        const Read r = read(fmt::format("v 0 0 0\n{}\nv 1 0 0\nv 0 1 0\nf 1 3 4\nf 2 3 4\n", bad));
        ASSERT_TRUE(r.file) << bad;
        ASSERT_EQ(r.mesh().positions.size(), 4u) << bad;
        EXPECT_TRUE(std::isnan(r.mesh().positions[1].x)) << bad;
        EXPECT_EQ(r.mesh().positions[2], DVec3(1, 0, 0)) << bad;
        EXPECT_EQ(r.file->skipped, 2u) << bad; // the vertex and the face that uses it
        EXPECT_TRUE(warned(r.warnings, {"x.obj:2: ", "vertex"})) << all_lines(r.warnings);
    }
}

TEST(Obj, BadTextureCoordinatesAndNormalsKeepTheirNumbersToo) {
    const Read r = read(with_square(
        "vt nan 0\nvt 0.5\nvt 1 2 3\nvn 1 inf 0\nvn 1e300 0 0\nvn 0 1e-300 0\nf 1 2 3\n"));
    ASSERT_TRUE(r.file);
    EXPECT_THAT(r.mesh().uvs, ElementsAre(DVec2(0), DVec2(0.5, 0), DVec2(1, 2)));
    EXPECT_THAT(r.mesh().normals, ElementsAre(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)));
    EXPECT_EQ(r.file->skipped, 2u);
}

TEST(Obj, VertexColoursAreDisplayValuesAndVerticesWithoutAreWhite) {
    const Read r =
        read("v 0 0 0\nv 1 0 0 0.25 0.5 1\nv 0 1 0 7\nv 0 2 0 nan 0 0\nv 3 3 3 -1 2 0\nf 1 2 3\n");
    ASSERT_TRUE(r.file);
    const auto linear = [](double x) { return static_cast<float>(linear_light_of_srgb(x)); };
    EXPECT_THAT(r.mesh().colours, ElementsAre(Vec3(1), Vec3(linear(0.25), linear(0.5), 1), Vec3(1),
                                              Vec3(1), Vec3(0, 1, 0)));
    EXPECT_EQ(r.mesh().positions[3], DVec3(0, 2, 0));
    EXPECT_TRUE(warned(r.warnings, {"x.obj:4: 'nan'", "stays white"}));
    EXPECT_TRUE(read(kSquare).mesh().colours.empty());
    EXPECT_TRUE(read("v 0 0 0 1\nv 1 0 0 0.5\nv 1 1 1 1\nf 1 2 3\n").mesh().colours.empty())
        << "a fourth number alone is a weight";
}

TEST(Obj, ZBrushPolypaintIsDecodedFromDisplayCodes) {
    const Read r = read("v 0 0 0\nv 1 0 0\nv 0 1 0\n#MRGB ff00ff80FFffffff\nf 1 2 3\n");
    ASSERT_TRUE(r.file);
    EXPECT_THAT(r.mesh().colours, ElementsAre(Vec3(0, 1, srgb_decode(0x80)), Vec3(1), Vec3(1)));
}

TEST(Obj, CommentsMayHoldAnyBytes) {
    // GBK: the second byte of a character may be a backslash; it must not swallow the next line.
    EXPECT_EQ(described("# \xb2\xe2\xca\x5c\nv 1 2 3\nv 4 5 6\nv 7 8 9\nf 1 2 3\n# \xff\xfe\x80"),
              described("v 1 2 3\nv 4 5 6\nv 7 8 9\nf 1 2 3\n"));
}

TEST(Obj, NulBytesReadAsBlanks) {
    using namespace std::string_view_literals;
    const Read r = read("v 0 0 0\nv\0 1 0 0\nv 0 1 0\nf 1 2\0 3\n\0\0\0\0\n"sv);
    ASSERT_TRUE(r.file);
    EXPECT_EQ(r.mesh().faces(), 1u);
    EXPECT_EQ(r.mesh().positions[1], DVec3(1, 0, 0));
    EXPECT_TRUE(warned(r.warnings, {"x.obj:2: ", "NUL"}));
}

TEST(Obj, FreeFormStatementsAreNamedInOneLineAndTheirContinuationsAreNotStatements) {
    const Read r = read(with_square(
        "cstype bezier\ndeg 3 3\nsurf 0 1 0 1 1 2 \\\nf 3 4\nparm u 0 1\nend\nf 1 2 3\n"));
    ASSERT_TRUE(r.file);
    EXPECT_EQ(r.mesh().faces(), 1u);
    EXPECT_EQ(r.file->skipped, 5u);
    EXPECT_EQ(all_lines(r.warnings),
              "x.obj:5: free-form curves and surfaces (cstype, deg, surf, parm, end) "
              "are not supported and left out\n");
}

TEST(Obj, VerticesAloneAreShownAsPoints) {
    const Read r = read("v 0 0 0\nv nan 0 0\nv 1 0 0\n");
    ASSERT_TRUE(r.file);
    EXPECT_THAT(r.mesh().point_vertices, ElementsAre(0, 2));
    EXPECT_THAT(r.mesh().point_material, ElementsAre(-1, -1));
    EXPECT_TRUE(warned(r.warnings, {"shown as points"}));
}

TEST(Obj, FacesThatCannotBeDrawnLeaveTheVerticesAsPoints) {
    EXPECT_EQ(read(with_square("f 1 2 9\n")).mesh().point_vertices.size(), 4u);
    EXPECT_EQ(read("v 0 0 0\nv 1 0 0\nv nan 0 0\nf 1 2 3\nl 1 3\n").mesh().point_vertices.size(),
              2u);
    EXPECT_EQ(read("v 0 0 0\nv 1 0 0\nv nan 0 0\nf 1 2 3\nl 1 2\n").mesh().point_vertices.size(),
              0u);
}

TEST(Obj, WhatIsNoObjIsRefusedByName) {
    using namespace std::string_view_literals;
    const auto reason = [](std::string_view text) {
        const Read r = read(text);
        EXPECT_FALSE(r.file);
        EXPECT_EQ(r.file.error().exit, Exit::unreadable);
        EXPECT_EQ(r.file.error().what.find("x.obj: "), 0u) << r.file.error().what;
        EXPECT_EQ(r.file.error().what.find('\n'), std::string::npos);
        return r.file.error().what;
    };
    using ::testing::HasSubstr;
    EXPECT_THAT(reason(""), HasSubstr("empty"));
    EXPECT_THAT(reason("\n\n\n  \n"), HasSubstr("no vertices"));
    EXPECT_THAT(reason("# only a comment"), HasSubstr("no vertices"));
    EXPECT_THAT(reason("v nan nan nan\nv 1\n"), HasSubstr("none of its 2 vertices"));
    EXPECT_THAT(reason("\xff\xfev\0 \0000\0"sv), HasSubstr("UTF-16"));
    EXPECT_THAT(reason("v\0 \0001\0 \0002\0 \0003\0\n\0v\0 \0004\0"sv), HasSubstr("UTF-16"));
    EXPECT_THAT(reason("version https://git-lfs.github.com/spec/v1\noid sha256:1\n"),
                HasSubstr("git lfs pull"));
    EXPECT_THAT(reason("<!DOCTYPE html>\n<html>"), HasSubstr("HTML"));
    EXPECT_THAT(reason("\n  <html><body>v 1 2 3"), HasSubstr("HTML"));
    EXPECT_THAT(reason("\x89PNG\r\n\x1a\n"), HasSubstr("PNG"));
    EXPECT_THAT(reason("\x1f\x8b\x08"), HasSubstr("gunzip"));
    EXPECT_THAT(reason(std::string(5000, '\0')), HasSubstr("zero bytes"));
}

TEST(Obj, MessagesShowNoControlCharactersOfTheFile) {
    const Read r = read(with_square("f 1 2 \x1b[2Jx\x07\n\x1b]0;title\x07 1\nvt \xc2\x9b"
                                    "1 2\nusemtl \x1b[31m\nf 1 2 3\n"));
    ASSERT_TRUE(r.file);
    EXPECT_GE(r.warnings.lines().size(), 3u);
    for (const char c : replaced(all_lines(r.warnings), "\n", ""))
        EXPECT_GE(static_cast<unsigned char>(c), 0x20) << all_lines(r.warnings);
    EXPECT_EQ(all_lines(r.warnings).find('\x9b'), std::string::npos);
}

TEST(Obj, AMillionBadLinesAreOneWarning) {
    std::string text(kSquare);
    for (int i = 0; i < 100000; ++i)
        text += fmt::format("bad{} 1 2 3\nf 1 2 x{}\n", i, i);
    const Read r = read(text);
    ASSERT_TRUE(r.file);
    EXPECT_EQ(r.file->skipped, 200000u);
    EXPECT_EQ(r.warnings.lines().size(), 3u) << all_lines(r.warnings).substr(0, 1000);
    EXPECT_TRUE(warned(r.warnings, {"x.obj:5: 'bad0'", "99999 more"}));
}

TEST(Obj, ProgressRisesAndCancelling) {
    std::string text(kSquare);
    while (text.size() < 5'000'000)
        text += "f 1 2 3 4\n";
    Warnings warnings;
    std::vector<double> shares;
    const auto whole = read_obj(text, "x.obj", warnings, [&](double share) {
        shares.push_back(share);
        return true;
    });
    ASSERT_TRUE(whole);
    EXPECT_GE(shares.size(), 5u);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_LE(shares.back(), 1);
    int calls = 0;
    const auto cancelled = read_obj(text, "x.obj", warnings, [&](double) { return ++calls < 3; });
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().what, "x.obj: loading was cancelled");
    EXPECT_EQ(calls, 3);
}

TEST(Obj, AFaceOfAMillionCornersIsOneFaceAndReportsProgress) {
    std::string text(kSquare);
    text += "f";
    for (int i = 0; i < 1'000'000; ++i)
        text += " 1 2 3";
    Warnings warnings;
    int calls = 0;
    const auto file = read_obj(text, "x.obj", warnings, [&](double) { return ++calls > 0; });
    ASSERT_TRUE(file);
    EXPECT_EQ(file->polygons.faces(), 1u);
    EXPECT_EQ(file->polygons.corners.size(), 3'000'000u);
    EXPECT_GE(calls, 5);
}

} // namespace
} // namespace scanout::io
