// Near and far planes, and windows that are not about the middle, as pictures show them: against
// rays that meet all triangles.
#include "math/rotation.h"
#include "support/random.h"
#include "support/scenes.h"

#include <cmath>
#include <utility>
#include <vector>

namespace scanout::test {
namespace {

// The triangle that is nearest at a place of the picture, or none; `doubt` where an edge, another
// triangle or a plane is close by.
struct Met {
    std::uint32_t id = raster::kNoPrimitive;
    bool doubt = false;
};
Met met_at(const geom::Mesh& mesh, const scene::View& view, double near, double x, double y,
           int width, int height) {
    const bool flat = view.projection == scene::Projection::orthographic;
    const DVec2 place = view.middle + DVec2((2 * x / width - 1) * view.half_width,
                                            (1 - 2 * y / height) * view.half_height);
    const DVec3 from = flat ? DVec3(place.x, place.y, 0) : DVec3(0),
                way = flat ? DVec3(0, 0, -1) : DVec3(place.x, place.y, -1);
    Met met;
    std::vector<std::pair<double, double>> hits; // t, and by how much it may be off
    double best = view.cut_far;
    for (std::uint32_t i = 0; i < mesh.triangles(); ++i) {
        DVec3 c[3];
        for (std::size_t k = 0; k < 3; ++k)
            c[k] = view.linear * DVec3(mesh.position[mesh.index[3 * i + k]]) + view.translation;
        const DVec3 normal = cross3(c[1] - c[0], c[2] - c[0]);
        const double t = dot3(c[0] - from, normal) / dot3(way, normal);
        const DVec3 p = from + way * t;
        double least = 1e300; // from the edges, inwards
        for (int k = 0; k < 3; ++k) {
            const DVec3 side = c[(k + 1) % 3] - c[k];
            least = std::min(least, dot3(cross3(side, p - c[k]), normal) /
                                        (length(side) * length(normal)));
        }
        // Corners snap to 1/256 pixel, which on a surface that is seen edge-on is far.
        const double pixel = 2 * view.half_width / width * (flat ? 1 : std::abs(t)) /
                             std::max(std::abs(dot3(way, normal)) / length(normal), 1e-9);
        const double slack = 0.02 * pixel;
        if (!(least > -slack)) continue;
        hits.emplace_back(t, slack + 1e-5);
        const double off = hits.back().second;
        met.doubt = met.doubt || std::abs(t - near) < off || std::abs(t - view.cut_far) < off;
        if (t < near || t > view.cut_far) continue;
        met.doubt = met.doubt || least < slack;
        if (t >= best) continue;
        best = t;
        met.id = i;
    }
    for (const auto& [t, off] : hits)
        met.doubt = met.doubt || (t != best && std::abs(t - best) < 2 * off);
    return met;
}

TEST(NearFar, WhatLiesBetweenThePlanesIsSeen) {
    Random random(5);
    int cut = 0, all = 0;
    for (int i = 0; i < 24; ++i) {
        Shot s = soup("soup", 60, 0.7, static_cast<std::uint64_t>(i));
        for (scene::Material& m : s.scene.materials)
            m.opacity = 1;
        s.scene.textures.clear();
        s.options.width = 64;
        s.options.height = 48;
        s.options.samples = 1;
        s.options.aa = "auto";
        s.options.cull = frame::Cull::none;
        const char* const formats[] = {"auto", "fixed_24", "float_32"};
        s.options.depth = formats[i % 3];
        const bool flat = i % 2 == 1;
        s.camera.projection =
            flat ? scene::Projection::orthographic : scene::Projection::perspective;
        s.camera.distance = 3;
        s.camera.azimuth_degrees = random.in(0, 360);
        const double near = random.in(2.2, 3), far = near + random.in(0.2, 0.9);
        s.camera.near = near;
        if (i % 4 != 0) s.camera.far = far;
        if (i % 3 == 0) {
            const double unit = flat ? 1 : near / 3;
            s.camera.window =
                scene::Window{s.camera.projection, -0.2 * unit, 1 * unit, -0.9 * unit, 0.1 * unit};
        }
        const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, 64, 48);
        ASSERT_TRUE(view) << view.error().what;
        frame::Visibility seen;
        DrawOptions how;
        how.visibility = &seen;
        draw(s, *view, how);
        for (int y = 0; y < 48; ++y)
            for (int x = 0; x < 64; ++x) {
                const Met met = met_at(s.scene.mesh, *view, near, x + 0.5, y + 0.5, 64, 48);
                if (met.doubt) continue;
                EXPECT_EQ(seen.id[static_cast<std::size_t>(y * 64 + x)], met.id)
                    << i << ": " << x << ' ' << y;
                ++all;
                scene::View whole = *view;
                whole.cut_far = 1e300;
                cut += met_at(s.scene.mesh, whole, -1e300, x + 0.5, y + 0.5, 64, 48).id != met.id;
            }
        if (HasFailure()) break;
    }
    EXPECT_GT(all, 40000);
    EXPECT_GT(cut, 5000);
}

} // namespace
} // namespace scanout::test
