// Animations of nodes, under skins, and of morph targets, against the specification's formulas in
// long double. Khronos 2021, 3.7.2.2, 3.7.3, 3.11 and appendix C.
#include "gltf_file.h"
#include "math/quaternion.h"
#include "support/random.h"

#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::io {
namespace {

using scanout::test::Random;
using test::GltfBuilder;
using test::GltfRead;
using test::read_gltf_file;
using ::testing::HasSubstr;

// A triangle whose node, or the node above it, is moved by one channel.
struct Moving {
    GltfBuilder b;
    std::string path = "translation", interpolation = "LINEAR";
    int node = 0;

    Moving() { b.primitive(fmt::format(R"("attributes":{{"POSITION":{}}})", b.triangle())); }
    // times: accessor 1, values: accessor 2.
    void keys(const std::vector<float>& times, const std::vector<float>& values,
              std::string_view type = "VEC3") {
        b.floats(times, "SCALAR");
        b.floats(values, type);
    }
    GltfRead at(double seconds, const std::string& name = "0") {
        b.more = fmt::format(
            R"(,"animations":[{{"name":"walk","channels":[{{"sampler":0,"target":{{"node":{},"path":"{}"}}}}],)"
            R"("samplers":[{{"input":1,"output":2,"interpolation":"{}"}}]}}])",
            node, path, interpolation);
        Reading how;
        how.animation = AnimationMoment{name, seconds, {}};
        return read_gltf_file(b.glb(), "a.glb", how);
    }
    DVec3 first(double seconds) {
        const GltfRead r = at(seconds);
        EXPECT_TRUE(r.result) << r.error();
        EXPECT_EQ(r.warnings, "");
        return r.result ? r.mesh().positions[0] : DVec3(0);
    }
};

TEST(GltfAnimation, MovesANodeAndWhatHangsOnIt) {
    Moving m;
    m.keys({1, 2}, {0, 0, 0, 4, 2, 0});
    EXPECT_EQ(m.first(1.5), DVec3(2, 1, 0));
    EXPECT_EQ(m.first(0), DVec3(0)) << "before its first key: that key";
    EXPECT_EQ(m.first(2), DVec3(4, 2, 0)) << "the end is still its last key";
    EXPECT_EQ(m.first(3.5), DVec3(2, 1, 0)) << "then it begins again";
    m.b.nodes = R"({"children":[1],"translation":[9,9,9]},{"mesh":0,"translation":[0,0,7]})";
    EXPECT_EQ(m.first(1.5), DVec3(2, 1, 7)) << "in place of the node's own";
    m.interpolation = "STEP";
    EXPECT_EQ(m.first(1.9), DVec3(0, 0, 7));
}

TEST(GltfAnimation, TurnsTheShortWayAndScales) {
    Moving m;
    m.b.nodes = R"({"children":[1]},{"mesh":0,"translation":[1,0,0]})";
    const float s = std::sqrt(0.5F);
    m.keys({0, 1}, {0, 0, 0, 1, 0, 0, -s, -s}, "VEC4"); // a quarter about z, with the other sign
    m.path = "rotation";
    const DVec3 at = m.first(0.5);
    EXPECT_NEAR(at.x, std::sqrt(0.5), 1e-7);
    EXPECT_NEAR(at.y, std::sqrt(0.5), 1e-7);
    Moving bigger;
    bigger.b.nodes = m.b.nodes;
    bigger.path = "scale";
    bigger.keys({0, 1}, {1, 1, 1, 3, 3, 3});
    EXPECT_EQ(bigger.first(0.5), DVec3(2, 0, 0));
}

TEST(GltfAnimation, ACubicSplineHasItsTangents) {
    Moving m;
    m.interpolation = "CUBICSPLINE"; // in, value, out
    m.keys({0, 2}, {9, 9, 9, 0, 0, 0, 8, 0, 0, -8, 0, 0, 0, 0, 0, 9, 9, 9});
    EXPECT_EQ(m.first(1), DVec3(4, 0, 0));
    EXPECT_EQ(m.first(0), DVec3(0));
}

TEST(GltfAnimation, IsFoundByNameOrNumber) {
    Moving m;
    m.keys({0, 1}, {0, 0, 0, 1, 0, 0});
    EXPECT_EQ(m.at(1, "walk").mesh().positions[0], DVec3(1, 0, 0));
    EXPECT_EQ(m.at(1, "run").error(), "a.glb: there is no animation 'run'; there are: 0 'walk'");
    EXPECT_THAT(m.at(1, "1").error(), HasSubstr("no animation '1'"));
    m.b.more = "";
    Reading how;
    how.animation = AnimationMoment{"0", 0, {}};
    EXPECT_EQ(read_gltf_file(m.b.glb(), "a.glb", how).error(),
              "a.glb: has no animations: leave --animation out");
}

TEST(GltfAnimation, AChannelThatCannotBeIsLeftOutWithAWarning) {
    const auto warning = [](const std::vector<float>& times, const std::vector<float>& values,
                            const std::string& path = "translation", std::string_view type = "VEC3",
                            int node = 0) {
        Moving m;
        m.path = path;
        m.node = node;
        m.keys(times, values, type);
        const GltfRead r = m.at(0.5);
        EXPECT_TRUE(r.result) << r.error();
        if (r.result && path != "rotation") {
            EXPECT_EQ(r.mesh().positions[0], DVec3(0));
        }
        return r.warnings;
    };
    EXPECT_THAT(warning({1, 0.5F}, {1, 1, 1, 2, 2, 2}),
                HasSubstr("animations[0].channels[0]: accessors[1] key 1 is at 0.5 s, after 1 s"));
    EXPECT_THAT(warning({0, 1}, {1, 1, 1}), HasSubstr("accessors[2] has 3 numbers, and 2 keys"));
    EXPECT_THAT(warning({}, {}), HasSubstr("left out"));
    EXPECT_THAT(warning({0, std::nanf("")}, {1, 1, 1, 2, 2, 2}), HasSubstr("left out"));
    EXPECT_THAT(warning({0}, {1, 1, INFINITY}), HasSubstr("not finite"));
    EXPECT_THAT(warning({0}, {1, 1}, "translation", "VEC2"), HasSubstr("3 are wanted"));
    EXPECT_THAT(warning({0}, {1, 1, 1}, "translation", "VEC3", 7),
                HasSubstr("channels[0].node is 7"));
    EXPECT_THAT(warning({0}, {1, 1, 1}, "pointer"), HasSubstr("neither a node nor weights"));
    EXPECT_THAT(warning({0, 1}, {0, 0, 0, 0, 0, 0, 0, 1}, "rotation", "VEC4"),
                HasSubstr("a quaternion of length 0, which turns nothing"));
    EXPECT_THAT(warning({0}, {1}, "weights", "SCALAR"), HasSubstr("moves nothing"));
}

// A model at rest is shown whatever its animations, targets and weights are.
TEST(GltfAnimation, WhatCannotBeMeantRefusesNothingAtRest) {
    GltfBuilder b;
    b.triangle();
    b.nodes = R"({"mesh":0,"weights":["a",0]})";
    for (const char* const animations : {"7", "[7]", R"([{"name":3,"channels":5,"samplers":{}}])",
                                         R"([{"channels":[{"sampler":9}]}])"})
        for (const char* const targets : {"3", "[3]", R"([{"POSITION":99}])"}) {
            b.primitives = {
                fmt::format(R"({{"attributes":{{"POSITION":0}},"targets":{}}})", targets)};
            b.more = fmt::format(R"(,"animations":{})", animations);
            const GltfRead r = read_gltf_file(b.glb());
            ASSERT_TRUE(r.result) << r.error();
            EXPECT_EQ(r.mesh().faces(), 1U);
        }
}

TEST(GltfAnimation, TargetsAreAddedByWeightsOfTheMeshTheNodeOrTheAnimation) {
    Moving m;
    m.keys({0, 1}, {0, 1, 1, 3}, "SCALAR"); // two weights a key
    const int up = m.b.floats({0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3");
    const int right = m.b.floats({1, 0, 0, 1, 0, 0, 1, 0, 0}, "VEC3");
    m.b.primitives = {fmt::format(
        R"({{"attributes":{{"POSITION":0}},"targets":[{{"POSITION":{}}},{{"POSITION":{}}}]}})", up,
        right)};
    m.path = "weights";
    EXPECT_EQ(m.first(0.5), DVec3(2, 0.5, 0));
    const GltfRead rest = read_gltf_file(m.b.glb());
    EXPECT_EQ(rest.mesh().positions[0], DVec3(0)) << "all are 0";
    m.b.nodes = R"({"mesh":0,"weights":[0.25,0.5]})";
    EXPECT_EQ(read_gltf_file(m.b.glb()).mesh().positions[0], DVec3(0.5, 0.25, 0));
    EXPECT_EQ(m.first(1), DVec3(3, 1, 0)) << "the animation's count before the node's";
}

// Every moment lies within the box by which all of them are framed.
TEST(GltfAnimation, TheReachHoldsEveryMoment) {
    Moving m;
    m.b.nodes = R"({"children":[1]},{"mesh":0,"translation":[5,0,0]})";
    m.keys({0, 1, 2}, {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, -1}, "VEC4");
    m.path = "rotation";
    const Reach reach = *m.at(0).result->reach;
    EXPECT_EQ(*m.at(1.3).result->reach, reach);
    for (double t = 0; t < 2; t += 0.037) {
        const GltfRead r = m.at(t);
        for (const DVec3& at : r.mesh().positions)
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(at[axis], reach.first[axis]) << t;
                EXPECT_LE(at[axis], reach.second[axis]) << t;
            }
    }
    EXPECT_FALSE(read_gltf_file(m.b.glb()).result->reach) << "at rest it is framed by itself";
}

using Long = long double;
using Long3 = std::array<Long, 3>;
using Long16 = std::array<Long, 16>; // columns

Long16 product(const Long16& a, const Long16& b) {
    Long16 out{};
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t r = 0; r < 4; ++r)
            for (std::size_t i = 0; i < 4; ++i)
                out[4 * c + r] += a[4 * i + r] * b[4 * c + i];
    return out;
}
Long16 trs(const Long3& t, const std::array<Long, 4>& q, Long s) {
    const Long x = q[0], y = q[1], z = q[2], w = q[3];
    return {s * (1 - 2 * (y * y + z * z)),
            s * 2 * (x * y + w * z),
            s * 2 * (x * z - w * y),
            0,
            s * 2 * (x * y - w * z),
            s * (1 - 2 * (x * x + z * z)),
            s * 2 * (y * z + w * x),
            0,
            s * 2 * (x * z + w * y),
            s * 2 * (y * z - w * x),
            s * (1 - 2 * (x * x + y * y)),
            0,
            t[0],
            t[1],
            t[2],
            1};
}

// Vertices with two targets on four joints, a chain, each turned by a key: positions at the key are
// those of the sums in long double.
TEST(GltfAnimation, SkinsAndTargetsTogetherAreTheFormulasSums) {
    Random random(81);
    const auto number = [&] { return static_cast<float>(random.in(-1, 1)); };
    constexpr std::size_t kVertices = 300, kJoints = 4;
    double worst = 0;
    for (int round = 0; round < 5; ++round) {
        std::vector<float> positions, targets[2], weights, binds, turns;
        std::vector<std::uint8_t> joints;
        for (std::size_t i = 0; i < kVertices * 3; ++i) {
            positions.push_back(number());
            targets[0].push_back(number());
            targets[1].push_back(number());
        }
        for (std::size_t i = 0; i < kVertices * 4; ++i) {
            weights.push_back(std::abs(number()) + 0.01F);
            joints.push_back(static_cast<std::uint8_t>(random.whole(0, kJoints - 1)));
        }
        for (std::size_t j = 0; j < kJoints; ++j)
            for (int i = 0; i < 16; ++i)
                binds.push_back(i % 4 == 3 ? (i == 15 ? 1.0F : 0.0F) : number());
        GltfBuilder b;
        const int position = b.floats(positions, "VEC3");
        const int one = b.floats(targets[0], "VEC3"), two = b.floats(targets[1], "VEC3");
        const int weight = b.floats(weights, "VEC4");
        const int joint = b.accessor(joints, 5121, "VEC4", kVertices);
        const int bind = b.accessor(binds, 5126, "MAT4", kJoints);
        const int time = b.floats({0}, "SCALAR");
        const std::vector<float> shares = {number(), number()};
        const int share = b.floats(shares, "SCALAR");
        b.primitive(fmt::format(
            R"("attributes":{{"POSITION":{},"JOINTS_0":{},"WEIGHTS_0":{}}},"targets":[{{"POSITION":{}}},{{"POSITION":{}}}],"mode":0)",
            position, joint, weight, one, two));
        b.nodes = R"({"mesh":0,"skin":0})";
        std::string samplers = fmt::format(R"({{"input":{},"output":{}}})", time, share);
        std::string channels = R"({"sampler":0,"target":{"node":0,"path":"weights"}})";
        std::vector<Long16> world;
        for (std::size_t j = 0; j < kJoints; ++j) {
            DVec4 q(number(), number(), number(), number());
            const std::vector<float> keys = {static_cast<float>(q.x), static_cast<float>(q.y),
                                             static_cast<float>(q.z), static_cast<float>(q.w)};
            const Long length =
                std::sqrt(Long(q.x) * q.x + Long(q.y) * q.y + Long(q.z) * q.z + Long(q.w) * q.w);
            const float move = number();
            b.nodes +=
                fmt::format(R"(,{{"translation":[{},0.5,0]{}}})", move,
                            j + 1 < kJoints ? fmt::format(R"(,"children":[{}])", j + 2) : "");
            samplers += fmt::format(R"(,{{"input":{},"output":{}}})", time, b.floats(keys, "VEC4"));
            channels += fmt::format(R"(,{{"sampler":{},"target":{{"node":{},"path":"rotation"}}}})",
                                    j + 1, j + 1);
            const Long16 own =
                trs({move, 0.5L, 0}, {q.x / length, q.y / length, q.z / length, q.w / length}, 1);
            world.push_back(j > 0 ? product(world.back(), own) : own);
        }
        b.scenes = R"({"nodes":[0,1]})";
        b.more = fmt::format(
            R"(,"skins":[{{"joints":[1,2,3,4],"inverseBindMatrices":{}}}],"animations":[{{"channels":[{}],"samplers":[{}]}}])",
            bind, channels, samplers);
        Reading how;
        how.animation = AnimationMoment{"0", 0, {}};
        const GltfRead r = read_gltf_file(b.glb(), "a.glb", how);
        ASSERT_TRUE(r.result) << r.error();
        ASSERT_EQ(r.warnings, "");
        std::vector<Long16> palette;
        for (std::size_t j = 0; j < kJoints; ++j) {
            Long16 m;
            std::copy_n(binds.begin() + static_cast<std::ptrdiff_t>(16 * j), 16, m.begin());
            palette.push_back(product(world[j], m));
        }
        for (std::size_t v = 0; v < kVertices; ++v) {
            Long3 at{}, sum{};
            for (std::size_t i = 0; i < 3; ++i)
                at[i] = Long(positions[3 * v + i]) + Long(shares[0]) * targets[0][3 * v + i] +
                        Long(shares[1]) * targets[1][3 * v + i];
            Long all = 0;
            for (std::size_t k = 0; k < 4; ++k)
                all += weights[4 * v + k];
            for (std::size_t k = 0; k < 4; ++k) {
                const Long16& m = palette[joints[4 * v + k]];
                for (std::size_t i = 0; i < 3; ++i)
                    sum[i] += weights[4 * v + k] / all *
                              (m[i] * at[0] + m[4 + i] * at[1] + m[8 + i] * at[2] + m[12 + i]);
            }
            for (std::size_t i = 0; i < 3; ++i)
                worst = std::max(worst, static_cast<double>(std::abs(
                                            r.mesh().positions[v][static_cast<int>(i)] - sum[i])));
        }
    }
    RecordProperty("worst", ::testing::PrintToString(worst));
    EXPECT_LE(worst, 1e-6); // lengths are about 1
}

} // namespace
} // namespace scanout::io
