// Meshes that meshoptimizer and Draco packed. Kapoulkine 2021; Google 2018.
#include "gltf_file.h"
#include "io/gltf/meshopt.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wshadow"
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <draco/point_cloud/point_cloud_builder.h>
#pragma GCC diagnostic pop

namespace scanout::io {
namespace {

using gltf::Meshopt;
using test::GltfBuilder;
using test::GltfRead;
using test::read_gltf_file;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string packed_vertices(const std::vector<float>& values, std::size_t stride) {
    const std::size_t count = values.size() * 4 / stride;
    std::string out(meshopt_encodeVertexBufferBound(count, stride), '\0');
    out.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(),
                                          values.data(), count, stride));
    return out;
}

// Packed bytes as a view of `count` elements; nothing stands in the buffer view itself.
int packed_view(GltfBuilder& b, const std::string& bytes, std::size_t stride, std::size_t count,
                const std::string& mode, const std::string& more = "") {
    const std::size_t at = b.chunk.size();
    b.chunk += bytes;
    b.views.push_back(fmt::format(
        R"({{"buffer":0,"byteLength":{},"extensions":{{"EXT_meshopt_compression":{{"buffer":0,)"
        R"("byteOffset":{},"byteLength":{},"byteStride":{},"count":{},"mode":"{}"{}}}}}}})",
        stride * count, at, bytes.size(), stride, count, mode, more));
    return static_cast<int>(b.views.size()) - 1;
}

TEST(GltfMeshopt, VerticesAndIndicesAreUnpacked) {
    GltfBuilder b;
    const std::vector<float> square = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    const std::vector<unsigned> corners = {0, 1, 2, 2, 1, 3};
    std::string triangles(meshopt_encodeIndexBufferBound(6, 4), '\0');
    triangles.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(triangles.data()),
                                               triangles.size(), corners.data(), 6));
    const int p = b.accessor(packed_view(b, packed_vertices(square, 12), 12, 4, "ATTRIBUTES"), 5126,
                             "VEC3", 4);
    const int i = b.accessor(packed_view(b, triangles, 2, 6, "TRIANGLES"), 5123, "SCALAR", 6);
    b.primitive(fmt::format(R"("attributes":{{"POSITION":{}}},"indices":{})", p, i));
    std::string sequence(meshopt_encodeIndexSequenceBound(3, 4), '\0');
    const std::vector<unsigned> strip = {0, 1, 3};
    sequence.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(sequence.data()),
                                                sequence.size(), strip.data(), 3));
    const int line = b.accessor(packed_view(b, sequence, 4, 3, "INDICES"), 5125, "SCALAR", 3);
    b.primitive(fmt::format(R"("mode":3,"attributes":{{"POSITION":{}}},"indices":{})", p, line));
    const GltfRead r = read_gltf_file(b.glb());
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.warnings, "");
    EXPECT_EQ(r.mesh().faces(), 2u);
    EXPECT_EQ(r.mesh().positions[3], DVec3(1, 1, 0));
    EXPECT_THAT(r.mesh().line_vertices, ElementsAre(4, 5, 7));
}

TEST(GltfMeshopt, WhatIsDamagedIsRefusedWithItsView) {
    const std::string good = packed_vertices({0, 0, 0, 1, 0, 0, 0, 1, 0}, 12);
    const auto error = [](const std::string& bytes, std::size_t stride, std::size_t count,
                          const std::string& mode, const std::string& more = "") {
        GltfBuilder b;
        const int p = b.accessor(packed_view(b, bytes, stride, count, mode, more), 5126, "VEC3", 3);
        b.primitive(fmt::format(R"("attributes":{{"POSITION":{}}})", p));
        return read_gltf_file(b.glb()).error();
    };
    EXPECT_EQ(error(good, 12, 3, "ATTRIBUTES"), "no error");
    EXPECT_EQ(
        error(good.substr(0, 20), 12, 3, "ATTRIBUTES"),
        "a.glb: bufferViews[0]: its meshopt compression is damaged, or of a newer version than "
        "is read");
    EXPECT_EQ(error(good, 12, 3, "X"),
              "a.glb: bufferViews[0]: 'X' is no mode of EXT_meshopt_compression");
    EXPECT_EQ(error(good, 13, 3, "ATTRIBUTES"),
              "a.glb: bufferViews[0]: 3 packed elements of 13 bytes each cannot be ATTRIBUTES");
    EXPECT_EQ(error(good, 12, 3, "INDICES"),
              "a.glb: bufferViews[0]: 3 packed elements of 12 bytes each cannot be INDICES");
    EXPECT_EQ(error(good, 4, 4, "TRIANGLES"),
              "a.glb: bufferViews[0]: 4 packed elements of 4 bytes each cannot be TRIANGLES");
    EXPECT_EQ(error(good, 12, 3, "ATTRIBUTES", R"(,"filter":"QUATERNION")"),
              "a.glb: bufferViews[0]: 'QUATERNION' is no filter for elements of 12 bytes");
    EXPECT_THAT(error(good, 12, 100'000'000, "ATTRIBUTES"),
                HasSubstr("bytes cannot hold 100000000 elements"));
}

