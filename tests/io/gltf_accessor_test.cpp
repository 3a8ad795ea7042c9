// How the bytes of a glTF file become numbers, and what is refused. Khronos 2021, 3.6.
#include "gltf_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::io {
namespace {

using test::GltfBuilder;
using test::GltfRead;
using test::read_gltf_file;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

GltfRead with_positions(GltfBuilder& b, int accessor) {
    b.primitive(fmt::format(R"("attributes":{{"POSITION":{}}})", accessor));
    return read_gltf_file(b.glb());
}

TEST(GltfAccessor, FloatsAreRead) {
    GltfBuilder b;
    const GltfRead r = with_positions(b, b.floats({1, 2, 3, 4, 5, 6, 7, 8.5F, -9}, "VEC3"));
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.warnings, "");
    EXPECT_THAT(r.mesh().positions, ElementsAre(DVec3(1, 2, 3), DVec3(4, 5, 6), DVec3(7, 8.5, -9)));
    EXPECT_EQ(r.mesh().faces(), 1u);
}

// KHR_mesh_quantization allows all of these for positions.
template <class T>
void expect_whole(int component, T most) {
    GltfBuilder b;
    const std::vector<T> values = {0, 1, 2, most, 4, 5, 6, 7, 8};
    const GltfRead plain = with_positions(b, b.accessor(values, component, "VEC3", 3));
    ASSERT_TRUE(plain.result) << plain.error();
    EXPECT_EQ(plain.mesh().positions[1], DVec3(double(most), 4, 5)) << component;
    GltfBuilder n;
    const GltfRead scaled =
        with_positions(n, n.accessor(values, component, "VEC3", 3, R"(,"normalized":true)"));
    ASSERT_TRUE(scaled.result) << scaled.error();
    EXPECT_EQ(scaled.mesh().positions[1].x, 1) << component;
    EXPECT_EQ(scaled.mesh().positions[1].y, 4 / double(most)) << component;
}

TEST(GltfAccessor, EveryTypeOfComponentIsReadWholeAndNormalised) {
    expect_whole<std::int8_t>(5120, 127);
    expect_whole<std::uint8_t>(5121, 255);
    expect_whole<std::int16_t>(5122, 32767);
    expect_whole<std::uint16_t>(5123, 65535);
    expect_whole<std::uint32_t>(5125, 4294967295U);
}

TEST(GltfAccessor, TheLeastSignedCodeIsMinusOneToo) {
    GltfBuilder b;
    const std::vector<std::int8_t> values = {-128, -127, 0, 0, 0, 0, 0, 0, 127};
    const GltfRead r =
        with_positions(b, b.accessor(values, 5120, "VEC3", 3, R"(,"normalized":true)"));
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().positions[0], DVec3(-1, -1, 0));
}

TEST(GltfAccessor, ElementsMayStandApart) {
    GltfBuilder b;
    const int view =
        b.view(std::vector<float>{0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0}, R"(,"byteStride":16)");
    const GltfRead r = with_positions(b, b.accessor(view, 5126, "VEC3", 3));
    ASSERT_TRUE(r.result) << r.error(); // the last needs no byte beyond its own
    EXPECT_THAT(r.mesh().positions, ElementsAre(DVec3(0), DVec3(1, 0, 0), DVec3(0, 1, 0)));
}

TEST(GltfAccessor, SparseElementsReplaceThoseOfTheViewOrZeros) {
    for (const bool on_view : {true, false}) {
        GltfBuilder b;
        const int base = b.view(std::vector<float>{0, 0, 0, 1, 0, 0, 5, 5, 5});
        const int indices = b.view(std::vector<std::uint16_t>{2, 1});
        const int values = b.view(std::vector<float>{0, 1, 0, 3, 0, 0});
        b.accessors.push_back(fmt::format(
            R"({{{}"componentType":5126,"type":"VEC3","count":3,"sparse":{{"count":2,"indices":{{)"
            R"("bufferView":{},"componentType":5123}},"values":{{"bufferView":{}}}}}}})",
            on_view ? fmt::format(R"("bufferView":{},)", base) : "", indices, values));
        const GltfRead r = with_positions(b, 0);
        ASSERT_TRUE(r.result) << r.error();
        EXPECT_THAT(r.mesh().positions, ElementsAre(DVec3(0), DVec3(3, 0, 0), DVec3(0, 1, 0)));
    }
}

TEST(GltfAccessor, ASparseIndexBeyondTheEndIsRefused) {
    GltfBuilder b;
    const int indices = b.view(std::vector<std::uint8_t>{3});
    const int values = b.view(std::vector<float>{0, 1, 0});
    b.accessors.push_back(fmt::format(
        R"({{"componentType":5126,"type":"VEC3","count":3,"sparse":{{"count":1,"indices":{{)"
        R"("bufferView":{},"componentType":5121}},"values":{{"bufferView":{}}}}}}})",
        indices, values));
    EXPECT_EQ(with_positions(b, 0).error(),
              "a.glb: accessors[0]: a sparse index is 3, and there are 3 elements");
    GltfBuilder more;
    more.accessors.emplace_back(
        R"({"componentType":5126,"type":"VEC3","count":3,"sparse":{"count":4,"indices":{)"
        R"("bufferView":0,"componentType":5121},"values":{"bufferView":0}}})");
    more.view(std::vector<float>{0, 1, 0});
    EXPECT_EQ(with_positions(more, 0).error(),
              "a.glb: accessors[0]: its 4 sparse elements of 3 are not all there");
}

