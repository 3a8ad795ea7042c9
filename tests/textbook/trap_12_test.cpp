// T12 [Compendium 11.3]: a right-handed file in a left-handed renderer.
#include "textbook/trap_page.h"

namespace scanout::textbook::test {
namespace {

TEST(Trap12, ARightHandedFileReadAsLeftHandedIsMirroredAndInsideOut) {
    Shot s = shot_of_model("spot/spot.obj", 96, 72);
    s.camera.azimuth_degrees = 30;
    s.camera.elevation_degrees = 10;
    s.options.cull = frame::Cull::back;
    s.options.texture = "nearest";
    const image::Image ours = scanout::test::draw(s);
    EXPECT_LT(different_pixels(picture(s), ours, 8), 60);
    // As it is: every z has the wrong sign, and all fronts are backs.
    Shot mirrored = s;
    for (Vec3& p : mirrored.scene.mesh.position)
        p.z = -p.z;
    for (Vec3& n : mirrored.scene.mesh.normal)
        n.z = -n.z;
    // The cures: a camera that looks along +z sees such a z where it belongs; where a document's
    // fronts run clockwise on the screen, the corners are read the other way round, too.
    scene::View along_z = view_of(s);
    along_z.linear[2] = -along_z.linear[2];
    along_z.normal[2] = -along_z.normal[2];
    EXPECT_EQ(different_pixels(picture(mirrored, along_z, {}), picture(s)), 0);
    Shot rewound = mirrored;
    for (std::size_t i = 0; i < rewound.scene.mesh.index.size(); i += 3)
        std::swap(rewound.scene.mesh.index[i + 1], rewound.scene.mesh.index[i + 2]);
    scene::View clockwise = along_z;
    clockwise.mirrored = true;
    EXPECT_EQ(different_pixels(picture(rewound, clockwise, {}), picture(s)), 0);
    EXPECT_GT(different_pixels(picture(mirrored, clockwise, {}), picture(s), 8), 400);
    const image::Image wrong = picture(mirrored);
    EXPECT_GT(different_pixels(wrong, ours, 8), 1000);
    check_page(
        {12, "handedness", "A right-handed file, a left-handed renderer",
         "Read as it is, every z has the wrong sign: the model is its own mirror image, and its "
         "fronts are culled as backs, so that one looks into it; z changes its sign and the "
         "winding its sense, or the system stays the file's.",
         "[Compendium 11.3]",
         fmt::format("{} of {} pixels differ by more than 8 codes",
                     different_pixels(wrong, ours, 8), 96 * 72),
         enlarged(wrong, 3), enlarged(ours, 3)});
}

} // namespace
} // namespace scanout::textbook::test
