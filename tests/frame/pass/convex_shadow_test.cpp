// A convex body of many faces, as a ball is, throws no shadow on itself: no pass runs for it, and
// where one does, it takes nothing.
#include "frame/shadow_shares.h"
#include "math/rotation.h"
#include "math/transcendental.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::frame {
namespace {

// 20 faces of an icosahedron, each cut into four so many times.
geom::Mesh icosphere(bool smooth, int cuts = 2) {
    std::vector<std::array<DVec3, 3>> faces;
    const double g = (1 + std::sqrt(5.0)) / 2;
    std::vector<DVec3> corners;
    for (int axis = 0; axis < 3; ++axis)
        for (const double a : {-1.0, 1.0})
            for (const double b : {-g, g}) {
                DVec3 p(0);
                p[(axis + 1) % 3] = a;
                p[(axis + 2) % 3] = b;
                corners.push_back(normalized(p));
            }
    const double side = 2 / std::sqrt(1 + g * g);
    const auto near = [&](const DVec3& p, const DVec3& q) { return length(p - q) < side * 1.01; };
    for (std::size_t i = 0; i < 12; ++i)
        for (std::size_t j = i + 1; j < 12; ++j)
            for (std::size_t k = j + 1; k < 12; ++k) {
                const DVec3 &a = corners[i], &b = corners[j], &c = corners[k];
                if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
                if (dot3(cross3(b - a, c - a), a) > 0)
                    faces.push_back({a, b, c});
                else
                    faces.push_back({a, c, b});
            }
    for (int cut = 0; cut < cuts; ++cut) {
        std::vector<std::array<DVec3, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const DVec3 ab = normalized(a + b), bc = normalized(b + c), ca = normalized(c + a);
            for (const std::array<DVec3, 3>& face :
                 {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
                finer.push_back(face);
        }
        faces = finer;
    }
    geom::Mesh mesh = test::empty_mesh();
    for (const std::array<DVec3, 3>& face : faces) {
        const DVec3 own = normalized(cross3(face[1] - face[0], face[2] - face[0]));
        std::array<std::uint32_t, 3> corner{};
        for (std::size_t k = 0; k < 3; ++k)
            corner[k] = test::add_vertex(mesh, Vec3(face[k] * 0.8), Vec3(smooth ? face[k] : own));
        test::add_triangle(mesh, corner[0], corner[1], corner[2], 0);
    }
    return mesh;
}

TEST(ConvexShadow, AConvexModelOfManyFacesRunsNoShadowPass) {
    for (const bool smooth : {false, true}) {
        test::Shot s = test::shot("icosphere");
        s.scene.materials = {test::plain(Vec3(0.7F))};
        s.scene.mesh = icosphere(smooth);
        EXPECT_EQ(s.scene.mesh.triangles(), 320U);
        scene::Light lamp = test::light_of(scene::LightKind::directional, 0.9);
        lamp.casts = true;
        s.options.lights = {lamp};
        FrameStats stats;
        const image::Image without = test::draw(s, {.stats = &stats});
        EXPECT_EQ(stats.shadow_bytes, 0U) << smooth;
        s.options.effects["shadow"] = true;
        EXPECT_EQ(test::draw(s), without) << smooth;
    }
}

// Faces turn away from the lamp where their normals do not. By the faces alone single triangles
// would be dark among lit ones (HARD-CASES 74).
TEST(ConvexShadow, ASmoothBallIsLitAsARoundOneByEveryTechnique) {
    int lit = 0;
    for (const int cuts : {0, 1, 2}) {
        test::Shot s = test::shot("icosphere", 96, 96);
        s.scene.materials = {test::plain(Vec3(0.7F), Vec3(0.5F), 20)};
        s.scene.mesh = icosphere(true, cuts);
        for (const auto kind : {scene::LightKind::directional, scene::LightKind::point}) {
            for (int turn = 0; turn < 12; ++turn) {
                scene::Light lamp = test::lamp(kind);
                lamp.towards = {sin_degrees(turn * 30.0), 0.3, cos_degrees(turn * 30.0)};
                lamp.position = lamp.towards * 2.0;
                s.options.lights = {lamp};
                for (const char* technique : {"map", "map_pcf", "map_soft", "volume"}) {
                    s.options.lights[0].size = technique != std::string("map_soft")    ? 0
                                               : kind == scene::LightKind::directional ? 3
                                                                                       : 0.05;
                    int dark = 0;
                    double least = 1;
                    for (const double share : test::shares(s, technique)) {
                        if (share < 0) continue;
                        ++lit;
                        dark += share != 1 ? 1 : 0;
                        least = std::min(least, share);
                    }
                    EXPECT_EQ(dark, 0) << technique << ' ' << cuts << ' ' << turn << ' '
                                       << name_of(kind) << ' ' << least;
                }
            }
        }
    }
    EXPECT_GT(lit, 100'000);
}

} // namespace
} // namespace scanout::frame
