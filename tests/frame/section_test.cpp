// Sections on pictures: no background between the cut and its cap, the plan's row, and the whole
// model again.
#include "frame/plan/plan.h"
#include "scene/section.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

using scene::section_plane;
using scene::SectionAxis;
using scene::SectionSpec;
using scene::slid;

Shot cut_ball(const std::optional<SectionSpec>& spec, std::optional<geom::Mesh>& whole) {
    Shot s = shot("ball", 160, 160);
    s.scene.materials = {plain({0.1F, 0.3F, 0.8F})};
    add_sphere(s.scene.mesh, Vec3(0), 0.9F, 40, 20, 0);
    s.scene.mesh.uv.clear();
    s.scene.mesh.box_min = DVec3(-0.9);
    s.scene.mesh.box_max = DVec3(0.9);
    Jobs jobs(1);
    scene::put_section(jobs, spec, s.scene, whole);
    return s;
}

// A convex body covers one run of pixels in each row and each column.
TEST(Section, LeavesNoBackgroundBetweenTheCutAndItsCap) {
    const SectionSpec specs[] = {{.axis = SectionAxis::z, .share = 0.7},
                                 {.axis = SectionAxis::x, .low = true, .share = 0.4},
                                 {.normal = {1, 2, 3}, .offset = 0.5},
                                 {.normal = {-1, 0.2, 0.7}, .offset = -0.1}};
    for (const SectionSpec& spec : specs)
        for (int azimuth = 0; azimuth < 360; azimuth += 24) {
            std::optional<geom::Mesh> whole;
            Shot s = cut_ball(spec, whole);
            ASSERT_TRUE(whole);
            EXPECT_EQ(s.scene.section->open_edges, 0U);
            s.camera.azimuth_degrees = azimuth;
            s.camera.elevation_degrees = azimuth % 80 - 40;
            const image::Image picture = draw(s);
            const auto covered = [&](int x, int y) {
                return !(picture.row(y)[static_cast<std::size_t>(x)] == s.options.background);
            };
            for (int i = 0; i < picture.width(); ++i) {
                int row_runs = 0, column_runs = 0;
                for (int k = 1; k < picture.width(); ++k) {
                    row_runs += covered(k, i) && !covered(k - 1, i) ? 1 : 0;
                    column_runs += covered(i, k) && !covered(i, k - 1) ? 1 : 0;
                }
                EXPECT_LE(row_runs, 1) << to_string(spec) << " from " << azimuth;
                EXPECT_LE(column_runs, 1) << to_string(spec) << " from " << azimuth;
            }
        }
}

TEST(Section, ShowsTheCapInItsOwnColour) {
    std::optional<geom::Mesh> whole;
    Shot s = cut_ball(SectionSpec{.axis = SectionAxis::z}, whole);
    const image::Rgba8 middle = draw(s).row(80)[80];
    EXPECT_GT(middle.r, 2 * middle.b); // the ball is blue
    EXPECT_EQ(s.scene.materials.size(), 2U);
    EXPECT_EQ(s.scene.materials.back().name, "section");
}

TEST(Section, GoesWithoutATrace) {
    std::optional<geom::Mesh> whole;
    Shot s = cut_ball({}, whole);
    s.scene.revision = 9;
    const image::Image before = draw(s);
    const std::uint64_t revision = s.scene.mesh_revision();
    Jobs jobs(2);
    scene::put_section(jobs, SectionSpec{.axis = SectionAxis::y, .share = 0.3}, s.scene, whole);
    EXPECT_NE(s.scene.mesh_revision(), revision);
    EXPECT_FALSE(draw(s) == before);
    scene::put_section(jobs, SectionSpec{.axis = SectionAxis::y, .share = 1}, s.scene, whole);
    EXPECT_FALSE(whole) << "nothing is cut: the same bits";
    EXPECT_TRUE(draw(s) == before);
    scene::put_section(jobs, {}, s.scene, whole);
    EXPECT_FALSE(s.scene.section);
    EXPECT_EQ(s.scene.materials.size(), 1U);
    EXPECT_TRUE(draw(s) == before);
}

