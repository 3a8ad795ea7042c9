// glTF files whole: containers, nodes, modes, bad structure. Khronos 2021.
#include "base/memory.h"
#include "folder.h"
#include "gltf_file.h"
#include "io/formats.h"
#include "io/load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::io {
namespace {

using test::Folder;
using test::GltfBuilder;
using test::GltfRead;
using test::read_gltf_file;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kMagic = "glTF";

GltfBuilder one_triangle() {
    GltfBuilder b;
    b.primitive(fmt::format(R"("attributes":{{"POSITION":{}}})", b.triangle()));
    return b;
}

std::string error_of(const std::string& json) {
    return read_gltf_file(json, "a.gltf").error();
}

// --- Containers

TEST(Gltf, ContentTellsTheFormat) {
    EXPECT_TRUE(is_gltf(one_triangle().glb()));
    EXPECT_TRUE(is_gltf("\xef\xbb\xbf \n{ \"asset\": {} }"));
    for (const char* name : {"accessors", "bufferViews", "meshes"})
        EXPECT_TRUE(is_gltf(fmt::format("{{ \"{}\": [] }}", name))); // the asset comes last
    EXPECT_FALSE(is_gltf("{ \"nodes\": [] }"));
    EXPECT_FALSE(is_gltf("{" + std::string(65536, ' ') + "\"meshes\""));
    EXPECT_FALSE(is_gltf("v 0 0 0\n"));
    EXPECT_FALSE(is_gltf(""));
    EXPECT_EQ(*tell_format("{", 1, "a.gltf"), ModelFormat::gltf);
    EXPECT_EQ(*tell_format("x", 1, "a.GLB"), ModelFormat::gltf);
    EXPECT_EQ(*tell_format("v 0 0 0\n", 8, "a.glb"), ModelFormat::obj);
}

TEST(Gltf, ADamagedContainerIsRefusedWithItsBytes) {
    const std::string good = one_triangle().glb();
    const auto word = [](std::uint32_t w) {
        return std::string(reinterpret_cast<const char*>(&w), 4);
    };
    EXPECT_EQ(read_gltf_file(good.substr(0, 9)).error(),
              "a.glb: the GLB file is cut short: its 9 bytes hold no chunk");
    EXPECT_EQ(read_gltf_file(good.substr(0, 14)).error(),
              "a.glb: the GLB file is cut short: its 14 bytes hold no chunk");
    EXPECT_THAT(read_gltf_file(good.substr(0, good.size() - 4)).error(),
                HasSubstr("a.glb: chunk 1 of the GLB file, 36 bytes from byte "));
    EXPECT_EQ(read_gltf_file(kMagic + word(1) + word(20) + word(0) + word(0)).error(),
              "a.glb: GLB of version 1 is not read: export it as glTF 2.0");
    EXPECT_EQ(read_gltf_file(kMagic + word(2) + word(20) + word(0) + "BIN" + '\0').error(),
              "a.glb: the GLB file's first chunk is no JSON");
    EXPECT_EQ(read_gltf_file(kMagic + word(2) + word(20) + word(0) + "JSON").error(),
              "a.glb: its JSON cannot be read: it is empty");
}

TEST(Gltf, AnUnknownChunkIsPassedOver) {
    std::string file = one_triangle().glb();
    file += std::string("\4\0\0\0XYZWabcd", 12);
    const auto size = static_cast<std::uint32_t>(file.size());
    std::memcpy(file.data() + 8, &size, 4);
    EXPECT_TRUE(read_gltf_file(file).result);
}

TEST(Gltf, BuffersComeFromFilesAndDataUris) {
    const GltfBuilder b = one_triangle();
    const Folder folder;
    folder.write("my data.bin", b.chunk);
    const auto with = [&](const std::string& uri) {
        std::string json = b.json();
        const std::string key = R"("buffers":[{)";
        json.insert(json.find(key) + key.size(), fmt::format(R"("uri":"{}",)", uri));
        return read_gltf_file(json, folder.path("a.gltf"));
    };
    EXPECT_TRUE(with("my%20data.bin").result) << with("my%20data.bin").error();
    EXPECT_TRUE(with("my data.bin").result);
    // 36 bytes: a triangle.
    EXPECT_TRUE(
        with("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8A"
             "AAAA")
            .result);
    EXPECT_THAT(with("no.bin").error(), HasSubstr("a.gltf: buffers[0]: 'no.bin' is not there"));
    EXPECT_THAT(with("").error(), HasSubstr("a.gltf: buffers[0] has an empty uri"));
    EXPECT_THAT(with("../../x.bin").error(),
                HasSubstr("lies outside of the model's folder (--allow-outside reads it)"));
    EXPECT_THAT(
        with("https://example.com/a.bin").error(),
        HasSubstr("'https://example.com/a.bin' is no file beside the model, and nothing else "
                  "is read"));
    EXPECT_THAT(with("data:x;base64,A*==").error(), HasSubstr("its data URI cannot be read"));
    EXPECT_THAT(with("data:none").error(), HasSubstr("its data URI cannot be read"));
    EXPECT_THAT(with("C:/x.bin").error(), HasSubstr("'C:/x.bin' is not there"));
    EXPECT_THAT(with("%zz.bin").error(), HasSubstr("'%zz.bin' is not there"));
    EXPECT_THAT(with("data:,abc").warnings, HasSubstr("byteLength is 36, and it has 3 bytes"));
}

TEST(Gltf, StandardRulesOfReadersHold) {
    const Folder folder;
    const std::string path = folder.write("a.glb", one_triangle().glb());
    Warnings warnings;
    LoadOptions options;
    ModelFormat format{};
    options.format_read = &format;
    const auto scene = load(path, options, warnings);
    ASSERT_TRUE(scene) << scene.error().what;
    EXPECT_EQ(format, ModelFormat::gltf);
    EXPECT_EQ(scene->counts.faces, 1u);
    options.progress = [](double) { return false; };
    EXPECT_EQ(load(path, options, warnings).error().what, path + ": loading was cancelled");
}

// --- JSON

TEST(Gltf, JsonThatCannotBeMeantIsRefusedWithItsPlace) {
    const auto with = [](const std::string& more) {
        return error_of(R"({"asset":{"version":"2.0"},)" + more + "}");
    };
    EXPECT_THAT(error_of("{"), StartsWith("a.gltf: its JSON cannot be read: "));
    Warnings warnings; // an empty file has no address
    EXPECT_EQ(read_gltf({}, "a.gltf", warnings, nullptr).error().what,
              "a.gltf: its JSON cannot be read: it is empty");
    EXPECT_EQ(error_of("[]"), "a.gltf: its JSON is no object");
    EXPECT_EQ(error_of("{}"), "a.gltf: asset.version is missing: it is no glTF 2.0 file");
    EXPECT_EQ(error_of(R"({"asset":{"version":"1.0"}})"),
              "a.gltf: glTF 1.0 is not read: export it as glTF 2.0");
    EXPECT_EQ(error_of(R"({"asset":{"version":"2.1","minVersion":"2.1"}})"),
              "a.gltf: needs glTF 2.1, and 2.0 is read");
    EXPECT_EQ(with(R"("accessors":[{"count":-1}])"),
              "a.gltf: accessors[0].count is no whole number from 0 to 9007199254740992");
    EXPECT_EQ(with(R"("accessors":[7])"), "a.gltf: accessors[0] is no object");
    EXPECT_EQ(with(R"("nodes":[{},{"mesh":2}],"meshes":[{},{}])"),
              "a.gltf: nodes[1].mesh is 2, and there are 2 meshes");
    EXPECT_EQ(with(R"("nodes":[{"children":[1]}])"),
              "a.gltf: nodes[0].children is 1, and there are 1 nodes");
    EXPECT_EQ(with(R"("nodes":[{"children":0}])"), "a.gltf: nodes[0].children is no array");
    EXPECT_EQ(with(R"("nodes":[{"matrix":[1,2]}])"),
              "a.gltf: nodes[0].matrix is no array of 16 numbers");
    EXPECT_EQ(with(R"("nodes":[{"scale":[1,2,"x"]}])"), "a.gltf: nodes[0].scale is no number");
    EXPECT_EQ(with(R"("nodes":[{"extensions":[]}])"), "a.gltf: nodes[0].extensions is no object");
    EXPECT_EQ(with(R"("accessors":[{"componentType":5126,"normalized":1}])"),
              "a.gltf: accessors[0].normalized is neither true nor false");
    EXPECT_EQ(with(R"("images":[{"uri":1}])"), "a.gltf: images[0].uri is no text");
    EXPECT_EQ(with(R"("scene":1,"scenes":[{}])"), "a.gltf: scene is 1, and there are 1 scenes");
}

// What is never asked for does not cost the file.
TEST(Gltf, WhatNobodyReadsMayBeWrong) {
    GltfBuilder b;
    b.triangle();
    b.accessors.emplace_back(R"({"componentType":5124,"type":"SCALAR","count":3})");
    b.accessors.emplace_back(R"({"componentType":5126,"type":"VEC5","count":3})");
    b.primitive(R"("attributes":{"POSITION":0,"TANGENT":99,"_A":"x"},"indices":null)");
    b.nodes = R"({"mesh":0,"skin":null,"camera":5})";
    b.views.emplace_back(R"({"buffer":8,"byteLength":4})");
    b.accessors.emplace_back(R"({"bufferView":9,"componentType":5126,"type":"VEC3","count":3})");
    b.accessors.emplace_back(R"({"bufferView":1,"componentType":5126,"type":"VEC3","count":3})");
    b.scenes = R"({"nodes":[0]},{"nodes":[7]})";
    b.more = R"(,"scene":null,"images":[{"bufferView":9}],"skins":[{"joints":[9]}])";
    const GltfRead r = read_gltf_file(b.glb());
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.warnings, "");
    EXPECT_EQ(r.mesh().faces(), 1u);
    b.primitives = {R"({"attributes":{"POSITION":0,"NORMAL":2}})"};
    EXPECT_EQ(read_gltf_file(b.glb()).warnings,
              "a.glb: accessors[2].type is 'VEC5', which is none of glTF's; drawn without NORMAL");
    const auto error = [&](const std::string& primitive) {
        b.primitives = {"{" + primitive + "}"};
        return read_gltf_file(b.glb()).error();
    };
    EXPECT_EQ(error(R"("attributes":{"POSITION":1})"),
              "a.glb: accessors[1].componentType is 5124, which is none of glTF's");
    EXPECT_EQ(error(R"("attributes":{"POSITION":3})"),
              "a.glb: accessors[3].bufferView is 9, and there are 2 bufferViews");
    EXPECT_EQ(error(R"("attributes":{"POSITION":4})"),
              "a.glb: bufferViews[1].buffer is 8, and there are 1 buffers");
    EXPECT_EQ(error(R"("attributes":{"POSITION":0,"NORMAL":"x"})"),
              "a.glb: meshes[0].primitives[0].NORMAL is no whole number from 0 to 2147483647: left "
              "out");
    EXPECT_EQ(error(R"("attributes":{"POSITION":0},"mode":"x")"),
              "a.glb: meshes[0].primitives[0].mode is no whole number from 0 to 65535");
    EXPECT_EQ(error(R"("attributes":{"POSITION":0,"NORMAL":null})"), "no error");
}