// Each as the library's own, but for the last bit where it approximates.
template <class T>
void expect_as_library(const char* filter, std::size_t stride,
                       void (*undo)(void*, std::size_t, std::size_t), int tolerance) {
    std::vector<std::uint8_t> ours(stride * 256);
    std::uint32_t state = 1;
    for (std::uint8_t& byte : ours) {
        state = state * 1664525 + 1013904223;
        byte = static_cast<std::uint8_t>(state >> 24);
    }
    // The third component of an octahedral code is that of 1; x and y lie within.
    if (std::string_view(filter) == "OCTAHEDRAL")
        for (std::size_t i = 0; i < ours.size(); i += stride) {
            T c[4];
            std::memcpy(c, ours.data() + i, sizeof c);
            c[2] = std::numeric_limits<T>::max();
            if (c[0] == std::numeric_limits<T>::min()) c[0] = 0;
            if (c[1] == std::numeric_limits<T>::min()) c[1] = 0;
            std::memcpy(ours.data() + i, c, sizeof c);
        }
    if (std::string_view(filter) == "QUATERNION")
        for (std::size_t i = 0; i < ours.size(); i += stride) {
            std::int16_t c[4];
            std::memcpy(c, ours.data() + i, sizeof c);
            for (int k = 0; k < 3; ++k)
                c[k] = static_cast<std::int16_t>(c[k] / 2);
            c[3] = static_cast<std::int16_t>(32764 | (c[3] & 3));
            std::memcpy(ours.data() + i, c, sizeof c);
        }
    std::vector<std::uint8_t> theirs = ours;
    Meshopt packed;
    packed.filter = filter;
    packed.stride = stride;
    gltf::undo_meshopt_filter(packed, ours);
    undo(theirs.data(), 256, stride);
    for (std::size_t i = 0; i < ours.size(); i += sizeof(T)) {
        T a, b;
        std::memcpy(&a, ours.data() + i, sizeof a);
        std::memcpy(&b, theirs.data() + i, sizeof b);
        ASSERT_LE(std::abs(static_cast<double>(a) - static_cast<double>(b)), tolerance)
            << filter << ' ' << i;
    }
}
TEST(GltfMeshopt, FiltersAreUndoneAsTheLibraryUndoesThem) {
    expect_as_library<std::int8_t>("OCTAHEDRAL", 4, meshopt_decodeFilterOct, 1);
    expect_as_library<std::int16_t>("OCTAHEDRAL", 8, meshopt_decodeFilterOct, 1);
    expect_as_library<std::int16_t>("QUATERNION", 8, meshopt_decodeFilterQuat, 1);
}

TEST(GltfMeshopt, FloatsOfAnExponentAreExact) {
    std::vector<std::uint8_t> bytes = {3, 0, 0, 2, 0xff, 0xff, 0xff, 0xff}; // 3 * 2^2, -1 * 2^-1
    Meshopt packed;
    packed.filter = "EXPONENTIAL";
    packed.stride = 8;
    gltf::undo_meshopt_filter(packed, bytes);
    float values[2];
    std::memcpy(values, bytes.data(), 8);
    EXPECT_EQ(values[0], 12);
    EXPECT_EQ(values[1], -0.5F);
}

