// The laws of edges over the shading: what shows of them is what shows of their faces.
#include "frame/edges.h"
#include "raster/screen/primitive.h"
#include "rows.h"
#include "support/scenes.h"

#include <gmock/gmock.h>

namespace scanout::test {
namespace {

Shot with_edges(Shot s, const std::string& edges) {
    s.options.edges = edges;
    return s;
}

// A ball whose faces are triangles: all edges bend, and it hides its far side alone.
Shot convex(int width, int height, double azimuth, double elevation) {
    Shot s = shot("convex", width, height);
    s.scene.materials = {plain(Vec3(0.5F))};
    add_sphere(s.scene.mesh, Vec3(0), 0.9F, 14, 8, 0);
    s.scene.mesh.uv.clear();
    s.camera.azimuth_degrees = azimuth;
    s.camera.elevation_degrees = elevation;
    return s;
}

scene::View view_of(const Shot& s) {
    return *scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                             s.options.height);
}

// The scene without its faces, but with the edges of those that are turned to the eye, as lines.
Shot edges_alone(const Shot& s, const scene::View& view, bool to_eye) {
    Shot alone = s;
    geom::Mesh& mesh = alone.scene.mesh;
    mesh.index.clear();
    mesh.material.clear();
    mesh.face.clear();
    const geom::Mesh& from = s.scene.mesh;
    for (std::size_t t = 0; t < from.triangles(); ++t) {
        DVec3 p[3];
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = view.linear * DVec3(from.position[from.index[t * 3 + k]]) + view.translation;
        if ((dot3(p[0], cross3(p[1], p[2])) < 0) != to_eye) continue;
        for (std::size_t k = 0; k < 3; ++k)
            add_line(mesh, from.index[t * 3 + k], from.index[t * 3 + (k + 1) % 3]);
    }
    return alone;
}

std::vector<std::uint32_t> ids_of(const Shot& s, const scene::View& view) {
    frame::Visibility visible;
    draw(s, view, {.visibility = &visible});
    return visible.id;
}

// On a convex body the edges of the faces that are turned to the eye show whole, at any tilt, and
// the others show nowhere but where a pixel of theirs shows nothing of the body.
TEST(Edges, OfFacesTurnedToTheEyeShowWholeOnAConvexBody) {
    std::size_t shown = 0, beside = 0;
    for (const auto& [width, height] :
         {std::pair(64, 64), std::pair(200, 150), std::pair(640, 480)})
        for (int i = 0; i < 8; ++i) {
            const Shot s = convex(width, height, i * 41, 80 - i * 21);
            const scene::View view = view_of(s);
            const std::uint32_t triangles = static_cast<std::uint32_t>(s.scene.mesh.triangles());
            const auto got = ids_of(with_edges(s, "all"), view), plain = ids_of(s, view),
                       lines = ids_of(edges_alone(s, view, true), view);
            for (std::size_t p = 0; p < got.size(); ++p) {
                const bool line = got[p] != raster::kNoPrimitive && got[p] >= triangles;
                const bool wanted = lines[p] != raster::kNoPrimitive;
                if (wanted) {
                    ASSERT_TRUE(line) << width << ' ' << i << ": " << p % width << ',' << p / width;
                } else if (line) {
                    ASSERT_EQ(plain[p], raster::kNoPrimitive) << width << ' ' << i;
                }
                shown += wanted ? 1 : 0;
                beside += line && !wanted ? 1 : 0;
            }
        }
    EXPECT_GT(shown, 50'000U);
    EXPECT_LT(beside, shown / 100);
}

TEST(Edges, OfCulledFacesAreCulled) {
    for (const frame::Cull cull : {frame::Cull::back, frame::Cull::front}) {
        Shot s = convex(200, 150, 20, 10);
        s.options.cull = cull;
        const scene::View view = view_of(s);
        const auto got = ids_of(with_edges(s, "all"), view),
                   lines = ids_of(edges_alone(s, view, cull == frame::Cull::back), view);
        int shown = 0;
        for (std::size_t p = 0; p < got.size(); ++p) {
            const bool line = got[p] != raster::kNoPrimitive &&
                              got[p] >= static_cast<std::uint32_t>(s.scene.mesh.triangles());
            ASSERT_EQ(line, lines[p] != raster::kNoPrimitive) << p;
            shown += line ? 1 : 0;
        }
        EXPECT_GT(shown, 1000);
    }
}

TEST(Edges, DependOnNoTileAndNoThread) {
    for (const char* aa : {"none", "samples_4", "supersampling_2", "tent", "area"})
        for (Shot s : {solids("solids"), bowl("bowl", frame::Cull::none)}) {
            s = with_edges(s, "all");
            s.options.width = 131;
            s.options.height = 67;
            s.options.line_width = 3;
            s.options.aa = aa;
            const image::Image first = draw(s);
            for (const int tile_size : {8, 32})
                EXPECT_EQ(draw(s, {.threads = 3, .tile_size = tile_size}), first)
                    << s.name << ' ' << aa;
        }
}

TEST(Edges, AreHeldOnlyWhileTheyAreAskedFor) {
    Jobs jobs(2);
    frame::Renderer renderer(jobs);
    const Shot shots[] = {solids("solids"), bowl("bowl", frame::Cull::none)};
    for (const char* name : {"auto", "all", "none", "feature", "all", "auto"})
        for (const Shot& s : shots) {
            const Shot asked = with_edges(s, name);
            const scene::View view = view_of(s);
            const auto plan = frame::plan(asked.options, frame::facts(s.scene), view);
            ASSERT_TRUE(plan);
            const bool some = name != std::string("auto") && name != std::string("none");
            EXPECT_EQ(plan->annotations.any(), some);
            EXPECT_EQ(renderer.render(s.scene, view, *plan), draw(asked)) << name;
            EXPECT_EQ(renderer.stats().annotation_bytes > 0, some) << name;
            EXPECT_EQ(draw(asked) == draw(s), !some) << name;
        }
}

// The lines of a scene are kept from frame to frame; another scene, angle or kind has others.
TEST(Edges, AreMadeAnewForAnotherSceneOrAngle) {
    Jobs jobs(1);
    frame::Renderer renderer(jobs);
    std::uint64_t revision = 0;
    for (Shot s : {solids("solids"), bowl("bowl", frame::Cull::none)}) {
        s.scene.revision = ++revision;
        for (const double angle : {10.0, 30.0, 100.0}) {
            Shot asked = with_edges(s, "feature");
            asked.options.edge_angle = angle;
            const scene::View view = view_of(s);
            const auto plan = frame::plan(asked.options, frame::facts(s.scene), view);
            ASSERT_TRUE(plan);
            for (int again = 0; again < 2; ++again)
                EXPECT_EQ(renderer.render(s.scene, view, *plan), draw(asked)) << s.name << angle;
        }
    }
}

TEST(Edges, AreBlackAndWhiteOnDarkModels) {
    for (const bool dark : {false, true}) {
        Shot s = with_edges(convex(64, 64, 0, 0), "all");
        s.scene.materials = {plain(Vec3(dark ? 0.01F : 0.5F))};
        s.options.line_width = 3;
        int of_lines = 0;
        const image::Rgba8 colour =
            dark ? image::Rgba8{255, 255, 255, 255} : image::Rgba8{0, 0, 0, 255};
        for (const image::Rgba8& pixel : draw(s).pixels())
            of_lines += pixel == colour ? 1 : 0;
        EXPECT_GT(of_lines, 500) << dark;
    }
}

TEST(Edges, SayWhatTheyAre) {
    const auto because = [&](const Shot& s, const std::string& name) {
        Shot asked = with_edges(s, name);
        const auto plan = frame::plan(asked.options, frame::facts(s.scene));
        return plan ? to_string(*plan->decision("edges")) : plan.error().what;
    };
    const Shot s = bowl("bowl", frame::Cull::none);
    EXPECT_EQ(because(s, "auto"), "edges none: edges come only on request");
    EXPECT_EQ(because(s, "all"), "edges all: the edges of the faces of 360 triangles (forced)");
    EXPECT_EQ(because(s, "feature"),
              "edges feature: edges of 360 triangles with one face, or more than two, or a bend of "
              "more than 30 degrees (forced)");
    EXPECT_EQ(because(wires("wires"), "all"), "edges all: the model has no faces (forced)");
    EXPECT_THAT(because(s, "some"), testing::HasSubstr("choose auto none feature all"));
}

} // namespace
} // namespace scanout::test