// A node of no size, or that skins wrongly, is placed all the same.
TEST(Gltf, NodesThatFlattenOrNameNoSkinAreDrawn) {
    GltfBuilder b;
    const int floats = b.triangle();
    b.primitive(fmt::format(R"("attributes":{{"POSITION":{},"NORMAL":{}}})", floats, floats));
    b.nodes = R"({"mesh":0,"scale":[0,0,0]})";
    const GltfRead flat = read_gltf_file(b.glb());
    ASSERT_TRUE(flat.result) << flat.error();
    EXPECT_EQ(flat.mesh().positions, std::vector<DVec3>(3, DVec3(0)));
    EXPECT_EQ(flat.mesh().normals, std::vector<Vec3>(3, Vec3(0)));
    b.nodes = R"({"mesh":0,"skin":3},{"children":[0,0]})"; // named twice is once
    EXPECT_EQ(read_gltf_file(b.glb()).warnings,
              "a.glb: nodes[0].skin is 3, and there are 0 skins; drawn without");
    b.nodes = R"({"mesh":0,"skin":0})";
    b.more = R"(,"skins":[{"joints":[9]}])";
    EXPECT_THAT(read_gltf_file(b.glb()).warnings,
                HasSubstr("a.glb: skins[0].joints is 9, and there are 1 nodes; drawn without it"));
}