struct ReachedBytes {
    const char* more;
    std::size_t count;
    const char* says;
};
TEST(GltfAccessor, SparseIndicesAreUnsignedWholeNumbers) {
    for (const int type : {5120, 5122, 5126}) {
        GltfBuilder b;
        b.triangle();
        b.accessors[0] = fmt::format(
            R"({{"bufferView":0,"componentType":5126,"type":"VEC3","count":3,"sparse":{{"count":1,)"
            R"("indices":{{"bufferView":0,"componentType":{}}},"values":{{"bufferView":0}}}}}})",
            type);
        b.primitive(R"("attributes":{"POSITION":0})");
        EXPECT_EQ(read_gltf_file(b.glb()).error(),
                  "a.glb: accessors[0]: its sparse indices are no unsigned whole numbers");
    }
}

TEST(GltfAccessor, WhatReachesBeyondItsViewIsRefusedWithItsBytes) {
    for (const ReachedBytes& c : {
             ReachedBytes{
                 "", 4,
                 "a.glb: accessors[0]: 4 elements of 12 bytes, 12 apart, from byte 0 on reach "
                 "beyond the 36 of bufferViews[0]"},
             ReachedBytes{
                 R"(,"byteOffset":4)", 3,
                 "a.glb: accessors[0]: 3 elements of 12 bytes, 12 apart, from byte 4 on reach "
                 "beyond the 36 of bufferViews[0]"},
             ReachedBytes{R"(,"byteOffset":9007199254740992)", 3,
                          "a.glb: accessors[0]: 3 elements of 12 bytes, 12 apart, from byte "
                          "9007199254740992 on reach beyond the 36 of bufferViews[0]"},
             ReachedBytes{
                 "", 9007199254740992,
                 "a.glb: accessors[0]: 9007199254740992 elements of 12 bytes, 12 apart, from byte "
                 "0 on reach beyond the 36 of bufferViews[0]"},
         }) {
        GltfBuilder b;
        const int view = b.view(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
        EXPECT_EQ(with_positions(b, b.accessor(view, 5126, "VEC3", c.count, c.more)).error(),
                  c.says);
    }
}

TEST(GltfAccessor, AViewBeyondItsBufferIsRefusedWithItsBytes) {
    GltfBuilder b;
    b.chunk = std::string(36, '\0');
    b.views.emplace_back(R"({"buffer":0,"byteOffset":4,"byteLength":36})");
    EXPECT_EQ(with_positions(b, b.accessor(0, 5126, "VEC3", 3)).error(),
              "a.glb: bufferViews[0]: 36 bytes from byte 4 on reach beyond the 36 of buffers[0]");
}

TEST(GltfAccessor, ManyZerosAreRefusedBeforeMemoryIsTaken) {
    GltfBuilder b;
    b.accessors.emplace_back(R"({"componentType":5126,"type":"VEC3","count":400000000})");
    b.primitive(R"("attributes":{"POSITION":0})");
    Reading how;
    how.memory_bytes = 1'000'000'000;
    EXPECT_EQ(
        read_gltf_file(b.glb(), "a.glb", how).error(),
        "a.glb: its scene has 400000000 vertices and 133333333 triangles, which take 34133 MB "
        "of memory, and 1000 MB are available: close other programs, or cut the model into "
        "parts");
    GltfBuilder more;
    more.accessors.emplace_back(R"({"componentType":5126,"type":"VEC3","count":4000000000000})");
    more.primitive(R"("attributes":{"POSITION":0})");
    EXPECT_EQ(read_gltf_file(more.glb()).error(),
              "a.glb: nodes[0] brings its scene to more than 536870912 vertices or 2147483647 "
              "corners of triangles: cut the model into parts");
}

TEST(GltfAccessor, IndicesOfEveryUnsignedTypeAreRead) {
    const auto expect = [](auto type, int component) {
        GltfBuilder b;
        const int positions = b.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
        const int indices =
            b.accessor(std::vector<decltype(type)>{3, 1, 0}, component, "SCALAR", 3);
        b.primitive(
            fmt::format(R"("attributes":{{"POSITION":{}}},"indices":{})", positions, indices));
        const GltfRead r = read_gltf_file(b.glb());
        ASSERT_TRUE(r.result) << r.error();
        EXPECT_EQ(r.mesh().corners[0].position, 3);
        EXPECT_EQ(r.mesh().corners[1].position, 1);
    };
    expect(std::uint8_t(), 5121);
    expect(std::uint16_t(), 5123);
    expect(std::uint32_t(), 5125);
}

TEST(GltfAccessor, AnIndexBeyondTheVerticesCostsItsFace) {
    GltfBuilder b;
    const int positions = b.triangle();
    const int indices =
        b.accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 1, 3, 65535, 1, 2}, 5123, "SCALAR", 9);
    b.primitive(fmt::format(R"("attributes":{{"POSITION":{}}},"indices":{})", positions, indices));
    const GltfRead r = read_gltf_file(b.glb());
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().faces(), 1u);
    EXPECT_EQ(r.result->skipped, 2u);
    EXPECT_EQ(
        r.warnings,
        "a.glb: meshes[0].primitives[0]: an index is 65535, and there are 3 vertices: what it "
        "belongs to is left out (and 1 more like it)");
}

TEST(GltfAccessor, IndicesThatAreNoWholeNumbersCostThePrimitive) {
    GltfBuilder b;
    const int positions = b.triangle();
    b.primitive(fmt::format(R"("attributes":{{"POSITION":{}}},"indices":{})", positions,
                            b.floats({0, 1, 2}, "SCALAR")));
    EXPECT_EQ(read_gltf_file(b.glb()).error(),
              "a.glb: meshes[0].primitives[0]: accessors[1] holds no unsigned whole numbers, as "
              "indices are: left out");
}

} // namespace
} // namespace scanout::io
