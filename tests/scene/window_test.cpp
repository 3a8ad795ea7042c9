// Near and far planes and the sides of the picture, against the documents' matrices.
#include "math/rotation.h"
#include "scene/view.h"
#include "support/meshes.h"
#include "support/random.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::scene {
namespace {

using test::Random;

Result<View> windowed(const CameraOptions& camera, int width = 80, int height = 60) {
    return make_view(test::empty_mesh(), {}, {}, camera, {}, width, height);
}

// [Compendium 8.2]: x' = (2n x + (r + l) z)/(r - l) over -z, and likewise y; of an orthographic one
// x' = (2x - (r + l))/(r - l).
TEST(Window, PlacesAreSeenWhereTheDocumentsMatrixHasThem) {
    Random random(1);
    for (int i = 0; i < 500; ++i) {
        const double l = random.in(-2, 0.5), r = l + random.in(0.1, 2), b = random.in(-2, 0.5),
                     t = b + random.in(0.1, 2), n = random.in(0.1, 3), f = n + random.in(0.1, 9);
        const bool perspective = i % 2 == 0;
        CameraOptions camera;
        camera.projection = perspective ? Projection::perspective : Projection::orthographic;
        camera.window = Window{camera.projection, l, r, b, t};
        camera.near = n;
        camera.far = f;
        const auto view = windowed(camera);
        ASSERT_TRUE(view) << view.error().what;
        const DVec3 p(random.in(-3, 3), random.in(-3, 3), -random.in(n, f));
        const double x = perspective ? (2 * n * p.x + (r + l) * p.z) / (r - l) / -p.z
                                     : (2 * p.x - (r + l)) / (r - l),
                     y = perspective ? (2 * n * p.y + (t + b) * p.z) / (t - b) / -p.z
                                     : (2 * p.y - (t + b)) / (t - b);
        const DVec2 point = picture_point(*view, p, 80, 60);
        const double size = 1 + std::abs(x) + std::abs(y);
        EXPECT_NEAR(point.x, (x + 1) / 2 * 80, 1e-10 * size) << i;
        EXPECT_NEAR(point.y, (1 - y) / 2 * 60, 1e-10 * size) << i;
        EXPECT_EQ(view->cut_far, f);
        EXPECT_EQ(perspective ? view->near_distance : view->cut_near, n);
    }
}

TEST(Window, WithoutPlanesNothingIsCut) {
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        CameraOptions camera;
        camera.projection = projection;
        const View view = *windowed(camera);
        EXPECT_EQ(view.cut_far, std::numeric_limits<double>::infinity());
        EXPECT_EQ(view.cut_near, -std::numeric_limits<double>::infinity());
        EXPECT_EQ(view.middle, DVec2(0));
        // A window is of one projection alone.
        camera.window = Window{projection == Projection::perspective ? Projection::orthographic
                                                                     : Projection::perspective,
                               -1, 2, -1, 2};
        camera.near = 1;
        camera.far = 2;
        const View other = *windowed(camera);
        EXPECT_EQ(other.half_width, view.half_width);
        EXPECT_EQ(other.near_distance, view.near_distance);
        EXPECT_EQ(other.cut_far, view.cut_far);
    }
}

TEST(Window, PlanesAndSidesThatCannotBeAreRefused) {
    const auto error = [](auto change) {
        CameraOptions camera;
        change(camera);
        const auto view = windowed(camera);
        return view ? std::string() : view.error().what;
    };
    using testing::HasSubstr;
    EXPECT_THAT(error([](CameraOptions& c) { c.near = 0; }), HasSubstr("before the eye"));
    EXPECT_THAT(error([](CameraOptions& c) { c.far = 0; }), HasSubstr("beyond the eye"));
    EXPECT_THAT(error([](CameraOptions& c) {
                    c.near = 2;
                    c.far = 2;
                }),
                HasSubstr("beyond the near plane, 2"));
    EXPECT_THAT(error([](CameraOptions& c) {
                    c.window = Window{Projection::perspective, 1, -1, -1, 1};
                }),
                HasSubstr("left must be below right"));
    const auto flat = [](CameraOptions& c) { c.projection = Projection::orthographic; };
    EXPECT_EQ(error([&](CameraOptions& c) {
                  flat(c);
                  c.near = -3;
                  c.far = -1;
              }),
              "");
}

// [Primer 1.4.6]
TEST(Window, TheAngleIsOfTheHeightOfTheWidthOrOfBoth) {
    const double tangent = std::tan(22.5 * 3.14159265358979 / 180);
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        CameraOptions camera;
        camera.projection = projection;
        camera.distance = 5;
        const double half = projection == Projection::perspective ? tangent : 5 * tangent;
        const auto extents = [&](ScreenFit fit) {
            camera.screen_fit = fit;
            const View view = *windowed(camera, 80, 40);
            return DVec2(view.half_width, view.half_height);
        };
        EXPECT_LT(length(DVec3(extents(ScreenFit::height) - DVec2(2 * half, half), 0)), 1e-12);
        EXPECT_LT(length(DVec3(extents(ScreenFit::width) - DVec2(half, half / 2), 0)), 1e-12);
        EXPECT_LT(length(DVec3(extents(ScreenFit::stretch) - DVec2(half, half), 0)), 1e-12);
    }
}

} // namespace
} // namespace scanout::scene