// What a renderer keeps of a mesh does not outlive a section of as many triangles.
TEST(Section, IsFollowedByARendererThatKeepsData) {
    Shot s = shot("two balls", 120, 120);
    s.scene.materials = {plain({0.8F, 0.6F, 0.5F})};
    add_sphere(s.scene.mesh, {-0.35F, 0, 0}, 0.55F, 24, 12, 0);
    add_sphere(s.scene.mesh, {0.35F, 0.1F, 0}, 0.55F, 24, 12, 0);
    s.scene.mesh.uv.clear();
    s.scene.mesh.box_min = DVec3(-0.9, -0.7, -0.55);
    s.scene.mesh.box_max = DVec3(0.9, 0.7, 0.55);
    s.scene.revision = 77;
    const auto with = [&](const auto& change) {
        frame::FrameOptions options = s.options;
        change(options);
        return options;
    };
    const frame::FrameOptions kept[] = {with([](auto& o) {
                                            o.lights = {light_of(scene::LightKind::ambient, 0.8)};
                                            o.ambient_occlusion = "gtao_4";
                                        }),
                                        with([](auto& o) {
                                            o.shadow = "map";
                                            o.lights.front().casts = true;
                                        }),
                                        with([](auto& o) { o.colour_by = "part"; }),
                                        with([](auto& o) { o.edges = "all"; })};
    Jobs jobs(2);
    for (const frame::FrameOptions& options : kept) {
        frame::Renderer renderer(jobs);
        std::optional<geom::Mesh> whole;
        std::size_t triangles = 0;
        for (const bool low : {false, true}) {
            scene::put_section(jobs, SectionSpec{.axis = SectionAxis::z, .low = low}, s.scene,
                               whole);
            if (low) {
                ASSERT_EQ(s.scene.mesh.triangles(), triangles);
            }
            triangles = s.scene.mesh.triangles();
            const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {},
                                               options.width, options.height);
            const auto plan = frame::plan(options, frame::facts(s.scene));
            frame::Renderer fresh(jobs);
            EXPECT_TRUE(renderer.render(s.scene, *view, *plan) ==
                        fresh.render(s.scene, *view, *plan));
        }
        scene::put_section(jobs, {}, s.scene, whole);
    }
}

TEST(Section, HasARowInThePlanThatSaysWhatWasCut) {
    std::optional<geom::Mesh> whole;
    const auto row = [](const Shot& s) {
        return *frame::plan(s.options, frame::facts(s.scene))->decision("section");
    };
    EXPECT_EQ(row(cut_ball({}, whole)).technique, "none");
    EXPECT_FALSE(row(cut_ball({}, whole)).needed);
    const frame::Decision cut = row(cut_ball(SectionSpec{.axis = SectionAxis::z}, whole));
    EXPECT_EQ(cut.technique, "z:0.5");
    EXPECT_TRUE(cut.needed && cut.forced);
    EXPECT_NE(cut.because.find("of 1520 triangles"), std::string::npos) << cut.because;
}

TEST(Section, SaysWhatItCannotDo) {
    std::optional<geom::Mesh> whole;
    const auto said = [&](const SectionSpec& spec) {
        whole.reset();
        return remark(*cut_ball(spec, whole).scene.section);
    };
    EXPECT_EQ(said({.axis = SectionAxis::z}), "");
    EXPECT_NE(said({.axis = SectionAxis::z, .share = 1}).find("changes nothing"),
              std::string::npos);
    EXPECT_NE(said({.axis = SectionAxis::z, .share = 0}).find("leaves nothing"), std::string::npos);
    Shot s = bowl("bowl", frame::Cull::none);
    Jobs jobs(1);
    whole.reset();
    scene::put_section(jobs, SectionSpec{.normal = {1, 0, 0}, .offset = 0.1}, s.scene, whole);
    EXPECT_NE(remark(*s.scene.section).find("open at the cut"), std::string::npos);
}

// A file's plane through vertices cuts at them, though the mesh is moved and scaled.
TEST(Section, APlaneSquareToAnAxisPassesThroughTheFilesVertices) {
    geom::Mesh mesh = empty_mesh();
    mesh.centre = {0.05, 7.3, -1e3};
    mesh.exponent = 5;
    const double file = 0.1;
    const auto vertex = static_cast<float>((file - mesh.centre.x) / 32);
    EXPECT_EQ(section_plane({.normal = {3, 0, 0}, .offset = 3 * file}, mesh).offset, vertex);
    EXPECT_EQ(section_plane({.normal = {-1, 0, 0}, .offset = -file}, mesh).offset, -vertex);
}

TEST(Section, SlidesWithinTheBox) {
    geom::Mesh mesh = empty_mesh();
    mesh.box_min = {0, 0, 0};
    mesh.box_max = {2, 4, 8};
    const SectionSpec half{.axis = SectionAxis::x, .share = 0.5};
    EXPECT_EQ(slid(half, 0.02, mesh).share, 0.52);
    EXPECT_EQ(slid(half, -0.7, mesh).share, 0);
    const SectionSpec oblique{.normal = {0, 1, 1}, .offset = 6};
    EXPECT_DOUBLE_EQ(slid(oblique, 0.25, mesh).offset, 9);
    EXPECT_DOUBLE_EQ(slid(oblique, 2, mesh).offset, 12);
}

} // namespace
} // namespace scanout::test