TEST(Gltf, JsonThatIsNoneSaysWhy) {
    const std::string head = "a.gltf: its JSON cannot be read: ";
    EXPECT_EQ(error_of("  "), head + "it is empty");
    EXPECT_EQ(error_of(std::string(3000, '[') + std::string(3000, ']')),
              head + "it is nested too deeply");
    EXPECT_EQ(error_of("{\"a\":\"\xff\"}"), head + "it is no UTF-8");
    EXPECT_EQ(error_of("{\"a\":1e999}"), head + "a number in it is none, or too large");
    EXPECT_EQ(error_of("{\"a\":\"b}"), head + "a text in it has no end");
    EXPECT_EQ(error_of("{\"a\":}"), head + "it is cut short, or no JSON");
}

TEST(Gltf, NodesMayHangAsDeepAsAFileHasThem) {
    GltfBuilder b = one_triangle();
    std::string nodes;
    constexpr int kDeep = 20000;
    for (int i = 0; i < kDeep; ++i)
        nodes += fmt::format(R"({{"children":[{}],"translation":[1,0,0]}},)", i + 1);
    b.nodes = nodes + R"({"mesh":0})";
    const GltfRead r = read_gltf_file(b.glb());
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().positions[0], DVec3(kDeep, 0, 0));
}

