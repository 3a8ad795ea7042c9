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
Shot convex_ball(int width, int height, double azimuth, double elevation) {
    Shot s = shot("convex", width, height);
    s.scene.materials = {plain(Vec3(0.5F))};
    add_sphere(s.scene.mesh, Vec3(0), 0.9F, 14, 8, 0);
    s.scene.mesh.box_min = DVec3(-0.9);
    s.scene.mesh.box_max = DVec3(0.9);
    s.scene.mesh.uv.clear();
    s.camera.azimuth_degrees = azimuth;
    s.camera.elevation_degrees = elevation;
    return s;
}

scene::View view_of_edges(const Shot& s) {
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
            const Shot s = convex_ball(width, height, i * 41, 80 - i * 21);
            const scene::View view = view_of_edges(s);
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
        Shot s = convex_ball(200, 150, 20, 10);
        s.options.cull = cull;
        const scene::View view = view_of_edges(s);
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
            const scene::View view = view_of_edges(s);
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
            const scene::View view = view_of_edges(s);
            const auto plan = frame::plan(asked.options, frame::facts(s.scene), view);
            ASSERT_TRUE(plan);
            for (int again = 0; again < 2; ++again)
                EXPECT_EQ(renderer.render(s.scene, view, *plan), draw(asked)) << s.name << angle;
        }
    }
}

