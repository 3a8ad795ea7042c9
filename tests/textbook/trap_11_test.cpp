// T11 [Primer 3.2.2], HARD-CASES T11: normals moved by the model's matrix.
#include "math/transcendental.h"
#include "textbook/trap_page.h"

#include <algorithm>
#include <cmath>

namespace scanout::textbook::test {
namespace {

double angle_between(const DVec3& a, const DVec3& b) {
    return degrees(acos(std::min(dot3(a, b) / std::sqrt(dot3(a, a) * dot3(b, b)), 1.0)));
}

TEST(Trap11, NormalsMovedByTheModelsMatrixLeanTheWrongWay) {
    Shot s = scanout::test::shot("ball", 96, 72);
    s.scene.materials = {scanout::test::plain({0.7F, 0.7F, 0.7F})};
    scanout::test::add_sphere(s.scene.mesh, Vec3(0), 0.9F, 48, 24, 0);
    s.model.scale = DVec3(1, 1, 0.25);
    s.camera.azimuth_degrees = 50;
    s.camera.elevation_degrees = 15;
    const scene::View view = view_of(s);
    scene::View naive = view;
    naive.normal = view.linear;
    // Of the plane x + z = 0 under scale (1, 1, 1/4): 62 degrees off; ours is at right angles to
    // it.
    const DVec3 normal(1, 0, 1), along(1, 0, -1), across(0, 1, 0);
    EXPECT_NEAR(angle_between(naive.normal * normal, view.normal * normal), 61.9, 0.1);
    EXPECT_NEAR(dot3(view.normal * normal, view.linear * along), 0, 1e-12);
    EXPECT_NEAR(dot3(view.normal * normal, view.linear * across), 0, 1e-12);
    const image::Image wrong = picture(s, naive, {}), ours = scanout::test::draw(s);
    EXPECT_LT(different_pixels(picture(s), ours, 8), 8);
    EXPECT_GT(different_pixels(wrong, ours, 8), 800);
    check_page(
        {11, "normals", "Normals of a scaled model",
         "Normals moved by the model's own matrix lean towards the side that is drawn out, and "
         "the light with them; normals move by the inverse transpose.",
         "[Primer 3.2.2]",
         fmt::format("61.9 degrees off at the plane x + z = 0; {} pixels differ by more than 8 "
                     "codes",
                     different_pixels(wrong, ours, 8)),
         enlarged(wrong, 3), enlarged(ours, 3)});
}

} // namespace
} // namespace scanout::textbook::test
