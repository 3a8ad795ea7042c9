// HARD-CASES 72: every camera gives finite matrices that can be inverted, or is refused; with
// nothing to see, a single point, a line, and the model behind the eye. A near plane fitted to what
// is seen would have no place.
#include "geom/build.h"
#include "scene/view.h"
#include "support/random.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::scene {
namespace {

geom::Mesh mesh_of(const std::vector<DVec3>& points) {
    geom::PolygonMesh polygons;
    polygons.positions = points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        polygons.point_vertices.push_back(static_cast<std::uint32_t>(i));
        polygons.point_material.push_back(-1);
    }
    Warnings warnings;
    return geom::build_mesh(std::move(polygons), {}, "x", warnings).mesh;
}

double determinant_of(const DMat3& m) {
    return dot3(m[0], cross3(m[1], m[2]));
}

bool is_finite(const View& v) {
    double sum = v.half_width + v.half_height + v.near_distance + v.depth_origin + v.depth_scale;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            sum += (v.linear[c][r] - v.linear[c][r]) + (v.normal[c][r] - v.normal[c][r]);
    return std::isfinite(sum + (v.translation.x - v.translation.x) +
                         (v.translation.y - v.translation.y) + (v.translation.z - v.translation.z));
}

TEST(Row72, EveryCameraOfEveryModelIsFiniteAndCanBeInverted) {
    const std::vector<geom::Mesh> meshes = {mesh_of({}),
                                            mesh_of({{3, 4, 5}}),
                                            mesh_of({{0, 0, 0}, {1, 0, 0}}),
                                            mesh_of({{1e-300, 0, 0}, {0, 1e-300, 0}}),
                                            mesh_of({{1e300, 0, 0}, {0, -1e300, 1e300}}),
                                            mesh_of({{-1, -1, -1}, {1, 1, 1}, {0, 1, -1}})};
    test::Random random(72);
    int views = 0, refused = 0, no_fitted_near = 0;
    double least = 1;
    for (int i = 0; i < 200'000; ++i) {
        const geom::Mesh& mesh = meshes[static_cast<std::size_t>(random.whole(0, 5))];
        CameraOptions camera;
        camera.projection =
            random.bits() % 3 == 0 ? Projection::orthographic : Projection::perspective;
        camera.distance = std::exp2(random.in(-60, 60));
        Orbit orbit;
        if (random.bits() % 2 == 0) {
            const double far = std::exp2(random.in(-30, 30));
            camera.eye = radii_from_centre(mesh, mesh.centre) + random.in_cube(far);
            camera.target = random.in_cube(std::exp2(random.in(-30, 30)));
        }
        ModelTransform model;
        const double scale = std::exp2(random.in(-40, 40));
        model.scale = {scale * (random.bits() % 2 == 0 ? 1 : -1), scale * random.in(0.01, 1),
                       scale};
        model.rotate_degrees = random.in_cube(720);
        model.translate = random.in_cube(std::exp2(random.in(-10, 10)));
        const auto view =
            make_view(mesh, model, {}, camera, orbit, random.whole(1, 400), random.whole(1, 400));
        if (!view) {
            ASSERT_EQ(view.error().exit, Exit::usage);
            ++refused;
            continue;
        }
        ++views;
        ASSERT_TRUE(is_finite(*view)) << i;
        // Of unit columns: the determinant itself may be 2^-300.
        DMat3 unit = view->linear;
        for (int c = 0; c < 3; ++c)
            unit[c] /= std::sqrt(dot3(unit[c], unit[c]));
        ASSERT_GT(std::abs(determinant_of(unit)), 0.1) << i;
        ASSERT_EQ(determinant_of(unit) < 0, view->mirrored) << i;
        if (view->projection != Projection::perspective) {
            const double origin = -view->translation.z; // of the model's centre
            ASSERT_GT((-origin - view->depth_origin) * view->depth_scale, 0) << i;
            ASSERT_LT((-origin - view->depth_origin) * view->depth_scale, 1) << i;
            continue;
        }
        ASSERT_GT(view->near_distance, 0) << i;
        const double reach =
            mesh.radius * std::max({std::abs(model.scale.x), model.scale.y, model.scale.z});
        const double far = view->centre_distance + reach; // behind the eye: below 0
        if (far > 0) least = std::min(least, view->near_distance / far);
        no_fitted_near += view->centre_distance - reach <= 0 ? 1 : 0;
    }
    EXPECT_GT(views, 100'000);
    EXPECT_GT(refused, 0);
    EXPECT_GT(no_fitted_near, 10'000); // where "the distance of what is nearest" is no near plane
    RecordProperty("views", views);
    RecordProperty("refused", refused);
    RecordProperty("without_a_fitted_near_plane", no_fitted_near);
    RecordProperty("least_near_to_far", testing::PrintToString(least));
}

} // namespace
} // namespace scanout::scene
