// The generated meshes: as many triangles as they are said to have, closed where they are solids,
// as many fragments as the loads that they stand for; and what is written is read again.
#include "bench/meshes/meshes.h"
#include "bench/meshes/shapes.h"
#include "bench/meshes/write_mesh_file.h"
#include "frame/renderer.h"
#include "io/obj/obj.h"
#include "io/stl/stl.h"
#include "support/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::bench {
namespace {

constexpr int kPictureWidth = 480, kPictureHeight = 270; // a sixteenth of 1920x1080

std::size_t vertex(const geom::PolygonMesh& mesh, std::size_t corner) {
    return static_cast<std::size_t>(mesh.corners[corner].position);
}

// How often each directed edge stands in the mesh, by places.
std::map<std::pair<std::size_t, std::size_t>, int> edges(const geom::PolygonMesh& mesh) {
    std::map<std::pair<std::size_t, std::size_t>, int> count;
    for (std::size_t i = 0; i < mesh.corners.size(); ++i)
        ++count[{vertex(mesh, i), vertex(mesh, i % 3 == 2 ? i - 2 : i + 1)}];
    return count;
}

double volume(const geom::PolygonMesh& mesh) {
    double six = 0;
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3) {
        const DVec3 &a = mesh.positions[vertex(mesh, i)], &b = mesh.positions[vertex(mesh, i + 1)],
                    &c = mesh.positions[vertex(mesh, i + 2)];
        six += dot3(a, cross3(b, c));
    }
    return six / 6;
}

struct Drawn {
    frame::Visibility visibility;
    frame::FrameStats stats;
};
Drawn draw(const scene::Scene& scene, const scene::CameraOptions& camera,
           const frame::FrameOptions& options) {
    Drawn drawn;
    const auto view =
        scene::make_view(scene.mesh, {}, {}, camera, {}, options.width, options.height);
    const auto plan = frame::plan(options, frame::facts(scene), *view);
    Jobs jobs(2);
    frame::Renderer renderer(jobs);
    renderer.render(scene, *view, *plan, &drawn.visibility);
    drawn.stats = renderer.stats();
    return drawn;
}

frame::FrameOptions options() {
    frame::FrameOptions o;
    o.width = kPictureWidth;
    o.height = kPictureHeight;
    return o;
}

TEST(Meshes, HaveAsManyTrianglesAsTheyAreSaidTo) {
    for (const MeshCard& card : meshes()) {
        if (card.name == "bunny") continue; // not ours, and not everywhere
        const auto mesh = make_polygons(card.name);
        ASSERT_TRUE(mesh) << mesh.error().what;
        EXPECT_EQ(mesh->faces(), card.triangles) << card.name;
        EXPECT_EQ(mesh->corners.size(), card.triangles * 3) << card.name;
    }
}

TEST(Meshes, OfAKnotAreClosedAndWoundOutwards) {
    for (const std::size_t triangles : {200U, 1000U, 20000U}) {
        for (const geom::PolygonMesh& mesh : {knot(triangles), dragon(triangles)}) {
            EXPECT_NEAR(static_cast<double>(mesh.faces()), static_cast<double>(triangles),
                        0.1 * static_cast<double>(triangles));
            const auto count = edges(mesh);
            for (const auto& [edge, times] : count) {
                ASSERT_EQ(times, 1) << triangles;
                ASSERT_TRUE(count.contains({edge.second, edge.first})) << triangles;
            }
            EXPECT_GT(volume(mesh), 0) << triangles;
        }
    }
}

// Stanford's dragon: 6.4 degrees, 1.12 vertices.
TEST(Meshes, TheDragonsStandInIsAsSmoothAndAsScatteredAsAScan) {
    const auto mesh = make_polygons("dragon");
    ASSERT_TRUE(mesh) << mesh.error().what;
    const auto place = [&](std::size_t corner) { return mesh->positions[vertex(*mesh, corner)]; };
    const auto normal = [&](std::size_t triangle) {
        const std::size_t i = 3 * triangle;
        const DVec3 n = cross3(place(i + 1) - place(i), place(i + 2) - place(i));
        return n / std::sqrt(dot3(n, n));
    };
    // Each edge twice, once from either side: this one's triangle, by the edge's ends.
    std::vector<std::array<std::size_t, 3>> sides; // low end, high end, triangle
    for (std::size_t i = 0; i < mesh->corners.size(); ++i) {
        const auto ends =
            std::minmax({vertex(*mesh, i), vertex(*mesh, i % 3 == 2 ? i - 2 : i + 1)});
        sides.push_back({ends.first, ends.second, i / 3});
    }
    std::sort(sides.begin(), sides.end());
    double squares = 0;
    for (std::size_t i = 0; i < sides.size(); i += 2) {
        ASSERT_EQ(sides[i][0], sides[i + 1][0]);
        ASSERT_EQ(sides[i][1], sides[i + 1][1]);
        const double cosine = dot3(normal(sides[i][2]), normal(sides[i + 1][2]));
        const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
        squares += angle * angle;
    }
    EXPECT_NEAR(std::sqrt(squares / (static_cast<double>(sides.size()) / 2)), 6.4, 0.3);

    constexpr std::size_t kInTurn = 1000;
    std::size_t used = 0, batches = 0;
    for (std::size_t first = 0; first + kInTurn <= mesh->faces(); first += kInTurn, ++batches) {
        std::set<std::size_t> vertices;
        for (std::size_t i = 3 * first; i < 3 * (first + kInTurn); ++i)
            vertices.insert(vertex(*mesh, i));
        used += vertices.size();
    }
    EXPECT_NEAR(static_cast<double>(used) / static_cast<double>(batches * kInTurn), 1.12, 0.05);
}

