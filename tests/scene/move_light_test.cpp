// Lights as keys move them: integers in, and back where they began.
#include "scene/light.h"
#include "support/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scanout::scene {
namespace {

geom::Mesh lit_model() {
    geom::Mesh mesh;
    mesh.centre = {10, -20, 30};
    mesh.radius = 0.75;
    return mesh;
}

Light light_of(LightKind kind, test::Random& random) {
    Light light;
    light.kind = kind;
    light.towards = random.in_cube(3);
    light.position = lit_model().centre + random.in_cube(9);
    light.power = 0.7;
    return light;
}

constexpr LightKind kKinds[] = {LightKind::ambient, LightKind::directional, LightKind::point,
                                LightKind::spot};

TEST(MoveLight, ByNothingLeavesEveryBit) {
    test::Random random(1);
    for (const LightKind kind : kKinds)
        for (int up = 0; up < 6; ++up) {
            const Light light = light_of(kind, random);
            EXPECT_EQ(moved(light, {}, static_cast<UpAxis>(up), lit_model()), light);
        }
    for (const Light& light : default_lights())
        EXPECT_EQ(moved(light, {}, UpAxis::plus_y, lit_model()), light);
}

TEST(MoveLight, AddsToAzimuthAndElevationAndKeepsTheDistance) {
    test::Random random(2);
    const geom::Mesh mesh = lit_model();
    for (int round = 0; round < 300; ++round) {
        const auto up = static_cast<UpAxis>(round % 6);
        const Light light = light_of(kKinds[1 + round % 3], random);
        const LightPlace before = place_of(light, up, mesh);
        LightMove move;
        move.azimuth = static_cast<int>(random.in(0, kFullTurn));
        move.elevation = static_cast<int>(random.in(-100, 100) * kAngleUnitsPerDegree);
        move.level = kZoomLevelsPerOctave;
        const Light after = moved(light, move, up, mesh);
        EXPECT_DOUBLE_EQ(after.power, 1.4);
        const LightPlace place = place_of(after, up, mesh);
        const double units = kAngleUnitsPerDegree;
        const double elevation =
            std::clamp(before.elevation_degrees + move.elevation / units, -90.0, 90.0);
        EXPECT_NEAR(place.elevation_degrees, elevation, 1e-6);
        if (std::abs(elevation) < 89.9) {
            const double turn =
                before.azimuth_degrees + move.azimuth / units - place.azimuth_degrees;
            EXPECT_NEAR(std::remainder(turn, 360.0), 0, 1e-6);
        }
        const auto length = [&](const Light& l) {
            const DVec3 at =
                light.kind == LightKind::directional ? l.towards : l.position - mesh.centre;
            return std::sqrt(dot3(at, at));
        };
        EXPECT_NEAR(length(after), length(light), 1e-9);
    }
}

TEST(MoveLight, FollowsTheCamerasConvention) {
    // Azimuth 0 is the front, +z; 90 is the right, +x; elevation 90 is above.
    Light light;
    light.kind = LightKind::point;
    const geom::Mesh mesh = lit_model();
    light.position = mesh.centre + DVec3(0, 0, 2);
    LightMove move;
    move.azimuth = 90 * kAngleUnitsPerDegree;
    const DVec3 right = moved(light, move, UpAxis::plus_y, mesh).position - mesh.centre;
    EXPECT_NEAR(right.x, 2, 1e-12);
    move = {};
    move.elevation = 90 * kAngleUnitsPerDegree;
    const DVec3 above = moved(light, move, UpAxis::plus_y, mesh).position - mesh.centre;
    EXPECT_NEAR(above.y, 2, 1e-12);
    // With z up, the file's z is above.
    light.position = mesh.centre + DVec3(0, -2, 0); // the front
    const DVec3 top = moved(light, move, UpAxis::plus_z, mesh).position - mesh.centre;
    EXPECT_NEAR(top.z, 2, 1e-12);
    EXPECT_NEAR(place_of(light, UpAxis::plus_z, mesh).azimuth_degrees, 0, 1e-12);
}

TEST(MoveLight, OfTheCameraMovesAboutTheEyesAxes) {
    Light head;
    head.frame = LightFrame::camera;
    LightMove move;
    move.azimuth = 90 * kAngleUnitsPerDegree;
    for (int up = 0; up < 6; ++up) {
        const Light turned = moved(head, move, static_cast<UpAxis>(up), lit_model());
        EXPECT_NEAR(turned.towards.x, 1, 1e-12);
        EXPECT_NEAR(turned.towards.z, 0, 1e-12);
    }
}

} // namespace
} // namespace scanout::scene
