// Triangles are drawn in spatial order where the file has them in no order (geom/spatial_order.h),
// and pictures do not show it: what is seen where depths are equal, and what is blended first, goes
// by the order of the file.
#include "frame/renderer.h"
#include "geom/spatial_order.h"
#include "support/lights.h"
#include "support/scenes.h"

#include <algorithm>
#include <numeric>

namespace scanout::test {
namespace {

// A sheet of triangles of any order; another one in the same plane, moved by half a cell; a ball
// through both. Seen from the front, all of a plane is equally deep. `opacity`: of the sheets.
Shot sheets(float opacity) {
    Shot s = shot("sheets", 160, 120);
    s.scene.materials = {plain({0.8F, 0.1F, 0.1F}), plain({0.1F, 0.7F, 0.2F}),
                         plain({0.2F, 0.3F, 0.9F})};
    s.scene.materials[0].opacity = s.scene.materials[1].opacity = opacity;
    geom::Mesh& mesh = s.scene.mesh;
    constexpr int kSide = 30;
    for (int sheet = 0; sheet < 2; ++sheet)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const auto at = [&](int i) {
                    return (static_cast<float>(i) + 0.5F * static_cast<float>(sheet)) *
                               (1.6F / kSide) -
                           0.8F;
                };
                add_quad(mesh,
                         {{{at(x), at(y), 0},
                           {at(x + 1), at(y), 0},
                           {at(x + 1), at(y + 1), 0},
                           {at(x), at(y + 1), 0}}},
                         {0, 0, 1}, sheet);
            }
    add_sphere(mesh, {0.1F, 0, 0}, 0.3F, 48, 24, 2);
    mesh.uv.clear();
    // Which of the sheets is first differs from place to place.
    Random random(17);
    for (std::size_t i = mesh.triangles(); i-- > 1;) {
        const auto j = static_cast<std::size_t>(random.whole(0, static_cast<int>(i)));
        for (std::size_t k = 0; k < 3; ++k)
            std::swap(mesh.index[i * 3 + k], mesh.index[j * 3 + k]);
        std::swap(mesh.material[i], mesh.material[j]);
    }
    s.camera.azimuth_degrees = s.camera.elevation_degrees = 0;
    return s;
}

// The same with clusters in spatial order; vertices in their order as well.
Shot in_spatial_order(const Shot& shot) {
    Shot placed = shot;
    Jobs jobs(2);
    std::vector<std::uint32_t> order;
    EXPECT_TRUE(geom::spatial_order(jobs, placed.scene.mesh, order, [](double) { return true; }));
    EXPECT_FALSE(order.empty());
    EXPECT_FALSE(std::is_sorted(order.begin(), order.end()));
    geom::order_vertices(jobs, placed.scene.mesh, order);
    placed.scene.mesh.clusters = geom::find_clusters(jobs, placed.scene.mesh, std::move(order));
    return placed;
}

struct Asked {
    const char *axis, *technique;
};
constexpr Asked kRules[] = {
    {"depth", "reversed"},       {"depth", "fixed_16"},
    {"depth", "float_32"},       {"depth_test", "greater"},
    {"depth_test", "always"},    {"depth_test", "greater_equal"},
    {"depth_test", "less"},      {"depth_test", "less_equal"},
    {"aa", "samples_4"},         {"aa", "area"},
    {"aa", "samples_8"},         {"transparency", "sorted"},
    {"transparency", "exact"},   {"stencil", "outline"},
    {"depth_test", "not_equal"}, {"shading", "gouraud"},
    {"shading", "flat"},
};

class ByPlace : public testing::TestWithParam<Asked> {};

TEST_P(ByPlace, PicturesAreThoseOfTheFilesOrder) {
    int changed = 0;
    for (const float opacity : {1.0F, 0.5F}) {
        Shot file = sheets(opacity);
        ASSERT_TRUE(frame::ask(file.options, GetParam().axis, GetParam().technique));
        Jobs jobs(1);
        file.scene.mesh.clusters = geom::find_clusters(jobs, file.scene.mesh);
        const Shot placed = in_spatial_order(file);
        frame::Visibility in_file, in_place;
        const image::Image wanted = draw(file, {.threads = 1, .visibility = &in_file});
        EXPECT_TRUE(draw(placed, {.threads = 2, .visibility = &in_place}) == wanted) << opacity;
        EXPECT_TRUE(in_file.id == in_place.id) << opacity;
        // It is seen in these scenes: were the triangles renumbered in spatial order, others would
        // be.
        Shot moved = placed;
        geom::Mesh& mesh = moved.scene.mesh;
        const std::vector<std::uint32_t> order = mesh.clusters.triangle;
        mesh.index = mesh.clusters.index;
        for (std::size_t i = 0; i < order.size(); ++i)
            mesh.material[i] = placed.scene.mesh.material[order[i]];
        mesh.clusters = geom::find_clusters(jobs, mesh);
        changed += draw(moved) == wanted ? 0 : 1;
    }
    EXPECT_GT(changed, 0);
}

INSTANTIATE_TEST_SUITE_P(Rules, ByPlace, testing::ValuesIn(kRules), [](const auto& rule) {
    return std::string(rule.param.axis) + "_" + rule.param.technique;
});

// A renderer that defers clusters finds them in spatial order, too.
TEST(ByPlace, ClustersThatWaitedAreDrawnAsTheFileHasThem) {
    const Shot file = sheets(1), placed = in_spatial_order(file);
    Jobs jobs(2);
    frame::Renderer kept(jobs);
    const frame::SceneFacts facts = frame::facts(placed.scene);
    for (int i = 0; i < 24; ++i) {
        scene::CameraOptions camera = file.camera;
        camera.azimuth_degrees += i;
        const auto view = scene::make_view(file.scene.mesh, file.model, file.pose, camera, {},
                                           file.options.width, file.options.height);
        ASSERT_TRUE(view);
        const auto plan = frame::plan(file.options, facts, *view);
        ASSERT_TRUE(plan);
        frame::Renderer fresh(jobs);
        ASSERT_TRUE(kept.render(placed.scene, *view, *plan) ==
                    fresh.render(file.scene, *view, *plan))
            << i;
    }
}

} // namespace
} // namespace scanout::test