TEST(Gltf, WholeNumbersMayBeWrittenAsDecimals) {
    EXPECT_EQ(error_of(R"({"asset":{"version":"2.0"},"scene":0.0,"scenes":[{}]})"),
              "a.gltf: holds nothing that can be drawn: no node of its scene has a mesh");
}

TEST(Gltf, ExtensionsThatAreNotDrawnAreNamedOrRefused) {
    GltfBuilder b = one_triangle();
    b.more = R"(,"extensionsUsed":["KHR_materials_unlit","XX_b","XX_a"])";
    const GltfRead used = read_gltf_file(b.glb());
    ASSERT_TRUE(used.result);
    EXPECT_EQ(used.warnings, "a.glb: drawn without the extensions XX_a, XX_b");
    b.more = R"(,"extensionsUsed":["XX_a"],"extensionsRequired":["XX_a"])";
    EXPECT_EQ(read_gltf_file(b.glb()).error(),
              "a.glb: requires the extension 'XX_a', which is not read: export it without");
}

// --- Nodes

TEST(Gltf, ACycleOfNodesIsRefused) {
    GltfBuilder b = one_triangle();
    b.nodes = R"({"children":[1]},{"children":[2]},{"children":[1],"mesh":0})";
    EXPECT_EQ(read_gltf_file(b.glb()).error(),
              "a.glb: nodes[1] is a child of nodes[0] and of nodes[2]");
    b.nodes = R"({"children":[1]},{"children":[0]})";
    EXPECT_EQ(read_gltf_file(b.glb()).error(),
              "a.glb: nodes[0] is its own descendant, by nodes[1]");
    b.nodes = R"({"children":[0]})";
    EXPECT_EQ(read_gltf_file(b.glb()).error(),
              "a.glb: nodes[0] is its own descendant, by nodes[0]");
}

TEST(Gltf, EveryPlaceOfAMeshIsDrawnInTheFilesUnits) {
    GltfBuilder b = one_triangle();
    // A quarter turn about z, then a shift; within it a scale.
    b.nodes = R"({"translation":[10,0,0],"rotation":[0,0,0.70710678118654752,0.70710678118654752],)"
              R"("children":[1]},{"scale":[2,3,1],"mesh":0},)"
              R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,5,1]})";
    b.scenes = R"({"nodes":[0,2,2]})";
    const GltfRead r = read_gltf_file(b.glb());
    ASSERT_TRUE(r.result) << r.error();
    const auto& p = r.mesh().positions;
    ASSERT_EQ(p.size(), 6u);
    const auto near = [](const DVec3& a, const DVec3& b) { return dot3(a - b, a - b) < 1e-24; };
    EXPECT_TRUE(near(p[1], DVec3(10, 2, 0)));
    EXPECT_TRUE(near(p[2], DVec3(7, 0, 0)));
    EXPECT_EQ(p[4], DVec3(1, 0, 5));
}

