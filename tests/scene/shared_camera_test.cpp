// A camera for two models: a place of space is at the same place of both pictures.
#include "scene/shared_camera.h"
#include "support/meshes.h"
#include "support/random.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace scanout::scene {
namespace {

using scanout::test::Random;

// A cloud of vertices about `centre`, both in the file's unit.
geom::Mesh cloud(Random& random, const DVec3& centre, int exponent, double radius) {
    geom::Mesh mesh = scanout::test::empty_mesh();
    mesh.centre = centre;
    mesh.exponent = exponent;
    mesh.radius = radius;
    for (int i = 0; i < 40; ++i)
        mesh.position.emplace_back(random.in_cube(0.5) * radius);
    return mesh;
}

// Where a place of the file is in the picture; -1 to 1 from edge to edge.
DVec2 seen(const geom::Mesh& mesh, const View& view, const DVec3& file) {
    const DVec3 p = view.linear * (radii_from_centre(mesh, file) * mesh.radius) + view.translation;
    const double away = view.projection == Projection::perspective ? -p.z : 1;
    return {p.x / (away * view.half_width), p.y / (away * view.half_height)};
}

TEST(SharedCamera, ShowsEachPlaceOfTheFilesAtTheSamePlaceOfBothPicturesAndAllOfBoth) {
    Random random(3);
    for (int round = 0; round < 200; ++round) {
        const geom::Mesh a = cloud(random, random.in_cube(50), 3, random.unit() * 0.5 + 0.5);
        const geom::Mesh b =
            cloud(random, a.centre + random.in_cube(20), 1 + round % 4, random.unit() * 0.5 + 0.5);
        CameraOptions camera;
        camera.azimuth_degrees = round * 7.0;
        camera.elevation_degrees = round % 5 == 0 ? 90 : round % 89;
        camera.projection = round % 2 == 0 ? Projection::perspective : Projection::orthographic;
        camera.up = round % 3 == 0 ? UpAxis::plus_z : UpAxis::plus_y;
        const auto [of_a, of_b] = shared_cameras(a, b, camera, 1.5);
        const auto view_a = make_view(a, {}, {}, of_a, {}, 150, 100);
        const auto view_b = make_view(b, {}, {}, of_b, {}, 150, 100);
        ASSERT_TRUE(view_a && view_b);
        double widest = 0;
        for (const geom::Mesh* mesh : {&a, &b})
            for (const Vec3& position : mesh->position) {
                const DVec3 file = mesh->centre + DVec3(position) * std::ldexp(1.0, mesh->exponent);
                const DVec2 in_a = seen(a, *view_a, file), in_b = seen(b, *view_b, file);
                ASSERT_NEAR(in_a.x, in_b.x, 1e-9) << round;
                ASSERT_NEAR(in_a.y, in_b.y, 1e-9) << round;
                widest = std::max({widest, std::abs(in_a.x), std::abs(in_a.y)});
            }
        EXPECT_NEAR(widest, 0.9, 0.001) << round;
    }
}

TEST(SharedCamera, LeavesAnEyeWhereItIs) {
    Random random(4);
    const geom::Mesh a = cloud(random, {1, 2, 3}, 2, 0.7), b = cloud(random, {4, 5, 6}, 3, 0.8);
    CameraOptions camera;
    camera.eye = DVec3(9, 9, 9);
    camera.target = DVec3(0);
    const auto [of_a, of_b] = shared_cameras(a, b, camera, 1);
    EXPECT_EQ(of_a.eye, camera.eye);
    EXPECT_EQ(of_b.target, camera.target);
    EXPECT_FALSE(of_a.pivot);
}

// In the file's unit they are the same for both, whether the camera has an eye or is fitted.
TEST(SharedCamera, CutsBothAtTheSamePlanes) {
    Random random(5);
    const geom::Mesh a = cloud(random, {1, 2, 3}, 2, 0.7), b = cloud(random, {4, 5, 6}, 3, 0.8);
    CameraOptions camera;
    camera.near = 0.5;
    camera.far = 3;
    camera.window = Window{camera.projection, -0.1, 0.2, -0.3, 0.4};
    for (const bool eye : {false, true}) {
        if (eye) camera.eye = DVec3(9, 9, 9);
        if (eye) camera.target = DVec3(0);
        const auto [of_a, of_b] = shared_cameras(a, b, camera, 1);
        const double of_first = 1 / radii_per_unit(a), of_second = 1 / radii_per_unit(b);
        EXPECT_NEAR(*of_a.near * of_first, *of_b.near * of_second, 1e-12);
        EXPECT_NEAR(*of_a.far * of_first, *of_b.far * of_second, 1e-12);
        EXPECT_NEAR(of_a.window->top * of_first, of_b.window->top * of_second, 1e-12);
        EXPECT_EQ(*of_a.near, 0.5);
    }
}

} // namespace
} // namespace scanout::scene
