// The camera that flies, moves in depth, scale along one axis, and inertia.
#include "app/options/command_line.h"
#include "app/view/view_command.h"
#include "viewer_bench.h"

#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

DVec3 eye_of(const scene::View& view) { // world, from the model's centre before it is moved
    return transpose(scene::rotation_of(view)) * -view.world_origin;
}
DVec3 ahead_of(const scene::View& view) {
    return transpose(scene::rotation_of(view)) * DVec3(0, 0, -1);
}
void expect_near(const DVec3& a, const DVec3& b, double tolerance = 1e-9) {
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(a[axis], b[axis], tolerance) << axis;
}
// How far the views are apart, in numbers.
double apart(const scene::View& a, const scene::View& b) {
    double worst = 0;
    for (int c = 0; c < 3; ++c) {
        worst = std::max(worst, std::abs(a.translation[c] - b.translation[c]));
        worst = std::max(worst, std::abs(a.world_origin[c] - b.world_origin[c]));
        for (int r = 0; r < 3; ++r) {
            worst = std::max(worst, std::abs(a.linear[c][r] - b.linear[c][r]));
            worst = std::max(worst, std::abs(a.world_axes[c][r] - b.world_axes[c][r]));
        }
    }
    return worst;
}

TEST(Flight, BeginsWhereTheOrbitIsAndGoesWhereItLooks) {
    Bench bench;
    const scene::View orbit = bench.view();
    bench.act(Id::toggle_fly);
    EXPECT_EQ(apart(bench.view(), orbit), 0);
    const DVec3 ahead = ahead_of(orbit);
    bench.act(Id::fly_forward);
    expect_near(eye_of(bench.view()) - eye_of(orbit), ahead / 64.0, 1e-6);
    bench.act(Id::fly_back);
    bench.act(Id::rotate_left);
    EXPECT_LT(dot3(ahead_of(bench.view()), transpose(scene::rotation_of(orbit))[0]), 1);
    expect_near(eye_of(bench.view()), eye_of(orbit), 1e-6); // it turns where it is
    EXPECT_NEAR(dot3(ahead_of(bench.view()), ahead), 1, 0.01);
    EXPECT_LT(dot3(ahead_of(bench.view()), transpose(scene::rotation_of(orbit)) * DVec3(1, 0, 0)),
              0)
        << "to the left";
    const double height = ahead_of(bench.view()).y;
    bench.act(Id::rotate_up);
    EXPECT_GT(ahead_of(bench.view()).y, height);
    bench.act(Id::fly_up);
    EXPECT_GT(eye_of(bench.view()).y, eye_of(orbit).y);
}

TEST(Flight, TheHorizonStaysLevelAndThePolesAreNotPassed) {
    Bench bench;
    bench.act(Id::toggle_fly);
    for (int i = 0; i < 100; ++i)
        bench.act(Id::rotate_up), bench.act(Id::rotate_left);
    const DMat3 to_world = transpose(scene::rotation_of(bench.view()));
    EXPECT_NEAR((to_world * DVec3(1, 0, 0)).y, 0, 1e-12) << "the camera's right is level";
    EXPECT_GT((to_world * DVec3(0, 1, 0)).y, 0) << "and its up is up";
    EXPECT_NEAR(ahead_of(bench.view()).y, std::sin(89 * 3.14159265358979 / 180), 1e-3);
    for (int i = 0; i < 200; ++i)
        bench.act(Id::rotate_down);
    EXPECT_GT((transpose(scene::rotation_of(bench.view())) * DVec3(0, 1, 0)).y, 0);
}

TEST(Flight, EveryStepCanBeUndoneAndTheKeyGoesBackToTheOrbit) {
    Bench bench;
    const Look start = bench.look();
    std::vector<Look> looks = {start};
    for (const Id id : {Id::toggle_fly, Id::fly_forward, Id::fly_left, Id::rotate_up, Id::move_up,
                        Id::fly_down, Id::toggle_fly}) {
        bench.act(id);
        looks.push_back(bench.look());
    }
    EXPECT_EQ(bench.look(), start);
    for (std::size_t i = looks.size() - 1; i-- > 0;) {
        bench.act(Id::undo);
        EXPECT_EQ(bench.look(), looks[i]) << i;
    }
}

TEST(Flight, AWheelAndADragMoveTheCamera) {
    Bench bench;
    bench.act(Id::toggle_fly);
    const scene::View start = bench.view();
    bench.act(Id::zoom_at, {8, 10, 10});
    EXPECT_GT(dot3(eye_of(bench.view()) - eye_of(start), ahead_of(start)), 0.1);
    bench.act(Id::undo);
    bench.act(Id::drag_begin);
    bench.act(Id::drag_rotate, {100, 0});
    bench.act(Id::drag_rotate, {64, 48});
    bench.act(Id::drag_end);
    const Look once = bench.look();
    EXPECT_GT(bench.look().flight.azimuth, 0) << "what is seen follows the hand to the right";
    bench.act(Id::undo);
    bench.act(Id::drag_begin);
    bench.act(Id::drag_rotate, {64, 48});
    bench.act(Id::drag_end);
    EXPECT_EQ(bench.look(), once) << "whatever the way";
}

