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
    const DMat3 view_to_world = glm::inverse(view.linear);
    const DVec3 eye = -(view_to_world * view.translation);
    // What the camera sees plainly is carried to the world by its pose, and seen from there.
    const auto seen_by = [&](const Pose& pose, const Pose& back) {
        Shot world = s;
        const DMat3 normals = glm::transpose(glm::inverse(pose.axes * view.linear));
        for (Vec3& p : world.scene.mesh.position)
            p = Vec3(pose.axes * (view.linear * DVec3(p) + view.translation) + pose.place);
        for (Vec3& n : world.scene.mesh.normal) {
            const DVec3 moved = normals * DVec3(n);
            n = Vec3(moved / std::sqrt(dot3(moved, moved)));
        }
        scene::View v = view;
        v.linear = back.axes;
        v.translation = back.place;
        v.normal = glm::transpose(glm::inverse(back.axes));
        return scanout::test::draw(world, v, {});
    };
    const image::Image plain = scanout::test::draw(s);
    EXPECT_GT(covered_pixels(plain, s), 400);
    const Pose turned{view_to_world, eye}, larger{view_to_world * DMat3(1.25), eye},
        leaning{view_to_world * DMat3(1, 0, 0, 0.5, 1, 0, 0, 0, 1), eye};
    for (const Pose& pose : {turned, larger, leaning})
        EXPECT_LT(different_pixels(seen_by(pose, inverse(pose)), plain, 8), 8);
    EXPECT_LT(different_pixels(seen_by(turned, quick_inverse(turned)), plain, 8), 8);
    // A scale that is not undone shows all of the world larger and as much farther away.
    EXPECT_LT(different_pixels(seen_by(larger, quick_inverse(larger)), plain, 8), 60);
    EXPECT_GT(different_pixels(seen_by(leaning, quick_inverse(leaning)), plain, 8), 300);
    check_page(
        {16, "quick-inverse", "The quick inverse",
         "The transpose undoes a rotation and nothing else: where a camera's pose holds a shear, "
         "the quick inverse bends the world once more; a scale it squares, which shows only where "
         "distances are used.",
         "[Course 3.3]",
         fmt::format("a point of the unit cube comes back {:.2f} from where it was; ours 1e-14",
                     worst_way_back(leaning, quick_inverse(leaning))),
         enlarged(seen_by(leaning, quick_inverse(leaning)), 3),
         enlarged(seen_by(leaning, inverse(leaning)), 3)});
}

} // namespace
} // namespace scanout::textbook::test
