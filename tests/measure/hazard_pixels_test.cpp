#include "frame/plan/plan.h"
#include "frame/renderer.h"
#include "geom/build.h"
#include "geom/diagnose/diagnose.h"
#include "geom/diagnose/meshes.h"
#include "geom/mend_seams.h"
#include "measure/framed_views.h"
#include "measure/hazard_pixels.h"
#include "scene/fit.h"

#include <array>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

namespace scanout::measure {
namespace {

using geom::testing::add_face, geom::testing::t_junction_grid;

Jobs& two() {
    static Jobs jobs(2);
    return jobs;
}

scene::Scene scene_of(geom::PolygonMesh mesh) {
    scene::Scene scene;
    Warnings warnings;
    scene.mesh = geom::build_mesh(std::move(mesh), {}, "test", warnings).mesh;
    return scene;
}

HazardPixelsOptions options_of(int width, int height) {
    HazardPixelsOptions how;
    how.frame.width = width;
    how.frame.height = height;
    return how;
}

// The finished picture, on a background that no face has.
image::Image picture(const scene::Scene& scene, const HazardPixelsOptions& how,
                     const scene::CameraOptions& camera) {
    frame::FrameOptions options = how.frame;
    options.background = {0, 0, 0, 0};
    const auto view =
        scene::make_view(scene.mesh, how.model, {}, camera, {}, options.width, options.height);
    frame::Renderer renderer(two());
    return renderer.render(scene, *view, *frame::plan(options, frame::facts(scene), *view));
}

std::int64_t pixels_lost(const image::Image& got, const image::Image& whole) {
    std::int64_t lost = 0;
    for (std::size_t i = 0; i < got.pixels().size(); ++i)
        lost += got.pixels()[i].a == 0 && whole.pixels()[i].a != 0 ? 1 : 0;
    return lost;
}

TEST(HazardPixels, CountsTheBackgroundThatATJunctionShowsAsPicturesDo) {
    geom::PolygonMesh mesh = t_junction_grid(3, 60, 1);
    const scene::Scene cracked = scene_of(mesh);
    const geom::Diagnosis found = geom::diagnose(two(), mesh, {});
    ASSERT_EQ(found.count(geom::Hazard::t_vertices), 59U);
    geom::split_t_vertices(two(), mesh, geom::DiagnoseOptions().tolerance);
    const scene::Scene whole = scene_of(mesh);
    const HazardPixelsOptions how = options_of(900, 700);
    const auto pixels = hazard_pixels(cracked, &whole, found.marks, how, two());
    ASSERT_TRUE(pixels);
    const std::int64_t here =
        pixels_lost(picture(cracked, how, how.camera), picture(whole, how, how.camera));
    EXPECT_GT(here, 0);
    EXPECT_EQ(pixels->here.background, here);
    EXPECT_EQ(pixels->here.through, here) << "there is nothing behind it";
    ASSERT_EQ(pixels->framed.size(), 26U);
    for (const std::size_t i : {1U, 24U}) {
        const FramedView& view = framed_views()[i];
        // As `scanout render` frames the view of that name.
        const scene::CameraOptions camera = scene::fitted(
            cracked.mesh, how.model,
            scene::fitted_from(view.azimuth_degrees, view.elevation_degrees, how.camera), 9.0 / 7);
        EXPECT_EQ(pixels->framed[i].background,
                  pixels_lost(picture(cracked, how, camera), picture(whole, how, camera)))
            << framed_views()[i].name;
    }
}

TEST(HazardPixels, CountsAFartherSurfaceThatShowsThroughASeam) {
    geom::PolygonMesh mesh = t_junction_grid(3, 60, 1);
    const auto first = static_cast<std::int32_t>(mesh.positions.size());
    for (const DVec3& p : {DVec3(-9, -9, -3), DVec3(9, -9, -3), DVec3(9, 9, -3), DVec3(-9, 9, -3)})
        mesh.positions.push_back(p);
    add_face(mesh, {first, first + 1, first + 2, first + 3});
    const scene::Scene cracked = scene_of(mesh);
    const geom::Diagnosis found = geom::diagnose(two(), mesh, {});
    geom::split_t_vertices(two(), mesh, geom::DiagnoseOptions().tolerance);
    const scene::Scene whole = scene_of(mesh);
    for (const auto projection :
         {scene::Projection::perspective, scene::Projection::orthographic}) {
        HazardPixelsOptions how = options_of(900, 700);
        how.camera.projection = projection;
        how.camera.distance = 1.5;
        how.model.scale = DVec3(5);
        const auto pixels = hazard_pixels(cracked, &whole, found.marks, how, two());
        ASSERT_TRUE(pixels);
        EXPECT_GT(pixels->here.through, 0);
        EXPECT_EQ(pixels->here.background, 0);
    }
}

TEST(HazardPixels, CountsThePixelsOfMarkedFacesAndTrianglesBelowAPixel) {
    geom::PolygonMesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    add_face(mesh, {0, 1, 2});
    add_face(mesh, {0, 2, 3});
    add_face(mesh, {0, 0, 0}); // a point is not a small triangle
    const scene::Scene scene = scene_of(mesh);
    HazardPixelsOptions how = options_of(100, 100);
    how.camera.projection = scene::Projection::orthographic;
    const std::vector<geom::HazardMask> marks = {geom::mask_of(geom::Hazard::slivers), 0, 0};
    const auto pixels = hazard_pixels(scene, nullptr, marks, how, two());
    ASSERT_TRUE(pixels);
    // Half of a square whose half diagonal is the radius; pixels on its diagonal are its own.
    const double radius = 50 * std::cos(M_PI / 8); // the distance that fits is that of perspective
    EXPECT_NEAR(pixels->pixels_per_radius, radius, 1e-9);
    EXPECT_NEAR(
        static_cast<double>(pixels->here.shown[static_cast<std::size_t>(geom::Hazard::slivers)]),
        radius * radius, 2 * radius);
    EXPECT_EQ(pixels->here.shown[static_cast<std::size_t>(geom::Hazard::overlaps)], 0);
    EXPECT_EQ(pixels->here.small, 0U);
    HazardPixelsOptions far = options_of(100, 100);
    // Their longest edges are two radii.
    far.model.scale = DVec3(0.49 / radius);
    EXPECT_EQ(hazard_pixels(scene, nullptr, marks, far, two())->here.small, 2U);
    far.model.scale = DVec3(0.51 / radius);
    EXPECT_EQ(hazard_pixels(scene, nullptr, marks, far, two())->here.small, 0U);
}

TEST(FramedViews, LookAtTheFacesEdgesAndCornersOfACube) {
    std::set<std::array<int, 3>> seen;
    for (const FramedView& view : framed_views()) {
        const double a = view.azimuth_degrees * M_PI / 180, e = view.elevation_degrees * M_PI / 180;
        const std::array direction = {std::cos(e) * std::sin(a), std::sin(e),
                                      std::cos(e) * std::cos(a)};
        std::array<int, 3> signs{};
        double size = 0; // of the components that are not 0, all alike
        for (std::size_t i = 0; i < 3; ++i) {
            signs[i] = (direction[i] > 1e-9) - (direction[i] < -1e-9);
            size = std::max(size, std::abs(direction[i]));
        }
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(std::abs(direction[i]), signs[i] != 0 ? size : 0, 1e-12) << view.name;
        EXPECT_TRUE(seen.insert(signs).second) << view.name;
    }
    EXPECT_EQ(seen.size(), 26U);
    std::set<std::string> names;
    for (const FramedView& view : framed_views())
        names.insert(view.name);
    EXPECT_EQ(names.size(), 26U);
    EXPECT_THAT(names, testing::IsSupersetOf({"front", "back", "left", "right", "top", "bottom",
                                              "--camera 45,35.26"}));
}

// Of two surfaces a step apart the formats keep the depths apart, and not of a tenth of that.
TEST(DepthStep, IsWhatTheFormatKeepsApart) {
    geom::Mesh mesh;
    mesh.radius = 1;
    for (const double distance : {2.0, 50.0}) {
        scene::CameraOptions camera;
        camera.distance = distance;
        const auto view = scene::make_view(mesh, {}, {}, camera, {}, 640, 480);
        ASSERT_TRUE(view);
        frame::FrameOptions options;
        const double near = distance / 16384;
        EXPECT_NEAR(view->near_distance, near, near * 1e-9);
        const double reversed = depth_step(*view, options);
        const auto stored = [&](double d) { return static_cast<float>(near / d); };
        EXPECT_NE(stored(distance), stored(distance + reversed));
        EXPECT_NEAR(reversed, distance * 0x1p-23, distance * 1e-9);
        options.depth = "fixed_24";
        const double fixed = depth_step(*view, options);
        const auto code = [&](double d) { return (1 - near / d) * 16777215; };
        EXPECT_NEAR(code(distance + fixed) - code(distance), 1, 1e-2);
        options.depth = "fixed_16";
        EXPECT_NEAR(depth_step(*view, options), distance * 16384 / 65535, distance * 1e-6);
        options.depth = "float_32";
        EXPECT_NEAR(depth_step(*view, options), distance / 1024, distance * 1e-6);
    }
}

} // namespace
} // namespace scanout::measure
