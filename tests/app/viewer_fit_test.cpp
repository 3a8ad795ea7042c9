// Where the model stands so that it fits the picture.
#include "viewer_bench.h"

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

// The corners of the triangle, in pixels from the picture's middle.
std::vector<std::pair<double, double>> corners(const Bench& bench) {
    const scene::View view = bench.view();
    std::vector<std::pair<double, double>> places;
    for (const Vec3& v : bench.mesh.position) {
        const DVec3 seen = view.linear * DVec3(v.x, v.y, v.z) + view.translation;
        const double distance = view.projection == scene::Projection::perspective ? -seen.z : 1;
        places.emplace_back(320 * seen.x / (distance * view.half_width),
                            240 * seen.y / (distance * view.half_height));
    }
    return places;
}

TEST(Viewer, FFitsTheModelIntoThePictureFromWhereverItIs) {
    for (const Id projection : {Id::rotate_left, Id::toggle_projection})
        for (const bool camera : {false, true}) {
            Bench bench;
            bench.act(projection);
            if (camera) bench.act(Id::toggle_drive);
            bench.act(Id::rotate_up);
            bench.act(Id::roll_left);
            for (int i = 0; i < 40; ++i)
                bench.act(Id::move_right);
            for (int i = 0; i < 50; ++i)
                bench.act(Id::scale_up);
            const Look lost = bench.look();
            bench.act(Id::fit);
            EXPECT_EQ(bench.viewer.answer(), "");
            EXPECT_EQ(bench.look().pose.roll, lost.pose.roll) << "turned as it was";
            EXPECT_EQ(bench.look().orbit.elevation, lost.orbit.elevation);
            double left = 0, right = 0, bottom = 0, top = 0;
            for (const auto& [x, y] : corners(bench)) {
                left = std::min(left, x), right = std::max(right, x);
                bottom = std::min(bottom, y), top = std::max(top, y);
            }
            EXPECT_GT(std::min({left / 320, -right / 320, bottom / 240, -top / 240}), -0.901);
            EXPECT_GT(std::max((right - left) / 640, (top - bottom) / 480), 0.87) << "no smaller";
            EXPECT_NEAR(left + right, 0, 6) << "in the middle";
            EXPECT_NEAR(bottom + top, 0, 6);
            bench.act(Id::undo);
            EXPECT_EQ(bench.look(), lost);
        }
}

// The vertices in the picture: -1 to 1 is from edge to edge.
double widest_in(const geom::Mesh& mesh, const scene::View& view) {
    double widest = 0;
    for (const Vec3& vertex : mesh.position) {
        const DVec3 p = view.linear * DVec3(vertex) + view.translation;
        const double away = view.projection == scene::Projection::perspective ? -p.z : 1;
        widest = std::max({widest, std::abs(p.x) / (away * view.half_width),
                           std::abs(p.y) / (away * view.half_height)});
    }
    return widest;
}

TEST(Viewer, TheModelFitsAtTheStartAndInEveryNamedViewWhateverWasBefore) {
    for (const bool orthographic : {false, true}) {
        Bench bench;
        if (orthographic) bench.act(Id::toggle_projection);
        EXPECT_NEAR(widest_in(bench.mesh, bench.view()), 0.9, 1e-9);
        for (const Id view : {Id::view_front, Id::view_back, Id::view_iso}) { // it is flat
            for (const Id away : {Id::scale_up, Id::move_left, Id::toggle_drive, Id::scale_up,
                                  Id::move_up, Id::roll_left, Id::toggle_drive})
                bench.act(away);
            bench.act(view);
            EXPECT_NEAR(widest_in(bench.mesh, bench.view()), 0.9, 1e-9);
        }
        bench.act(Id::reset);
        EXPECT_NEAR(widest_in(bench.mesh, bench.view()), 0.9, 1e-9);
    }
}

TEST(Viewer, TheNextFileFitsAnewAndStaysTurned) {
    Bench bench;
    const scene::View first = bench.view();
    bench.act(Id::rotate_left);
    bench.act(Id::scale_up);
    bench.act(Id::move_left);
    for (Vec3& vertex : bench.mesh.position)
        vertex = vertex * 0.5F;
    const int yaw = bench.look().pose.yaw;
    bench.viewer.take_file(true);
    EXPECT_NE(bench.look().pose.zoom, 0) << "the same file again: the user's place stays";
    bench.viewer.take_file(false);
    EXPECT_EQ(bench.look().pose.zoom, 0);
    EXPECT_EQ(bench.look().pose.pan_x, 0);
    EXPECT_EQ(bench.look().pose.yaw, yaw);
    EXPECT_LT(bench.view().target_distance, first.target_distance * 0.6);
}

} // namespace
} // namespace scanout::app
