// The fitted camera: what the vertices' projections say, for every view, projection and shape.
#include "scene/fit.h"
#include "support/meshes.h"
#include "support/random.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace scanout::scene {
namespace {

using scanout::test::Random;

struct Extent {
    double left = INFINITY, right = -INFINITY, bottom = INFINITY, top = -INFINITY;
    double nearest = INFINITY; // to the eye
    double widest() const { return std::max({-left, right, -bottom, top}); }
};

// Of the projected vertices: -1 to 1 is from edge to edge.
Extent extent_of(const geom::Mesh& mesh, const View& view) {
    Extent e;
    for (const Vec3& position : mesh.position) {
        const DVec3 p = view.linear * DVec3(position) + view.translation;
        const double away = view.projection == Projection::perspective ? -p.z : 1;
        EXPECT_GT(away, 0);
        e.nearest = std::min(e.nearest, -p.z);
        e.left = std::min(e.left, p.x / (away * view.half_width));
        e.right = std::max(e.right, p.x / (away * view.half_width));
        e.bottom = std::min(e.bottom, p.y / (away * view.half_height));
        e.top = std::max(e.top, p.y / (away * view.half_height));
    }
    return e;
}

// A cloud within a box of these sides, as a model is: about its centre, of radius 1.
geom::Mesh cloud(Random& random, const DVec3& sides) {
    geom::Mesh mesh = scanout::test::empty_mesh();
    mesh.radius = 1;
    for (int i = 0; i < 50; ++i)
        mesh.position.emplace_back(random.in_cube(1) * sides / length(sides));
    return mesh;
}

View view_of(const geom::Mesh& mesh, const ModelTransform& model, const CameraOptions& camera,
             int width, int height) {
    const auto view =
        make_view(mesh, model, {}, fitted(mesh, model, camera, static_cast<double>(width) / height),
                  {}, width, height);
    EXPECT_TRUE(view) << view.error().what;
    return *view;
}

TEST(Fit, FillsNineTenthsOfOneSideAndIsCentredOnBoth) {
    Random random(4);
    for (const Projection projection : {Projection::perspective, Projection::orthographic})
        for (const auto& [width, height] : {std::pair(640, 480), {300, 900}, {64, 64}})
            for (int round = 0; round < 60; ++round) {
                const geom::Mesh mesh =
                    cloud(random, {random.in(0.01, 1), random.in(0.01, 1), random.in(0.01, 1)});
                CameraOptions camera;
                camera.projection = projection;
                camera.azimuth_degrees = random.in(0, 360);
                camera.elevation_degrees = random.in(-90, 90);
                camera.fov_degrees = random.in(10, 100);
                ModelTransform model;
                model.rotate_degrees = random.in_cube(180);
                const Extent e = extent_of(mesh, view_of(mesh, model, camera, width, height));
                EXPECT_NEAR(e.left, -e.right, 1e-6) << round;
                EXPECT_NEAR(e.bottom, -e.top, 1e-6) << round;
                EXPECT_LE(e.widest(), kFitFill + 1e-9);
                // But for the least gap to the eye, which needles that point to it meet.
                if (e.nearest > 0.251) {
                    EXPECT_NEAR(e.widest(), kFitFill, 1e-9) << round;
                }
            }
}

TEST(Fit, LeavesACameraThatStandsSomewhereAsItIs) {
    Random random(5);
    const geom::Mesh mesh = cloud(random, DVec3(1));
    CameraOptions camera;
    camera.distance = 2.5;
    EXPECT_EQ(fitted(mesh, {}, camera, 1.5).distance, 2.5);
    EXPECT_EQ(fitted(mesh, {}, camera, 1.5).shift, DVec2(0));
    camera = {};
    camera.eye = DVec3(0, 0, 9);
    camera.target = DVec3(0);
    EXPECT_EQ(fitted(mesh, {}, camera, 1.5).distance, 0);
    EXPECT_EQ(fitted(scanout::test::empty_mesh(), {}, {}, 1.5).distance, 0) << "nothing to fit";
}

// What the user asks to be moved is moved.
TEST(Fit, TakesNoNoticeOfTranslationsAndSizes) {
    Random random(6);
    const geom::Mesh mesh = cloud(random, {1, 0.5, 0.2});
    ModelTransform plain, moved;
    plain.scale = {1, 0.5, -0.25};
    moved.scale = {4, 2, -1};
    moved.translate = {0.5, 0, 0};
    const CameraOptions a = fitted(mesh, plain, {}, 1.5), b = fitted(mesh, moved, {}, 1.5);
    EXPECT_EQ(a.distance, b.distance);
    EXPECT_EQ(a.shift, b.shift);
    EXPECT_NE(a.distance, fitted(mesh, {}, {}, 1.5).distance) << "the ratios count";
}

TEST(Fit, OfATurntableHoldsEveryPicture) {
    Random random(7);
    for (const int turns : {3, 16, 100}) {
        const geom::Mesh mesh = cloud(random, {1, 0.3, 0.1});
        CameraOptions camera;
        camera.elevation_degrees = 20;
        camera = fitted(mesh, {}, camera, 1.5, turns);
        double widest = 0;
        for (int i = 0; i < turns; ++i) {
            Pose pose;
            pose.yaw = wrap_angle(std::int64_t{kFullTurn} * i / turns);
            const auto view = make_view(mesh, {}, pose, camera, {}, 600, 400);
            widest = std::max(widest, extent_of(mesh, *view).widest());
        }
        EXPECT_LT(widest, 0.95) << turns;
        EXPECT_GT(widest, 0.85) << turns;
    }
}

TEST(Fit, NoOrderOfVerticesChangesABit) {
    Random random(8);
    geom::Mesh mesh = cloud(random, {1, 0.4, 0.6});
    CameraOptions camera;
    camera.azimuth_degrees = 33;
    const CameraOptions first = fitted(mesh, {}, camera, 1.5);
    std::reverse(mesh.position.begin(), mesh.position.end());
    const CameraOptions second = fitted(mesh, {}, camera, 1.5);
    EXPECT_EQ(first.distance, second.distance);
    EXPECT_EQ(first.shift, second.shift);
}

} // namespace
} // namespace scanout::scene
