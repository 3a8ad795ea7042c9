// T13 [Course 1.2.4]: "rotation and scaling commute".
#include "math/rotation.h"
#include "textbook/trap_page.h"

#include <cmath>

namespace scanout::textbook::test {
namespace {

DMat3 scaling(const DVec3& s) {
    DMat3 m(1);
    for (int i = 0; i < 3; ++i)
        m[i][i] = s[i];
    return m;
}
double largest_difference(const DMat3& a, const DMat3& b) {
    double most = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            most = std::max(most, std::abs(a[c][r] - b[c][r]));
    return most;
}

TEST(Trap13, RotationAndScalingCommuteForOneScaleAlone) {
    const DMat3 turn = rotation_z(45), even = scaling(DVec3(2)), uneven = scaling({2, 0.5, 1});
    EXPECT_LT(largest_difference(turn * even, even * turn), 1e-15);
    EXPECT_NEAR(largest_difference(turn * uneven, uneven * turn), 1.5 * std::sqrt(0.5), 1e-12);

    Shot s = scanout::test::shot("cube", 96, 72);
    s.scene.materials = {scanout::test::plain({0.7F, 0.5F, 0.2F})};
    scanout::test::add_cube(s.scene.mesh, 0.4F, 0);
    s.scene.mesh.uv.clear();
    s.camera.azimuth_degrees = 20;
    s.camera.elevation_degrees = 15;
    s.camera.distance = 4;
    const DMat3 camera = view_of(s).linear;
    s.model.scale = {2, 0.5, 1};
    s.model.rotate_degrees = {0, 0, 45};
    const scene::View view = view_of(s); // scale first, then rotate
    EXPECT_LT(largest_difference(view.linear, camera * (turn * uneven)), 1e-6);
    scene::View swapped = view;
    swapped.linear = camera * (uneven * turn);
    swapped.normal = glm::transpose(glm::inverse(swapped.linear));
    const image::Image wrong = picture(s, swapped, {}), ours = scanout::test::draw(s);
    EXPECT_LT(different_pixels(picture(s), ours, 8), 20);
    EXPECT_GT(different_pixels(wrong, ours, 8), 500);
    check_page(
        {13, "rotate-and-scale", "Rotation and scaling do not commute",
         "Taken the other way round, an uneven scale draws the turned cube out along the "
         "world's axes: it is sheared; only one scale for all axes commutes with a rotation. "
         "Ours scales first, then rotates.",
         "[Course 1.2.4]",
         fmt::format("entries of the two products differ by {:.3f}",
                     largest_difference(turn * uneven, uneven * turn)),
         enlarged(wrong, 3), enlarged(ours, 3)});
}

} // namespace
} // namespace scanout::textbook::test
