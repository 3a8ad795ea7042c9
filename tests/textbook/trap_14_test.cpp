// T14 [Compendium 11.1]: brightness n . l + a, neither clamped nor of a unit normal.
#include "textbook/trap_page.h"
#include "textbook/triangle.h"

#include <cmath>

namespace scanout::textbook::test {
namespace {

TEST(Trap14, UnclampedLightWrapsRoundAndInterpolatedNormalsAreShort) {
    // Half way between two normals at right angles.
    const DVec3 between = (DVec3(1, 0, 0) + DVec3(0, 1, 0)) * 0.5;
    EXPECT_NEAR(std::sqrt(dot3(between, between)), 0.707, 1e-3);

    Shot s = scanout::test::shot("ball", 96, 72);
    s.scene.materials = {scanout::test::plain(Vec3(1))};
    scanout::test::add_sphere(s.scene.mesh, Vec3(0), 0.9F, 10, 6, 0);
    s.camera.projection = scene::Projection::orthographic;
    scene::Light sun, ambient;
    sun.towards = {1, 1, 0.5};
    ambient.kind = scene::LightKind::ambient;
    ambient.power = 0.3;
    s.options.lights = {sun, ambient};
    const image::Image ours = scanout::test::draw(s);
    // As the document has it: c = n . l + a of the interpolated normal, into a byte.
    const DVec3 sunwards = DVec3(1, 1, 0.5) / 1.5;
    image::Image wrong(96, 72, s.options.background);
    int above = 0, below = 0;
    double shortest = 1;
    const scene::View view = view_of(s);
    for (std::size_t t = 0; t < s.scene.mesh.triangles(); ++t) {
        Points p;
        std::array<DVec3, 3> n;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t i = s.scene.mesh.index[3 * t + k];
            const DVec3 place = view.linear * DVec3(s.scene.mesh.position[i]) + view.translation;
            n[k] = DVec3(s.scene.mesh.normal[i]);
            p[k] = DVec2((place.x / view.half_width + 1) * 48 - 0.5,
                         (1 - place.y / view.half_height) * 36 - 0.5);
        }
        if (twice_area(p[0], p[1], p[2]) >= 0) continue; // a back
        const auto pixel = [&](int x, int y) {
            const auto l = barycentric(p, x, y);
            const DVec3 normal = n[0] * l[0] + n[1] * l[1] + n[2] * l[2];
            shortest = std::min(shortest, std::sqrt(dot3(normal, normal)));
            const double light = dot3(normal, sunwards) + 0.3;
            above += light > 1 ? 1 : 0;
            below += light < 0 ? 1 : 0;
            const auto byte = static_cast<std::uint8_t>(static_cast<int>(light * 255) & 255);
            wrong.at(x, y) = {byte, byte, byte, 255};
        };
        fill_box_edge_functions(p, [&](int y, int x0, int x1) {
            for (int x = x0; x < x1; ++x)
                pixel(x, y);
        });
    }
    EXPECT_GT(above, 100);
    EXPECT_GT(below, 100);
    EXPECT_LT(shortest, 0.95);
    s.options.tone = "clamp"; // by itself the production renderer rolls off what is near 1
    EXPECT_LT(different_pixels(picture(s), scanout::test::draw(s), 8), 8);
    EXPECT_GT(different_pixels(wrong, ours, 60), 400);
    check_page(
        {14, "light-clamp", "Light beyond 0 and 1",
         "n . l + a passes 1 where the light falls straight on and goes below 0 on the far side: "
         "in a byte both wrap round; and normals between two corners are short, so that the "
         "corners shine. Ours clamps the cosine and the sum, and normalises.",
         "[Compendium 11.1]",
         fmt::format("{} pixels above 1, {} below 0; the shortest normal is {:.2f}", above, below,
                     shortest),
         enlarged(wrong, 3), enlarged(ours, 3)});
}

} // namespace
} // namespace scanout::textbook::test
