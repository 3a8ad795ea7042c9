// The documents' matrices and worked examples, held against ours.
#include "math/transcendental.h"
#include "textbook/projection.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scanout::textbook::test {
namespace {

scene::View square_view(double half = 1) {
    scene::View view;
    view.half_width = view.half_height = half;
    view.near_distance = 1;
    return view;
}
Parts parts_with(Conventions conventions, Hidden hidden = Hidden::z_pseudo) {
    Parts parts;
    parts.conventions = conventions;
    parts.hidden = hidden;
    return parts;
}

// [ClipSpace 6]: l = b = -1, r = t = 1, n = 1, f = 10 take (1, 1, 0) to (1, 1, -2.2222, 0).
TEST(Documents, ThePointInTheEyesPlaneHasNoW) {
    const Projection p(square_view(), parts_with({-1}), 1, 10);
    const DVec4 clip = p.clip_of(DVec3(1, 1, 0));
    EXPECT_EQ(clip.x, 1);
    EXPECT_EQ(clip.y, 1);
    EXPECT_NEAR(clip.z, -2.2222, 5e-5);
    EXPECT_EQ(clip.w, 0);
    for (const Plane& plane : p.planes())
        if (plane.distance(clip) < 0) return; // cut before the division
    FAIL() << "no plane rejects it";
}

// [ClipSpace 4.2]: C = (f + n)/(f - n), D = 2 f n/(n - f): -1 at near, 1 at far.
TEST(Documents, PseudoDepthOfTheCompendiumRunsFromMinusOneToOne) {
    const double n = 25, f = 400;
    const DepthRow row = pseudo_depth(n, f, -1);
    EXPECT_NEAR(row.c, (f + n) / (f - n), 1e-12);
    EXPECT_NEAR(row.d, 2 * f * n / (n - f), 1e-12);
    EXPECT_NEAR(row.c + row.d / n, -1, 1e-12);
    EXPECT_NEAR(row.c + row.d / f, 1, 1e-12);
}

// [SoftwareGraphics]: A + B/n = 0, A + B/f = 1.
TEST(Documents, DepthOfDirect3dRunsFromZeroToOne) {
    const double n = 0.5, f = 100;
    const DepthRow row = pseudo_depth(n, f, 0);
    EXPECT_NEAR(row.c, f / (f - n), 1e-12);
    EXPECT_NEAR(row.d, -f * n / (f - n), 1e-12);
}

// [Course 2.2] means 0 to 1; its matrix gives 1/f at the far plane, because the orthographic row is
// applied before the division by z and not after it.
TEST(Documents, TheCoursesDepthEndsAtOneOverF) {
    const double n = 1, f = 50;
    const DepthRow row = course_depth(n, f);
    EXPECT_EQ(row.c * n + row.d, 0);
    EXPECT_NEAR(row.c + row.d / f, 1 / f, 1e-12);
    double before = -1; // still monotone, so that a z-buffer works
    for (double z = n; z <= f; z += 0.5) {
        EXPECT_GT(row.c + row.d / z, before);
        before = row.c + row.d / z;
    }
}

// [ClipSpace 4.2]: z' = (2z - (f + n))/(f - n) is a square of z before the division: the middle of
// a line in space is not its middle there. C z + D is.
TEST(Documents, LinearDepthIsBentBeforeTheDivisionAndPseudoDepthIsNot) {
    const DVec3 a(0, 0, -2), b(0, 0, -8);
    for (const auto& [hidden, straight] : {std::pair{Hidden::z_linear, false},
                                           {Hidden::z_squared, false},
                                           {Hidden::z_pseudo, true}}) {
        const Projection p(square_view(), parts_with({}, hidden), 1, 10);
        const double middle = p.clip_of((a + b) * 0.5).z,
                     mean = (p.clip_of(a).z + p.clip_of(b).z) / 2;
        EXPECT_EQ(std::abs(middle - mean) < 1e-12, straight) << middle << " and " << mean;
    }
}

// [Course 2.2] cot(fov/2)/aspect and cot(fov/2); [SoftwareGraphics] 1/(r tan(a/2)) and 1/tan(a/2):
// the camera's half extents at distance 1 are their inverses.
TEST(Documents, TheFieldOfViewScalesAsTheDocumentsMatricesDo) {
    geom::Mesh mesh;
    mesh.radius = 1;
    scene::CameraOptions camera;
    camera.fov_degrees = 50;
    const auto view = scene::make_view(mesh, {}, {}, camera, {}, 640, 400);
    ASSERT_TRUE(view);
    const double cot = 1 / scanout::tan(scanout::radians(25));
    EXPECT_NEAR(1 / view->half_height, cot, 1e-12);
    EXPECT_NEAR(1 / view->half_width, cot / 1.6, 1e-12);
}

// [ClipSpace 4]: x'' = 2 n x/(r - l) - z (r + l)/(r - l), with l = -320, r = 320, b = -240, t =
// 240, n = 25.
TEST(Documents, TheFrustumOfSixNumbersIsTheHalfExtentsTimesNear) {
    scene::View view;
    view.half_width = 320.0 / 25;
    view.half_height = 240.0 / 25;
    const Projection p(view, parts_with({-1}), 25, 1000);
    const DVec4 clip = p.clip_of(DVec3(100, -60, -200)); // z = 200 in the document's system
    EXPECT_NEAR(clip.x, 2 * 25 * 100.0 / 640, 1e-12);
    EXPECT_NEAR(clip.y, 2 * 25 * -60.0 / 480, 1e-12);
    EXPECT_EQ(clip.w, 200);
}

// The range of depth moves no pixel: the same point of the screen in all systems.
TEST(Documents, EverySystemSeesAPointAtTheSamePixel) {
    for (const Renderer r : {Renderer::textbook, Renderer::compendium, Renderer::course,
                             Renderer::software_graphics}) {
        const Projection p(square_view(0.75), parts_of(r), 1, 10);
        const Corner c = p.on_screen({p.clip_of(DVec3(0.5, -0.25, -4)), {}}, 320, 240);
        EXPECT_NEAR(c.x, 160 + 160 * 0.5 / 3, 1e-12);
        EXPECT_NEAR(c.y, 120 + 120 * 0.25 / 3, 1e-12);
        EXPECT_EQ(c.w, 4);
    }
}

// [Compendium 3.1]: between 1 at x = 1 and 8 at x = 5, linear interpolation gives 4.5 at x = 3.
TEST(Documents, LinearInterpolationOfTheFirstExample) {
    Values a{}, b{};
    a[0] = 1;
    b[0] = 8;
    EXPECT_EQ(mix(a, b, (3.0 - 1) / (5 - 1))[0], 4.5);
}

// [SoftwareGraphics]: u = (5, 4), v = (10, 8), t = 0.6 give (8, 6.4).
TEST(Documents, LinearInterpolationOfTheSecondExample) {
    Values u{}, v{};
    u[0] = 5;
    u[1] = 4;
    v[0] = 10;
    v[1] = 8;
    EXPECT_EQ(mix(u, v, 0.6)[0], 8);
    EXPECT_DOUBLE_EQ(mix(u, v, 0.6)[1], 6.4);
}

} // namespace
} // namespace scanout::textbook::test