TEST(Gltf, OnlyTheDefaultSceneIsDrawnAndWithoutScenesEveryRoot) {
    GltfBuilder b = one_triangle();
    b.nodes = R"({"mesh":0},{"mesh":0,"translation":[5,0,0],"children":[2]},{"mesh":0})";
    b.scenes = R"({"nodes":[0]},{"nodes":[1]})";
    b.more = R"(,"scene":1)";
    EXPECT_EQ(read_gltf_file(b.glb()).mesh().positions[0], DVec3(5, 0, 0));
    b.more = "";
    EXPECT_EQ(read_gltf_file(b.glb()).mesh().faces(), 1u);
    b.scenes = "";
    EXPECT_EQ(read_gltf_file(b.glb()).mesh().faces(), 3u);
    b.nodes = "";
    EXPECT_EQ(read_gltf_file(b.glb()).error(),
              "a.glb: holds nothing that can be drawn: no node of its scene has a mesh");
}

// Faces keep their front, and normals their side.
TEST(Gltf, AMirroredNodeWindsItsFacesTheOtherWay) {
    GltfBuilder b;
    const int positions = b.triangle(), normals = b.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    b.primitive(fmt::format(R"("attributes":{{"POSITION":{},"NORMAL":{}}})", positions, normals));
    b.nodes = R"({"mesh":0,"scale":[-2,1,1]})";
    const GltfRead r = read_gltf_file(b.glb());
    ASSERT_TRUE(r.result) << r.error();
    const geom::PolygonMesh& m = r.mesh();
    const auto at = [&](int k) {
        return m.positions[static_cast<std::size_t>(m.corners[k].position)];
    };
    EXPECT_GT(cross3(at(1) - at(0), at(2) - at(0)).z, 0);
    EXPECT_GT(m.normals[0].z, 0);
}

TEST(Gltf, NormalsStayAtRightAnglesUnderAnUnevenScale) {
    GltfBuilder b;
    const int positions = b.floats({0, 0, 0, 1, -1, 0, 0, 0, 1}, "VEC3");
    const int normals = b.floats({1, 1, 0, 1, 1, 0, 1, 1, 0}, "VEC3");
    b.primitive(fmt::format(R"("attributes":{{"POSITION":{},"NORMAL":{}}})", positions, normals));
    b.nodes = R"({"mesh":0,"scale":[4,1,1e-30]})";
    const GltfRead r = read_gltf_file(b.glb());
    ASSERT_TRUE(r.result) << r.error();
    const Vec3 n = r.mesh().normals[0];
    EXPECT_NEAR(dot3(DVec3(n), r.mesh().positions[1]), 0, 1e-6);
}

TEST(Gltf, InstancesOfANodeAreDrawnEach) {
    GltfBuilder b = one_triangle();
    const int move = b.floats({1, 0, 0, 2, 0, 0}, "VEC3"),
              scale = b.floats({1, 1, 1, 3, 3, 3}, "VEC3");
    b.nodes =
        fmt::format(R"({{"mesh":0,"translation":[0,0,7],"extensions":{{"EXT_mesh_gpu_instancing":)"
                    R"({{"attributes":{{"TRANSLATION":{},"SCALE":{}}}}}}}}})",
                    move, scale);
    const GltfRead r = read_gltf_file(b.glb());
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().faces(), 2u);
    EXPECT_EQ(r.mesh().positions[4], DVec3(5, 0, 7));
    // Instances may have none but attributes of the file's own; the shortest says how many.
    b.accessors.emplace_back(R"({"componentType":5126,"type":"SCALAR","count":3})");
    for (const auto& [attributes, count] :
         {std::pair(R"("_ID":3)", 3u), {R"("_ID":3,"TRANSLATION":1)", 2u}}) {
        b.nodes = fmt::format(R"({{"mesh":0,"extensions":{{"EXT_mesh_gpu_instancing":)"
                              R"({{"attributes":{{{}}}}}}}}})",
                              attributes);
        const GltfRead own = read_gltf_file(b.glb());
        ASSERT_TRUE(own.result) << own.error();
        EXPECT_EQ(own.mesh().faces(), count);
    }
    b.nodes = fmt::format(R"({{"mesh":0,"extensions":{{"EXT_mesh_gpu_instancing":)"
                          R"({{"attributes":{{"ROTATION":{}}}}}}}}})",
                          move);
    const GltfRead bad = read_gltf_file(b.glb());
    ASSERT_TRUE(bad.result);
    EXPECT_EQ(bad.warnings,
              "a.glb: nodes[0]: accessors[1] has 3 numbers an instance, ROTATION has 4; "
              "drawn once");
}

