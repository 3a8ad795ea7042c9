// Skins at rest, against the sum that the specification writes. Khronos 2021, 3.7.3.
#include "gltf_file.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::io {
namespace {

using test::GltfBuilder;
using test::GltfRead;
using test::read_gltf_file;
using ::testing::HasSubstr;

// A triangle of two joints: the first moves by (10, 0, 0), the second doubles everything; and what
// undoes the first's place at binding, (1, 0, 0).
struct Skinned {
    GltfBuilder b;
    std::string weights = R"("JOINTS_0":1,"WEIGHTS_0":2)";

    explicit Skinned(const std::vector<float>& of_weights,
                     const std::vector<std::uint8_t>& joints = {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0,
                                                                0}) {
        b.triangle();
        b.accessor(joints, 5121, "VEC4", 3);
        b.floats(of_weights, "VEC4");
        std::vector<float> bind(32, 0);
        for (const std::size_t i : {0, 5, 10, 15, 16, 21, 26, 31})
            bind[i] = 1;
        bind[12] = -1;
        b.accessor(bind, 5126, "MAT4", 2);
        b.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
        b.nodes = R"({"mesh":0,"skin":0,"translation":[0,0,500]},{"translation":[10,0,0]},)"
                  R"({"scale":[2,2,2]})";
        b.scenes = R"({"nodes":[0,1,2]})";
        b.more = R"(,"skins":[{"joints":[1,2],"inverseBindMatrices":3}])";
    }
    GltfRead read() {
        b.primitives = {fmt::format(R"({{"attributes":{{"POSITION":0,"NORMAL":4,{}}}}})", weights)};
        return read_gltf_file(b.glb());
    }
};

TEST(GltfSkin, JointsPlaceAVertexByTheirWeightsAndTheNodeDoesNot) {
    Skinned s({1, 0, 0, 0, 0, 1, 0, 0, 0.25F, 0.75F, 0, 0});
    const GltfRead r = s.read();
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().positions[0], DVec3(9, 0, 0));
    EXPECT_EQ(r.mesh().positions[1], DVec3(2, 0, 0));
    EXPECT_EQ(r.mesh().positions[2], DVec3(2.25, 0.25 + 1.5, 0));
    EXPECT_EQ(r.warnings, "a.glb: has skins: shown at rest");
    EXPECT_GT(r.mesh().normals[2].z, 0);
}

TEST(GltfSkin, WeightsThatAreRoundedAreMadeWhole) {
    Skinned s({0.5F, 0, 0, 0, 0, 3, 0, 0, 0.25F, 0.25F, 0, 0});
    const GltfRead r = s.read();
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().positions[0], DVec3(9, 0, 0));
    EXPECT_EQ(r.mesh().positions[1], DVec3(2, 0, 0));
}

TEST(GltfSkin, WhatNoJointHoldsIsPlacedByItsNode) {
    Skinned s({0, 0, 0, 0, -1, std::nanf(""), 0, 0, 1, 0, 0, 0},
              {0, 0, 0, 0, 0, 1, 0, 0, 9, 0, 0, 0});
    const GltfRead r = s.read();
    ASSERT_TRUE(r.result) << r.error();
    for (const DVec3& at : r.mesh().positions)
        EXPECT_EQ(at.z, 500);
}

TEST(GltfSkin, WithoutMatricesTheJointsAloneCount) {
    Skinned s({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    s.b.more = R"(,"skins":[{"joints":[1,2]}])";
    EXPECT_EQ(s.read().mesh().positions[0], DVec3(10, 0, 0));
    s.weights = R"("JOINTS_0":1)"; // no weights: the node places it
    EXPECT_EQ(s.read().mesh().positions[0], DVec3(0, 0, 500));
}

TEST(GltfSkin, MatricesThatAreNotThereAreToldAndTheNodePlacesTheMesh) {
    Skinned s({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    s.b.more = R"(,"skins":[{"joints":[1,2,0],"inverseBindMatrices":3}])";
    const GltfRead r = s.read();
    ASSERT_TRUE(r.result) << r.error();
    EXPECT_EQ(r.mesh().positions[0], DVec3(0, 0, 500));
    EXPECT_THAT(r.warnings,
                HasSubstr("a.glb: skins[0]: accessors[3] gives no matrix of 4 x 4 floats for "
                          "each of 3 joints; drawn without it"));
}

// Joints that mirror turn faces round, like nodes that do.
TEST(GltfSkin, AMirroringJointWindsFacesTheOtherWay) {
    Skinned s({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
    s.b.nodes = R"({"mesh":0,"skin":0},{"scale":[-1,1,1]},{})";
    const GltfRead r = s.read();
    ASSERT_TRUE(r.result) << r.error();
    const geom::PolygonMesh& m = r.mesh();
    const auto at = [&](std::size_t k) {
        return m.positions[static_cast<std::size_t>(m.corners[k].position)];
    };
    EXPECT_GT(cross3(at(1) - at(0), at(2) - at(0)).z, 0);
    EXPECT_GT(m.normals[0].z, 0);
}

} // namespace
} // namespace scanout::io
