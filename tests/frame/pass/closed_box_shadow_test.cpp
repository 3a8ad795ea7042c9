// Inside of a closed mesh all is dark, wherever the lamp stands outside: up to the edges, where the
// face that hides and the face that is hidden meet (HARD-CASES 75).
#include "frame/shadow_shares.h"

#include <fmt/format.h>

namespace scanout::test {
namespace {

using scene::LightKind;

// From within; inwards: the faces wind the other way, as those of a room do.
Shot room(bool inwards) {
    Shot s = shot(inwards ? "inwards" : "outwards", 96, 96);
    s.scene.materials = {plain(Vec3(0.8F))};
    geom::Mesh& mesh = s.scene.mesh;
    add_cube(mesh, 0.5F, 0);
    mesh.uv.clear();
    for (std::size_t i = 0; inwards && i < mesh.index.size(); i += 3)
        std::swap(mesh.index[i + 1], mesh.index[i + 2]);
    s.camera.eye = DVec3(0.15, 0.05, 0.3);
    s.camera.target = DVec3(-0.5, -0.3, -0.5);
    s.camera.fov_degrees = 80;
    return s;
}

TEST(ClosedBoxShadow, NoLightComesInAlongItsEdges) {
    int asked = 0;
    for (const bool inwards : {false, true}) {
        Shot s = room(inwards);
        for (const LightKind kind : {LightKind::directional, LightKind::point}) {
            for (const DVec3& towards : {DVec3(-1, 2, -0.5), DVec3(0.2, 1, -3), DVec3(1, 2, 0.5),
                                         DVec3(-3, -0.4, -0.2), DVec3(-1, 1, -1)}) {
                scene::Light light = lamp(kind);
                light.towards = light.position = towards;
                s.options.lights = {light};
                for (const int size : {128, 512, 2048}) {
                    s.options.shadow_size = size;
                    for (const char* technique : {"map", "map_pcf", "map_soft", "volume"}) {
                        s.options.lights[0].size = technique != std::string("map_soft") ? 0
                                                   : kind == LightKind::directional     ? 3
                                                                                        : 0.05;
                        int bright = 0;
                        for (const double share : shares(s, technique)) {
                            asked += share >= 0 ? 1 : 0;
                            bright += share > 0 ? 1 : 0;
                        }
                        EXPECT_EQ(bright, 0)
                            << fmt::format("{} {} {} {} {},{},{}", s.name, technique, size,
                                           name_of(kind), towards.x, towards.y, towards.z);
                    }
                }
            }
        }
    }
    EXPECT_GT(asked, 100'000);
}

} // namespace
} // namespace scanout::test
