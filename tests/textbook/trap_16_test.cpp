// T16 [Course 3.3]: the "quick inverse" of a camera's pose: the transposed rotation, and the place
// turned by it.
#include "math/rotation.h"
#include "textbook/trap_page.h"

#include <cmath>

namespace scanout::textbook::test {
namespace {

struct Pose {
    DMat3 axes;
    DVec3 place;
};
Pose quick_inverse(const Pose& p) {
    const DMat3 back = glm::transpose(p.axes);
    return {back, -(back * p.place)};
}
Pose inverse(const Pose& p) {
    const DMat3 back = glm::inverse(p.axes);
    return {back, -(back * p.place)};
}
// The farthest that a point of the unit cube comes back from where it was.
double worst_way_back(const Pose& p, const Pose& back) {
    double worst = 0;
    for (int i = 0; i < 8; ++i) {
        const DVec3 point(i & 1, i >> 1 & 1, i >> 2);
        const DVec3 off = back.axes * (p.axes * point + p.place) + back.place - point;
        worst = std::max(worst, std::sqrt(dot3(off, off)));
    }
    return worst;
}

TEST(Trap16, TheQuickInverseIsRightForRigidPosesAlone) {
    const Pose rigid{rotation_y(30) * rotation_x(-15), {1, 2, 3}};
    EXPECT_LT(worst_way_back(rigid, quick_inverse(rigid)), 1e-14);
    Pose scaled = rigid, sheared = rigid;
    scaled.axes = rigid.axes * DMat3(1.25);
    sheared.axes = rigid.axes * DMat3(1, 0, 0, 0.5, 1, 0, 0, 0, 1);
    for (const Pose& p : {scaled, sheared}) {
        EXPECT_GT(worst_way_back(p, quick_inverse(p)), 0.5);
        EXPECT_LT(worst_way_back(p, inverse(p)), 1e-14);
    }

    // A camera whose pose holds a scale, as one does that hangs on a scaled node.
    Shot s = scanout::test::shot("cube", 96, 72);
    s.scene.materials = {scanout::test::plain({0.2F, 0.5F, 0.7F})};
    scanout::test::add_cube(s.scene.mesh, 0.5F, 0);
    s.scene.mesh.uv.clear();
    s.camera.azimuth_degrees = 30;
    s.camera.elevation_degrees = 15;
    s.camera.distance = 5;
    const scene::View view = view_of(s);
    const DMat3 world_to_view = view.linear;
    Pose pose{glm::inverse(world_to_view) * DMat3(1.25),
              -(glm::inverse(world_to_view) * view.translation)};
    const auto seen_by = [&](const Pose& back) {
        scene::View v = view;
        v.linear = back.axes;
        v.translation = back.place;
        v.normal = glm::transpose(glm::inverse(back.axes));
        return picture(s, v, {});
    };
    const image::Image ours = seen_by(inverse(pose));
    // The scale of a camera changes nothing that it sees: all of the world is 1/1.25 as large and
    // as far away.
    EXPECT_LT(different_pixels(ours, scanout::test::draw(s), 8), 60);
    sheared.axes = glm::inverse(world_to_view) * DMat3(1, 0, 0, 0.5, 1, 0, 0, 0, 1);
    sheared.place = pose.place;
    EXPECT_GT(different_pixels(seen_by(quick_inverse(sheared)), seen_by(inverse(sheared)), 8), 300);
    check_page(
        {16, "quick-inverse", "The quick inverse",
         "The transpose undoes a rotation and nothing else: where a camera's pose holds a shear "
         "or a scale, the quick inverse bends the world the same way once more.",
         "[Course 3.3]",
         fmt::format("a point of the unit cube comes back {:.2f} from where it was; ours 1e-14",
                     worst_way_back(sheared, quick_inverse(sheared))),
         enlarged(seen_by(quick_inverse(sheared)), 3), enlarged(seen_by(inverse(sheared)), 3)});
}

} // namespace
} // namespace scanout::textbook::test