TEST(Meshes, TheTeapotStandsAsNewellDrewIt) {
    const geom::PolygonMesh mesh = teapot();
    DVec3 low(1e9), high(-1e9);
    for (const DVec3& p : mesh.positions)
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], p[axis]);
            high[axis] = std::max(high[axis], p[axis]);
        }
    EXPECT_NEAR(low.y, 0, 1e-12);
    EXPECT_NEAR(high.y, 3.15, 1e-12); // the knob of its lid
    EXPECT_NEAR(low.x, -3, 0.01);     // its handle
    EXPECT_NEAR(high.x, 3.43, 0.02);  // the lip of its spout
    EXPECT_NEAR(high.z, 2, 0.01);
    EXPECT_NEAR(low.z, -high.z, 1e-12);
    EXPECT_GT(volume(mesh), 0);
}

TEST(Meshes, TheDragonsStandInHasAThirdOfAMillionVisiblePixels) {
    auto mesh = make_mesh("dragon");
    ASSERT_TRUE(mesh) << mesh.error().what;
    scene::Scene scene;
    scene.mesh = std::move(*mesh);
    scene.materials = {test::plain(Vec3(0.5F))};
    const Drawn drawn = draw(scene, {}, options());
    const auto seen = std::count_if(drawn.visibility.id.begin(), drawn.visibility.id.end(),
                                    [](std::uint32_t id) { return id != raster::kNoPrimitive; });
    EXPECT_GT(16 * seen, 300000);
    EXPECT_LT(16 * seen, 400000);
}

TEST(Meshes, TheCrateHidesAllThatIsInIt) {
    auto mesh = make_mesh("crate");
    ASSERT_TRUE(mesh) << mesh.error().what;
    scene::Scene scene;
    scene.mesh = std::move(*mesh);
    scene.materials = {test::plain(Vec3(0.5F))};
    constexpr std::size_t kSides = 12; // the last triangles
    for (const double azimuth : {10.0, 100.0, 190.0, 280.0}) {
        scene::CameraOptions camera;
        camera.azimuth_degrees = azimuth;
        camera.elevation_degrees = azimuth < 150 ? 25 : -25;
        const Drawn drawn = draw(scene, camera, options());
        EXPECT_TRUE(
            std::all_of(drawn.visibility.id.begin(), drawn.visibility.id.end(),
                        [&](std::uint32_t id) { return id + kSides >= scene.mesh.triangles(); }))
            << azimuth;
        EXPECT_GT(drawn.stats.triangles_drawn, kSides) << azimuth; // there is something in it
    }
}

// Blended surfaces are all counted: this is how many lie behind each pixel, backs included.
TEST(Meshes, TheBuildingHasManyLayersAllAround) {
    auto mesh = make_mesh("building");
    ASSERT_TRUE(mesh) << mesh.error().what;
    scene::Scene scene;
    scene.mesh = std::move(*mesh);
    scene.materials = {test::plain(Vec3(0.5F))};
    scene.materials.front().opacity = 0.5F;
    for (const double turned : {1.0, 4.0}) {
        scene::CameraOptions camera;
        camera.eye = kEyeInBuilding;
        camera.target = kEyeInBuilding + DVec3(std::cos(turned), 0.05, std::sin(turned));
        camera.fov_degrees = 60;
        const Drawn drawn = draw(scene, camera, options());
        const double layers =
            static_cast<double>(drawn.stats.fragments_blended) / (kPictureWidth * kPictureHeight);
        EXPECT_GT(layers, 3) << turned;
        EXPECT_LT(layers, 16) << turned;
    }
}

TEST(Meshes, ComeBackFromTheFilesThatTheyAreWrittenTo) {
    const geom::PolygonMesh mesh = teapot();
    Warnings warnings;
    const auto obj = io::read_obj(obj_text(mesh), "teapot.obj", warnings);
    ASSERT_TRUE(obj) << obj.error().what;
    ASSERT_EQ(obj->polygons.faces(), mesh.faces());
    const auto stl = io::read_stl(binary_stl(mesh), "teapot.stl", warnings, nullptr);
    ASSERT_TRUE(stl) << stl.error().what;
    ASSERT_EQ(stl->polygons.faces(), mesh.faces());
    for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
        const DVec3& wanted = mesh.positions[vertex(mesh, i)];
        for (const geom::PolygonMesh* read : {&obj->polygons, &stl->polygons})
            for (int axis = 0; axis < 3; ++axis)
                ASSERT_NEAR(read->positions[vertex(*read, i)][axis], wanted[axis], 1e-5) << i;
    }
}

TEST(Meshes, NamesThatAreNoneAreRefusedInOneLine) {
    for (const char* name :
         {"", "dragons", "knot:", "knot:x", "knot:99", "knot:99999999999999999999"}) {
        const auto mesh = make_polygons(name);
        ASSERT_FALSE(mesh) << name;
        EXPECT_EQ(mesh.error().exit, Exit::usage);
        EXPECT_EQ(mesh.error().what.find('\n'), std::string::npos);
    }
}

} // namespace
} // namespace scanout::bench
