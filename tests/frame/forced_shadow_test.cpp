// A shadow that the plan leaves off must change nothing where it is forced on (the effects' law:
// what is not needed changes no bit).
#include "support/scenes.h"

namespace scanout::test {
namespace {

// Three times the same triangle, both ways round, with the highlight of models without materials,
// between two spot lights: what faces away from a light still has its highlight over the edge.
Shot back_to_back() {
    Shot s = shot("back_to_back", 45, 45);
    s.scene.unnamed = scene::unnamed_material(Vec3(0.6F));
    geom::Mesh& mesh = s.scene.mesh;
    for (const float side : {1.0F, -1.0F, 1.0F}) {
        const auto first = static_cast<std::uint32_t>(mesh.position.size());
        for (const Vec3& p : {Vec3(0, 0, 0), Vec3(0.9F, 0, 0), Vec3(0, 0.9F, 0)})
            add_vertex(mesh, p, {0, 0, side});
        add_triangle(mesh, first, first + (side > 0 ? 1 : 2), first + (side > 0 ? 2 : 1), -1);
    }
    s.options.lights = {light_of(scene::LightKind::spot, 1), light_of(scene::LightKind::spot, 1)};
    for (scene::Light& light : s.options.lights) {
        light.target.reset();
        light.casts = true;
    }
    s.options.lights[0].position = {0.08, 0.36, 0.51};
    s.options.lights[0].outer_degrees = 45;
    s.options.lights[1].position = {0.37, 0.63, -0.01};
    s.options.lights[1].outer_degrees = 64;
    s.options.lights[1].size = 0.2;
    s.options.blend = "add";
    return s;
}

TEST(ForcedShadow, TakesNoHighlightOfFlatFacesThatLieBackToBack) {
    int lit = 0;
    for (int turn = 0; turn < 24; ++turn)
        for (const double elevation : {-60.0, -10.0, 60.0}) {
            Shot s = back_to_back();
            s.camera.azimuth_degrees = 15 * turn;
            s.camera.elevation_degrees = elevation;
            s.camera.distance = 1.2;
            shade::LinearPicture left, forced;
            const image::Image plain = draw(s, {.linear = &left});
            s.options.effects["shadow"] = true;
            EXPECT_EQ(draw(s, {.linear = &forced}), plain) << turn << ' ' << elevation;
            EXPECT_EQ(forced, left) << turn << ' ' << elevation;
            for (const auto& pixel : left.pixel)
                lit += pixel[0] > 0.5F ? 1 : 0;
        }
    EXPECT_GT(lit, 1000);
}

} // namespace
} // namespace scanout::test