// What K prints draws the same view.
TEST(Flight, TheCommandSaysEyeAndTarget) {
    Settings settings;
    settings.camera.azimuth_degrees = 30;
    settings.camera.elevation_degrees = 20;
    Bench bench(settings);
    bench.act(Id::rotate_left);
    bench.act(Id::toggle_fly);
    for (const Id id : {Id::fly_forward, Id::fly_right, Id::fly_up, Id::rotate_left, Id::rotate_up})
        for (int i = 0; i < 9; ++i)
            bench.act(id);
    const std::string text = view_options(bench.viewer, settings, bench.mesh);
    EXPECT_NE(text.find("--eye "), std::string::npos);
    EXPECT_NE(text.find("--look-at "), std::string::npos);
    std::vector<std::string> words = {"render", "m.obj", "-o", "a.png"};
    std::istringstream stream(text);
    for (std::string word; stream >> word;)
        words.push_back(word);
    const Result<CommandLine> parsed = parse_command_line(words);
    ASSERT_TRUE(parsed) << parsed.error().what;
    const Settings& again = parsed->settings;
    const scene::View drawn =
        *scene::make_view(bench.mesh, again.model, {}, again.camera, {}, 640, 480);
    EXPECT_LT(apart(drawn, bench.view()), 1e-8);
}

TEST(Depth, TheModelComesNearerAndGoesBack) {
    Bench bench;
    const scene::View start = bench.view();
    bench.act(Id::move_near);
    EXPECT_EQ(bench.view().translation.z, start.translation.z + 1.0 / 16);
    EXPECT_EQ(bench.view().translation.x, start.translation.x);
    bench.act(Id::move_far);
    EXPECT_EQ(apart(bench.view(), start), 0);
    bench.act(Id::toggle_drive);
    bench.act(Id::move_near);
    EXPECT_GT(bench.view().translation.z, start.translation.z) << "the camera comes nearer";
    bench.act(Id::undo);
    EXPECT_EQ(apart(bench.view(), start), 0);
}

TEST(ScaleAxis, PlusStretchesAlongTheAxisThatIsChosen) {
    Bench bench;
    const scene::View start = bench.view();
    const auto size = [&](int axis) {
        return length(bench.view().linear[axis]) / length(start.linear[axis]);
    };
    bench.act(Id::scale_axis_next);
    EXPECT_EQ(bench.viewer.answer(), "+ - scale: x alone");
    for (int i = 0; i < 8; ++i)
        bench.act(Id::scale_up);
    EXPECT_NEAR(size(0), 2, 1e-12);
    EXPECT_NEAR(size(1), 1, 1e-12);
    EXPECT_NEAR(size(2), 1, 1e-12);
    const Settings settings;
    EXPECT_NE(view_options(bench.viewer, settings, bench.mesh).find("--scale 2,1,1"),
              std::string::npos)
        << view_options(bench.viewer, settings, bench.mesh);
    bench.act(Id::scale_axis_next);
    bench.act(Id::scale_down);
    EXPECT_LT(size(1), 1);
    bench.act(Id::undo);
    EXPECT_NEAR(size(1), 1, 1e-12);
    bench.act(Id::scale_axis_next);
    bench.act(Id::scale_axis_next);
    EXPECT_EQ(bench.viewer.answer(), "+ - scale: all axes");
    bench.act(Id::reset);
    EXPECT_EQ(apart(bench.view(), start), 0);
}

struct Throw {
    explicit Throw(bool inertia, int rest = 0) : bench(with(inertia)) {
        bench.act(Id::drag_begin);
        for (int i = 1; i <= 5; ++i) {
            bench.viewer.advance_to(i);
            bench.act(Id::drag_rotate, {10 * i, 0});
        }
        bench.viewer.advance_to(5 + rest);
        bench.act(Id::drag_end);
    }
    static Settings with(bool inertia) {
        Settings settings;
        settings.inertia = inertia;
        return settings;
    }
    Bench bench;
};

TEST(Inertia, AThrownModelGoesOnAndComesToRest) {
    Throw thrown(true);
    Viewer& viewer = thrown.bench.viewer;
    const int released = viewer.state().look.pose.yaw;
    EXPECT_TRUE(viewer.turning());
    EXPECT_EQ(viewer.next_step(), 6);
    viewer.advance_to(6);
    const int first = viewer.state().look.pose.yaw - released;
    viewer.advance_to(7);
    const int second = viewer.state().look.pose.yaw - released - first;
    EXPECT_GT(first, 0);
    EXPECT_GT(second, 0);
    EXPECT_LT(second, first) << "it slows down";
    viewer.advance_to(5 + 5 * kStepsPerSecond);
    EXPECT_FALSE(viewer.turning()) << "and then nothing moves";
    EXPECT_FALSE(viewer.moving());
    const Look rest = viewer.state().look;
    viewer.advance_to(10'000);
    EXPECT_EQ(viewer.state().look, rest);
    thrown.bench.act(Id::undo);
    EXPECT_EQ(viewer.state().look, Bench().look()) << "the drag and all that came of it";
}

TEST(Inertia, IsTheSameHoweverTheStepsCome) {
    Throw one(true), many(true);
    one.bench.viewer.advance_to(300);
    for (int step = 6; step <= 300; ++step)
        many.bench.viewer.advance_to(step);
    EXPECT_EQ(one.bench.look(), many.bench.look());
}

TEST(Inertia, IsOffUnlessAskedForAndNeedsAThrow) {
    EXPECT_FALSE(Throw(false).bench.viewer.turning());
    EXPECT_FALSE(Throw(true, 10).bench.viewer.turning()) << "the hand had come to rest";
    Throw stopped(true);
    stopped.bench.viewer.advance_to(8);
    stopped.bench.act(Id::rotate_up);
    EXPECT_FALSE(stopped.bench.viewer.turning());
}

} // namespace
} // namespace scanout::app
