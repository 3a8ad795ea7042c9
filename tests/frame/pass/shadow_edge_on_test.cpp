// Shadow maps and walls that nearly contain the lamp: the map sees them edge-on, thinner than a
// texel.
#include "support/scenes.h"

namespace scanout::test {
namespace {

using scene::LightKind;

// A box from within.
Shot box(bool lid) {
    Shot s = shot(lid ? "closed" : "open", 96, 96);
    s.scene.materials = {plain(Vec3(0.8F))};
    geom::Mesh& mesh = s.scene.mesh;
    add_cube(mesh, 0.5F, 0);
    mesh.uv.clear();
    if (!lid) { // the fourth face
        mesh.index.erase(mesh.index.begin() + 18, mesh.index.begin() + 24);
        mesh.material.resize(10);
        mesh.face.resize(10);
    }
    s.camera.eye = DVec3(-0.45, 0.1, 0.1);
    s.camera.target = DVec3(0.5, -0.1, -0.05);
    s.camera.fov_degrees = 60;
    return s;
}

// The mean share of its light that a pixel keeps, of those that face the light.
double kept(Shot s, const std::string& technique) {
    shade::LinearPicture with, without;
    s.options.shadow = technique;
    draw(s, {.linear = &with});
    s.options.effects["shadow"] = false;
    draw(s, {.linear = &without});
    double sum = 0;
    int pixels = 0;
    for (std::size_t i = 0; i < with.pixel.size(); ++i) {
        if (without.pixel[i][0] <= 0x1p-12F) continue;
        sum += static_cast<double>(with.pixel[i][0] / without.pixel[i][0]);
        ++pixels;
    }
    EXPECT_GT(pixels, 9000) << s.name;
    return sum / pixels;
}

// The lamp stands outside, above, nearly in the plane of the wall that is seen. By a lid all is
// dark, without one all is lit.
TEST(ShadowEdgeOn, WallsOfABoxAreAsDarkAsItsLidMakesThem) {
    for (const bool lid : {true, false}) {
        Shot s = box(lid);
        for (const int size : {256, 1024, 4096}) {
            s.options.shadow_size = size;
            for (const double off : {0.002, 0.03}) {
                for (const double height : {0.6, 3.0}) {
                    for (const auto kind : {LightKind::directional, LightKind::point}) {
                        if (!lid && kind == LightKind::directional) continue; // leans too far
                        scene::Light light = light_of(kind, 0.9);
                        light.casts = true;
                        light.position = DVec3(0.5 - off, 0.5 + height, 0.13);
                        light.towards = {-off, height, 0.13};
                        s.options.lights = {light};
                        // Of a light with a size nothing shines from behind the wall, but where the
                        // wall's plane cuts the light, the map knows it to a texel.
                        Shot soft = s;
                        soft.options.lights[0].size = kind == LightKind::point ? 0.03 : 2;
                        for (const auto& [technique, most] :
                             {std::pair{"map", 0.02}, std::pair{"map_pcf", 0.02},
                              std::pair{"map_soft", 0.15}, std::pair{"volume", 0.0}}) {
                            const bool wide = technique == std::string("map_soft");
                            const double share = kept(wide ? soft : s, technique);
                            EXPECT_LE(share, lid ? most : 1)
                                << technique << ' ' << size << ' ' << off << ' ' << height << ' '
                                << name_of(kind);
                            EXPECT_GE(share, lid ? 0 : 0.99)
                                << technique << ' ' << size << ' ' << off << ' ' << height;
                        }
                    }
                }
            }
        }
    }
}

} // namespace
} // namespace scanout::test