TEST(Gltf, WhatMovesIsShownAtRestAndSaidOnce) {
    GltfBuilder b;
    const int p = b.triangle();
    b.primitive(
        fmt::format(R"("attributes":{{"POSITION":{}}},"targets":[{{"POSITION":{}}}])", p, p));
    b.more = R"(,"animations":[{}],"skins":[{}])";
    EXPECT_EQ(read_gltf_file(b.glb()).warnings, // no node has the skin
              "a.glb: has animations, morph targets: shown at rest");
    b.nodes = R"({"mesh":0,"skin":0})";
    EXPECT_EQ(read_gltf_file(b.glb()).warnings,
              "a.glb: has animations, skins, morph targets: shown at rest");
}

TEST(Gltf, CamerasAreListed) {
    GltfBuilder b = one_triangle();
    b.more = R"(,"cameras":[{"name":"front","type":"perspective","perspective":{"yfov":1}},)"
             R"({"type":"orthographic"}])";
    EXPECT_THAT(read_gltf_file(b.glb()).result->cameras,
                ElementsAre("perspective 'front', 57.3 degrees", "orthographic"));
}

// --- Modes

struct Shape {
    int mode;
    std::size_t faces, lines, points;
};
TEST(Gltf, EveryModeIsDrawn) {
    for (const Shape& s :
         {Shape{0, 0, 0, 5}, Shape{1, 0, 2, 0}, Shape{2, 0, 1, 0}, Shape{3, 0, 1, 0},
          Shape{4, 1, 0, 0}, Shape{5, 3, 0, 0}, Shape{6, 3, 0, 0}}) {
        GltfBuilder b;
        b.primitive(fmt::format(R"("mode":{},"attributes":{{"POSITION":{}}})", s.mode,
                                b.floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 2, 0}, "VEC3")));
        const GltfRead r = read_gltf_file(b.glb());
        ASSERT_TRUE(r.result) << r.error();
        EXPECT_EQ(r.mesh().faces(), s.faces) << s.mode;
        EXPECT_EQ(r.mesh().line_begin.size(), s.lines) << s.mode;
        EXPECT_EQ(r.mesh().point_vertices.size(), s.points) << s.mode;
        if (s.mode == 2) {
            EXPECT_THAT(r.mesh().line_vertices, ElementsAre(0, 1, 2, 3, 4, 0));
        }
        if (s.mode == 3) {
            EXPECT_THAT(r.mesh().line_vertices, ElementsAre(0, 1, 2, 3, 4));
        }
        if (s.mode != 5 && s.mode != 6) continue;
        std::vector<int> corners;
        for (const geom::Corner& c : r.mesh().corners)
            corners.push_back(c.position);
        if (s.mode == 5) {
            EXPECT_THAT(corners, ElementsAre(0, 1, 2, 1, 3, 2, 2, 3, 4));
        }
        if (s.mode == 6) {
            EXPECT_THAT(corners, ElementsAre(0, 1, 2, 0, 2, 3, 0, 3, 4));
        }
    }
}

TEST(Gltf, IndicesBeyondTheVerticesCostTheirSegmentsAndPoints) {
    for (const int mode : {0, 1, 2, 3}) {
        GltfBuilder b;
        const int p = b.floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3");
        const int i = b.accessor(std::vector<std::uint8_t>{0, 1, 9, 2, 3}, 5121, "SCALAR", 5);
        b.primitive(
            fmt::format(R"("mode":{},"attributes":{{"POSITION":{}}},"indices":{})", mode, p, i));
        const GltfRead r = read_gltf_file(b.glb());
        ASSERT_TRUE(r.result) << r.error();
        EXPECT_EQ(r.result->skipped, mode == 0 || mode == 1 ? 1u : 2u);
        if (mode == 2) { // two pieces and the way back
            EXPECT_THAT(r.mesh().line_vertices, ElementsAre(0, 1, 2, 3, 0));
        }
    }
}