struct Draco {
    std::string bytes;
    int position = 0, uv = 0;
};
Draco draco_square() {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2);
    const int position =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    const float p[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const float t[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const int corner[2][3] = {{0, 1, 2}, {0, 2, 3}};
    for (std::uint32_t f = 0; f < 2; ++f) {
        const int* c = corner[f];
        builder.SetAttributeValuesForFace(position, draco::FaceIndex(f), p[c[0]], p[c[1]], p[c[2]]);
        builder.SetAttributeValuesForFace(uv, draco::FaceIndex(f), t[c[0]], t[c[1]], t[c[2]]);
    }
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {{buffer.data(), buffer.size()},
            static_cast<int>(mesh->attribute(position)->unique_id()),
            static_cast<int>(mesh->attribute(uv)->unique_id())};
}

GltfRead read_draco(const std::string& bytes, const Draco& ids, bool attributes = true,
                    const Reading& how = {}) {
    GltfBuilder b;
    const int view = b.view(bytes);
    b.accessors = {R"({"componentType":5126,"type":"VEC3","count":4})",
                   R"({"componentType":5126,"type":"VEC2","count":4})",
                   R"({"componentType":5123,"type":"SCALAR","count":6})"};
    b.primitive(fmt::format(
        R"("attributes":{{"POSITION":0,"TEXCOORD_0":1}},"indices":2,"extensions":)"
        R"({{"KHR_draco_mesh_compression":{{"bufferView":{},"attributes":{{{}}}}}}})",
        view,
        attributes ? fmt::format(R"("POSITION":{},"TEXCOORD_0":{},"X":0)", ids.position, ids.uv)
                   : ""));
    return read_gltf_file(b.glb(), "a.glb", how);
}

TEST(GltfDraco, APackedMeshIsUnpacked) {
    const Draco square = draco_square();
    const GltfRead r = read_draco(square.bytes, square);
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.warnings, "");
    EXPECT_EQ(r.mesh().faces(), 2u);
    double area = 0;
    for (std::size_t f = 0; f < 2; ++f) {
        DVec3 p[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const geom::Corner& c = r.mesh().corners[3 * f + k];
            p[k] = r.mesh().positions[static_cast<std::size_t>(c.position)];
            const DVec2 uv = r.mesh().uvs[static_cast<std::size_t>(c.uv)];
            EXPECT_EQ(uv, DVec2(p[k].x, 1 - p[k].y));
        }
        area += cross3(p[1] - p[0], p[2] - p[0]).z / 2;
    }
    EXPECT_EQ(area, 1);
}

TEST(GltfDraco, WhatIsDamagedIsToldAndNotDrawn) {
    const Draco square = draco_square();
    EXPECT_EQ(read_draco(square.bytes.substr(0, square.bytes.size() / 2), square).error(),
              "a.glb: meshes[0].primitives[0]: its KHR_draco_mesh_compression is damaged");
    EXPECT_EQ(read_draco("no Draco", square).error(),
              "a.glb: meshes[0].primitives[0]: its KHR_draco_mesh_compression is damaged");
}

// Draco makes room for what its head says before it has read a face.
TEST(GltfDraco, ManyFacesAreRefusedBeforeMemoryIsTaken) {
    const Draco square = draco_square();
    const std::string million = "\xc0\x84\x3d"; // 1000000, seven bits a byte, the lowest first
    const std::string mesh = std::string("DRACO\2\2\1\1\0\0\0", 12);
    Reading how;
    how.memory_bytes = 90'000'000;
    EXPECT_EQ(read_draco(mesh + million + million, square, true, how).error(),
              "a.glb: meshes[0].primitives[0] takes 96000000 bytes of memory, and 90000000 may be "
              "taken");
    how.memory_bytes = 100'000'000;
    EXPECT_THAT(read_draco(mesh + million + million, square, true, how).error(),
                HasSubstr("is damaged"));
    // What it took is given back: a mesh that is read leaves room for its triangles alone.
    how.memory_bytes = 1500;
    EXPECT_TRUE(read_draco(square.bytes, square, true, how).result);
}

// The extension holds meshes alone (Google 2018).
TEST(GltfDraco, APointCloudIsRefused) {
    draco::PointCloudBuilder builder;
    builder.Start(3);
    const int position =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (std::uint32_t i = 0; i < 3; ++i) {
        const float p[3] = {i == 1 ? 1.0F : 0.0F, i == 2 ? 1.0F : 0.0F, 0};
        builder.SetAttributeValueForPoint(position, draco::PointIndex(i), p);
    }
    const auto cloud = builder.Finalize(false);
    draco::Encoder encoder;
    draco::EncoderBuffer buffer;
    ASSERT_TRUE(encoder.EncodePointCloudToBuffer(*cloud, &buffer).ok());
    EXPECT_THAT(read_draco({buffer.data(), buffer.size()}, {}).error(), HasSubstr("is damaged"));
}

} // namespace
} // namespace scanout::io
