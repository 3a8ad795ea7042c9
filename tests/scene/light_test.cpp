// Where lights stand in view space, whatever the camera and whatever numbers the user gives.
#include "scene/light.h"
#include "support/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scanout::scene {
namespace {

geom::Mesh model() {
    geom::Mesh mesh;
    mesh.centre = {10, -20, 30};
    mesh.exponent = 3;
    mesh.radius = 0.75;
    return mesh;
}

View view_from(const geom::Mesh& mesh, const CameraOptions& camera, const Pose& pose = {},
               const Orbit& orbit = {}) {
    const auto view = make_view(mesh, {}, pose, camera, orbit, 640, 480);
    EXPECT_TRUE(view) << view.error().what;
    return view.value_or(View());
}

CameraOptions camera(double azimuth, double elevation, UpAxis up = UpAxis::plus_y) {
    CameraOptions c;
    c.azimuth_degrees = azimuth;
    c.elevation_degrees = elevation;
    c.up = up;
    return c;
}

DVec3 file_to_mesh(const geom::Mesh& mesh, const DVec3& file) {
    return (file - mesh.centre) / 8.0;
}

TEST(LightInView, OfTheWorldStandsStillInTheModelFromEverywhere) {
    const geom::Mesh mesh = model();
    test::Random random(1);
    for (int round = 0; round < 200; ++round) {
        Light light;
        light.kind = LightKind::spot;
        light.position = mesh.centre + random.in_cube(20);
        light.target = mesh.centre + random.in_cube(20);
        const auto up = static_cast<UpAxis>(round % 6);
        Orbit orbit;
        orbit.azimuth = static_cast<int>(random.in(0, 90000));
        orbit.pan_x = static_cast<std::int64_t>(random.in(-1e6, 1e6));
        orbit.zoom = static_cast<int>(random.in(-50, 50));
        const View view =
            view_from(mesh, camera(random.in(0, 360), random.in(-90, 90), up), {}, orbit);
        const ViewLight seen = in_view(light, view, mesh);
        // A vertex of the model at the same place of the file is seen at the same place.
        const DVec3 vertex = view.linear * file_to_mesh(mesh, light.position) + view.translation;
        const DVec3 aim = view.linear * file_to_mesh(mesh, *light.target) + view.translation;
        const DVec3 way = aim - vertex;
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(seen.position[c], vertex[c], 2e-6);
            EXPECT_NEAR(seen.axis[c], way[c] / std::sqrt(dot3(way, way)), 1e-6);
        }
        light.kind = LightKind::directional;
        light.towards = light.position - *light.target;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(in_view(light, view, mesh).towards[c], -seen.axis[c], 1e-6);
    }
}

TEST(LightInView, OfTheWorldDoesNotTurnWithTheModel) {
    const geom::Mesh mesh = model();
    Light light;
    light.kind = LightKind::point;
    light.position = {1, 2, 3};
    Pose pose;
    pose.yaw = 12345;
    pose.zoom = 20;
    pose.pan_x = 4000;
    const View still = view_from(mesh, camera(30, 10)),
               moved = view_from(mesh, camera(30, 10), pose);
    EXPECT_EQ(in_view(light, still, mesh).position, in_view(light, moved, mesh).position);
}

TEST(LightInView, OfTheCameraDoesNotMoveAtAll) {
    const geom::Mesh mesh = model();
    std::vector<Light> all = plain_lights();
    all.insert(all.end(), default_lights().begin(), default_lights().end());
    for (const Light& light : all) {
        EXPECT_FALSE(light.casts);
        const ViewLight from_front = in_view(light, view_from(mesh, camera(0, 0)), mesh);
        const ViewLight from_above = in_view(light, view_from(mesh, camera(77, 55)), mesh);
        EXPECT_EQ(from_front.towards, from_above.towards);
    }
    // Whole-number directions, rounded once.
    const ViewLight key = in_view(plain_lights()[0], View(), mesh);
    EXPECT_EQ(key.towards, Vec3(-2.0F / 7, 3.0F / 7, 6.0F / 7));
    EXPECT_EQ(key.colour, Vec3(0.8F));
    const ViewLight fill = in_view(plain_lights()[1], View(), mesh);
    EXPECT_EQ(fill.towards, Vec3(6.0F / 7, -2.0F / 7, 3.0F / 7));
    EXPECT_EQ(fill.colour, Vec3(0.15F));
    EXPECT_EQ(in_view(plain_lights()[2], View(), mesh).colour, Vec3(kAmbient));
}

