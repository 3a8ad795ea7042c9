#include "io/obj/obj.h"
#include "io/obj/write_obj.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::io {
namespace {

ObjFile read_again(const std::string& text) {
    Warnings warnings;
    auto file = read_obj(text, "written.obj", warnings);
    EXPECT_TRUE(file) << (file ? "" : file.error().what);
    EXPECT_TRUE(warnings.empty()) << warnings.lines().front();
    return file ? *std::move(file) : ObjFile();
}

geom::PolygonMesh everything() {
    geom::PolygonMesh m;
    m.positions = {{0, 0, 0}, {0.1, 1e-300, -3}, {1.0 / 3, 12345678.9, 4}, {1, 1, 1}};
    m.uvs = {{0.1, 0.7}, {1.0 / 3, -2}};
    m.normals = {{0, 0.6F, 0.8F}, {1.0F / 3, 0, 0}};
    m.corners = {{0, -1, -1}, {1, -1, -1}, {2, -1, -1}, {0, 0, -1}, {2, 1, -1},
                 {3, 0, -1},  {0, -1, 0},  {1, -1, 1},  {3, -1, 0}, {0, 0, 1},
                 {1, 1, 1},   {2, 1, 0},   {3, 0, 0}};
    m.face_begin = {0, 3, 6, 9};
    m.face_material = {-1, 1, 1, 0};
    m.face_smoothing = {geom::kSmoothingUnset, 7, geom::kSmoothingOff, 2};
    m.line_vertices = {0, 1, 2, 3, 0};
    m.line_begin = {0, 3};
    m.line_material = {0, -1};
    m.point_vertices = {3, 1};
    m.point_material = {1, 1};
    return m;
}

TEST(WriteObj, IsReadAgainAsWhatWasWritten) {
    const geom::PolygonMesh m = everything();
    const std::vector<std::string> materials = {"red brick", "gl\xc3\xa4ss"};
    const ObjFile file = read_again(obj_text(m, materials, std::vector<std::string>{"a b.mtl"}));
    const geom::PolygonMesh& again = file.polygons;
    ASSERT_EQ(file.libraries.size(), 1U);
    EXPECT_EQ(file.libraries[0].name, "a b.mtl");
    EXPECT_EQ(again.positions, m.positions);
    EXPECT_EQ(again.uvs, m.uvs);
    EXPECT_EQ(again.normals, m.normals);
    EXPECT_EQ(again.face_begin, m.face_begin);
    EXPECT_EQ(again.face_smoothing, m.face_smoothing);
    for (std::size_t i = 0; i < m.corners.size(); ++i) {
        EXPECT_EQ(again.corners[i].position, m.corners[i].position) << i;
        EXPECT_EQ(again.corners[i].uv, m.corners[i].uv) << i;
        EXPECT_EQ(again.corners[i].normal, m.corners[i].normal) << i;
    }
    const auto names = [](const auto& indices, const auto& name_of) {
        std::vector<std::string> found;
        for (const std::int32_t i : indices)
            found.push_back(i < 0 ? "" : name_of(static_cast<std::size_t>(i)));
        return found;
    };
    const auto written = [&](std::size_t i) { return materials[i]; };
    const auto read = [&](std::size_t i) { return file.materials[i].name; };
    EXPECT_EQ(names(again.face_material, read), names(m.face_material, written));
    EXPECT_EQ(names(again.line_material, read), names(m.line_material, written));
    EXPECT_EQ(names(again.point_material, read), names(m.point_material, written));
    EXPECT_EQ(again.line_vertices, m.line_vertices);
    EXPECT_EQ(again.line_begin, m.line_begin);
    EXPECT_EQ(again.point_vertices, m.point_vertices);
    EXPECT_TRUE(again.colours.empty());
}

TEST(WriteObj, LeavesMaterialsWithoutANameOut) {
    const std::vector<std::string> materials = {"", ""};
    const std::string text = obj_text(everything(), materials, {});
    EXPECT_EQ(text.find("usemtl"), std::string::npos) << text;
    EXPECT_EQ(text.find("mtllib"), std::string::npos) << text;
}

TEST(WriteObj, WritesColoursAsTheDisplayShowsThem) {
    geom::PolygonMesh m = everything();
    m.colours = {{0, 0.25F, 1}, {0.001F, 0.5F, 0.75F}, {1, 1, 1}, {0.1F, 0.2F, 0.3F}};
    const ObjFile file = read_again(obj_text(m, std::vector<std::string>(2), {}));
    ASSERT_EQ(file.polygons.colours.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(file.polygons.colours[i][c], m.colours[i][c], 3e-6);
}

RC_GTEST_PROP(WriteObj, KeepsEveryBitOfPositions, (std::vector<double> numbers)) {
    geom::PolygonMesh m;
    for (const double x : numbers)
        if (std::isfinite(x)) m.positions.push_back({x, -x, x / 3});
    m.positions.push_back({1, 2, 3});
    m.point_vertices = {0};
    m.point_material = {-1};
    EXPECT_EQ(read_again(obj_text(m, {}, {})).polygons.positions, m.positions);
}

} // namespace
} // namespace scanout::io