TEST(Edges, AreBlackAndWhiteOnDarkModels) {
    for (const bool dark : {false, true}) {
        Shot s = with_edges(convex_ball(64, 64, 0, 0), "all");
        s.scene.materials = {plain(Vec3(dark ? 0.01F : 0.5F))};
        s.options.line_width = 3;
        int of_lines = 0;
        const image::Rgba8 colour =
            dark ? image::Rgba8{255, 255, 255, 255} : image::Rgba8{0, 0, 0, 255};
        const image::Image picture = draw(s);
        for (const image::Rgba8& pixel : picture.pixels())
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

Shot annotated(Shot s, std::initializer_list<frame::Annotation> which) {
    for (const frame::Annotation a : which)
        s.options.annotations.toggle(a);
    return s;
}
using Mark = frame::Annotation;

int changed_pixels(const image::Image& picture, const image::Image& without,
                   bool (*is)(const image::Rgba8&)) {
    int count = 0;
    for (std::size_t i = 0; i < picture.pixels().size(); ++i)
        count += !(picture.pixels()[i] == without.pixels()[i]) && is(picture.pixels()[i]) ? 1 : 0;
    return count;
}

TEST(Annotations, AreHeldOnlyWhileTheyAreAskedForAndEachChangesThePicture) {
    Jobs jobs(2);
    frame::Renderer renderer(jobs);
    const Shot s = convex_ball(200, 150, 0, 0);
    const scene::View view = view_of_edges(s);
    for (std::size_t i = 0; i <= frame::kAnnotationNames.size(); ++i) {
        const bool some = i < frame::kAnnotationNames.size();
        const Shot asked = some ? annotated(s, {static_cast<frame::Annotation>(i)}) : s;
        const auto plan = frame::plan(asked.options, frame::facts(s.scene), view);
        ASSERT_TRUE(plan);
        EXPECT_EQ(plan->annotations.any(), some);
        const image::Image picture = renderer.render(s.scene, view, *plan);
        EXPECT_EQ(picture, draw(asked)) << i;
        EXPECT_EQ(picture == draw(s), !some) << i;
        EXPECT_EQ(renderer.stats().annotation_bytes > 0, some);
        EXPECT_EQ(draw(asked, {.threads = 3, .tile_size = 8}), picture) << i;
    }
}

// x to the right is red, y up is green, z towards the eye is a point that nothing else shows.
TEST(Annotations, AxesAreRedGreenAndBlueWhereTheFilesAxesGo) {
    const auto red = [](const image::Rgba8& p) { return p.r > 150 && p.g < 60 && p.b < 60; };
    const auto green = [](const image::Rgba8& p) { return p.g > 150 && p.r < 60 && p.b < 60; };
    const auto blue = [](const image::Rgba8& p) { return p.b > 200 && p.r < 80 && p.g < 110; };
    for (const auto& [azimuth, reds, greens, blues] :
         {std::tuple(0.0, true, true, false), {90.0, false, true, true}}) {
        Shot s = convex_ball(200, 150, azimuth, 0);
        s.camera.projection = scene::Projection::orthographic;
        const image::Image plain = draw(s), picture = draw(annotated(s, {Mark::axes}));
        EXPECT_EQ(changed_pixels(picture, plain, red) > 10, reds) << azimuth;
        EXPECT_EQ(changed_pixels(picture, plain, green) > 10, greens) << azimuth;
        EXPECT_EQ(changed_pixels(picture, plain, blue) > 10, blues) << azimuth;
    }
}

// The far half of the box is behind the ball.
TEST(Annotations, AreHiddenBehindTheModel) {
    const Shot s = convex_ball(200, 150, 0, 0);
    const Shot boxed = annotated(s, {Mark::box, Mark::grid, Mark::normals, Mark::points});
    const scene::View view = view_of_edges(s);
    const auto got = ids_of(boxed, view), plain = ids_of(s, view);
    Shot alone = boxed;
    alone.scene.mesh.index.clear();
    alone.scene.mesh.material.clear();
    alone.scene.mesh.face.clear();
    add_point(alone.scene.mesh, 0); // that there is a model
    const auto lines = ids_of(alone, view);
    int shown = 0, hidden = 0;
    for (std::size_t p = 0; p < got.size(); ++p) {
        const bool line = got[p] != raster::kNoPrimitive &&
                          got[p] >= static_cast<std::uint32_t>(s.scene.mesh.triangles());
        if (plain[p] == raster::kNoPrimitive) continue;
        shown += line ? 1 : 0;
        hidden += !line && lines[p] != raster::kNoPrimitive ? 1 : 0;
    }
    EXPECT_GT(shown, 100) << "points and normals before the ball";
    EXPECT_GT(hidden, 100) << "box and grid behind it";
}

TEST(Annotations, TheGridFollowsTheAxisThatIsUp) {
    Shot s = annotated(convex_ball(200, 150, 20, 20), {Mark::grid});
    const image::Image first = draw(s);
    s.camera.up = scene::UpAxis::plus_z;
    Shot turned = s;
    turned.options.annotations = {};
    EXPECT_FALSE(draw(s) == first);
    // The ground is below, and seen from above it is beside the ball, not behind it.
    for (const scene::UpAxis up : {scene::UpAxis::plus_y, scene::UpAxis::plus_z,
                                   scene::UpAxis::minus_y, scene::UpAxis::plus_x}) {
        s.camera.up = turned.camera.up = up;
        const image::Image with = draw(s), without = draw(turned);
        int above = 0, below = 0;
        for (int y = 0; y < 150; ++y)
            for (int x = 0; x < 200; ++x)
                if (!(with.at(x, y) == without.at(x, y))) ++(y < 60 ? above : below);
        EXPECT_GT(below, 20 * above + 500) << static_cast<int>(up);
    }
}

TEST(Annotations, SayTheirLengthsInTheFilesUnit) {
    Shot s = convex_ball(64, 64, 0, 0);
    s.scene.mesh.box_min = {-1, -2, 0};
    s.scene.mesh.box_max = {1, 2, 0.5};
    const auto because = [&](const Shot& of) {
        const auto plan = frame::plan(of.options, frame::facts(of.scene));
        return plan ? to_string(*plan->decision("annotate")) : plan.error().what;
    };
    EXPECT_EQ(because(s), "annotate none: annotations come only on request");
    EXPECT_EQ(because(annotated(s, {Mark::grid, Mark::box, Mark::normals})),
              "annotate normals,box,grid: normals, box of 2 x 4 x 0.5, grid of squares of 0.5 (in "
              "the file's unit) (forced)");
    Shot nothing = annotated(shot("nothing"), {Mark::box});
    EXPECT_EQ(because(nothing), "annotate box: there is no model (forced)");
}

} // namespace
} // namespace scanout::test