// The look of the design: a key from above left that outshines all else, a weak fill from the other
// side, and more light from the sky than from the ground.
TEST(DefaultLights, AreAKeyAFillAndAHemisphereThatAreWhiteTogetherAtMost) {
    const std::vector<Light>& lights = default_lights();
    ASSERT_EQ(lights.size(), 3U);
    const Light &key = lights[0], &fill = lights[1], &hemisphere = lights[2];
    EXPECT_LT(key.towards.x, 0);
    EXPECT_GT(key.towards.y, 0);
    EXPECT_GT(key.towards.z, 0) << "behind the eye";
    EXPECT_GT(fill.towards.x, 0);
    EXPECT_LT(fill.power, key.power / 4);
    EXPECT_EQ(hemisphere.kind, LightKind::hemisphere);
    EXPECT_EQ(hemisphere.towards, DVec3(0, 1, 0));
    EXPECT_GT(hemisphere.colour.x, 2 * hemisphere.ground.x);
    EXPECT_LE(key.power + fill.power + hemisphere.power, 1.07);
}

TEST(LightInView, IsAsBrightAtTheModelsCentreAsItsPowerSays) {
    const geom::Mesh mesh = model();
    const View view = view_from(mesh, camera(10, 20));
    for (const double radii : {1.0, 2.5, 1000.0}) {
        Light light;
        light.kind = LightKind::point;
        light.position = mesh.centre + DVec3(0, radii * 6, 0); // a radius is 0.75 * 8
        EXPECT_NEAR(in_view(light, view, mesh).reach, radii, radii * 1e-6);
    }
    Light inside;
    inside.kind = LightKind::point;
    inside.position = mesh.centre;
    EXPECT_EQ(in_view(inside, view, mesh).reach, 1);
}

TEST(LightInView, IsFiniteWhateverTheNumbers) {
    for (const double radius : {0.75, 0.0, 1e-300}) {
        geom::Mesh mesh = model();
        mesh.radius = radius;
        const View view = radius == 0.75 ? view_from(mesh, camera(10, 20)) : View();
        for (const double far : {0.0, 1e-300, 1e8, 1e30, 1e300, -1.7e308}) {
            for (const auto kind :
                 {LightKind::directional, LightKind::point, LightKind::spot, LightKind::ambient}) {
                Light light;
                light.kind = kind;
                light.position = DVec3(far, -far, far / 3);
                light.towards = DVec3(far, 1e-300, far);
                light.target = DVec3(-far, 0, far);
                light.size = std::abs(far);
                light.power = 1e300;
                const ViewLight seen = in_view(light, view, mesh);
                for (int c = 0; c < 3; ++c) {
                    EXPECT_TRUE(std::isfinite(seen.towards[c])) << far;
                    EXPECT_TRUE(std::isfinite(seen.position[c])) << far;
                    EXPECT_TRUE(std::isfinite(seen.axis[c])) << far;
                    EXPECT_LE(seen.colour[c], kMaxPower);
                }
                EXPECT_LT(seen.reach * seen.reach, 1e20F);
                EXPECT_LT(seen.nearest * seen.nearest, 1e20F);
                EXPECT_TRUE(std::isfinite(seen.size));
            }
        }
    }
}

TEST(LightInView, FarAwayIsDirectional) {
    const geom::Mesh mesh = model();
    const View view = view_from(mesh, camera(30, 10));
    Light far, sun;
    far.kind = LightKind::point;
    far.position = DVec3(1e300, 2e300, -1e300);
    sun.towards = {1, 2, -1};
    const ViewLight point = in_view(far, view, mesh), parallel = in_view(sun, view, mesh);
    const double length = std::sqrt(dot3(DVec3(point.position), DVec3(point.position)));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(point.position[c] / length, parallel.towards[c], 1e-6);
}

} // namespace
} // namespace scanout::scene