TEST(Gltf, APrimitiveThatCannotBeUsedIsToldAndTheRestIsDrawn) {
    GltfBuilder b = one_triangle();
    b.primitive(R"("attributes":{})");
    const GltfRead r = read_gltf_file(b.glb());
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.result->skipped, 1u);
    EXPECT_EQ(r.warnings, "a.glb: meshes[0].primitives[1] has no POSITION: left out");
    GltfBuilder odd;
    odd.primitive(fmt::format(R"("mode":7,"attributes":{{"POSITION":{}}})", odd.triangle()));
    EXPECT_EQ(read_gltf_file(odd.glb()).error(),
              "a.glb: meshes[0].primitives[0]: mode 7 is none of glTF's: left out");
    GltfBuilder flat;
    flat.primitive(
        fmt::format(R"("attributes":{{"POSITION":{}}})", flat.floats({0, 0, 1, 0, 0, 1}, "VEC2")));
    EXPECT_EQ(read_gltf_file(flat.glb()).error(),
              "a.glb: meshes[0].primitives[0]: accessors[0] gives "
              "no three numbers a position: left out");
}

// A thousand million places of nothing take neither time nor memory.
TEST(Gltf, PrimitivesWithoutVerticesAreLeftOutOfEveryPlace) {
    GltfBuilder b = one_triangle();
    b.accessors.emplace_back(R"({"componentType":5126,"type":"VEC3","count":0})");
    b.accessors.emplace_back(R"({"componentType":5126,"type":"VEC3","count":100000})");
    for (int i = 0; i < 10000; ++i)
        b.primitive(R"("attributes":{"POSITION":1})");
    b.nodes = R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":)"
              R"({"attributes":{"TRANSLATION":2}}}})";
    const std::uint64_t before = peak_resident_bytes();
    const GltfRead r = read_gltf_file(b.glb());
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().faces(), 100'000u);
    EXPECT_LT(peak_resident_bytes() - before, 200'000'000u);
}

// The last part is watched, too, and what reading takes beside the mesh is charged to one account.
TEST(Gltf, MemoryIsWatchedToTheEnd) {
    const GltfBuilder b = one_triangle();
    Warnings warnings;
    std::vector<double> told;
    ASSERT_TRUE(read_gltf(b.glb(), "a.glb", warnings, [&](double done) {
        told.push_back(done);
        return true;
    }));
    EXPECT_EQ(told.back(), 1);
    EXPECT_GE(told.size(), 3u); // and before the first vertex
    Reading how;
    how.memory_bytes = 2 * (3 * 24 + 3 * 12 + 3 * 4 + 8);
    EXPECT_TRUE(read_gltf_file(b.glb(), "a.glb", how).result);
    --how.memory_bytes;
    EXPECT_THAT(read_gltf_file(b.glb(), "a.glb", how).error(),
                HasSubstr("1 triangles, which take"));
    // Vertices that are not in the chunk are taken from the same account.
    GltfBuilder sparse = b;
    sparse.accessors[0] +=
        R"(,"sparse":{"count":0,"indices":{"bufferView":0,"componentType":5123},)"
        R"("values":{"bufferView":0}}})";
    sparse.accessors[0].erase(sparse.accessors[0].find("},\"sparse"), 1);
    ++how.memory_bytes;
    EXPECT_THAT(read_gltf_file(sparse.glb(), "a.glb", how).error(), HasSubstr("which take"));
    how.memory_bytes += 3 * 12;
    EXPECT_TRUE(read_gltf_file(sparse.glb(), "a.glb", how).result);
}

TEST(Gltf, AttributesThatDoNotFitAreLeftOut) {
    GltfBuilder b;
    const int p = b.triangle(), two = b.floats({0, 0, 1, 0, 0, 1}, "VEC3"),
              one = b.floats({1, 2, 3}, "SCALAR");
    b.primitive(
        fmt::format(R"("attributes":{{"POSITION":{},"NORMAL":{},"TEXCOORD_0":{}}})", p, two, one));
    const GltfRead r = read_gltf_file(b.glb());
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().corners[0].normal, -1);
    EXPECT_EQ(r.mesh().corners[0].uv, -1);
    EXPECT_THAT(r.warnings,
                HasSubstr("accessors[1] has 2 elements for 3 vertices; drawn without NORMAL"));
    EXPECT_THAT(
        r.warnings,
        HasSubstr("accessors[2] has 1 numbers an element, 2 are needed; drawn without TEXCOORD_0"));
}

} // namespace
} // namespace scanout::io
