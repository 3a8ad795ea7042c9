#include "viewer_bench.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::app {
namespace {

struct Pair {
    Id forth, back;
};
constexpr std::array kPairs = {
    Pair{Id::rotate_left, Id::rotate_right}, Pair{Id::rotate_up, Id::rotate_down},
    Pair{Id::move_left, Id::move_right},     Pair{Id::move_up, Id::move_down},
    Pair{Id::scale_up, Id::scale_down},      Pair{Id::roll_left, Id::roll_right}};

RC_GTEST_PROP(Viewer, ForthAndBackInAnyOrderIsTheIdentity, (bool camera)) {
    Bench bench;
    if (camera) bench.act(Id::toggle_drive);
    std::vector<Id> path;
    // Elevation stops at the poles and the scale at its limits: short walks stay within.
    for (const Pair& pair : kPairs) {
        const int count = *rc::gen::inRange(0, 8);
        path.insert(path.end(), static_cast<std::size_t>(count), pair.forth);
    }
    const Look start = bench.look();
    for (const Id id : path)
        bench.act(id);
    for (const Id id : path)
        for (const Pair& pair : kPairs)
            if (pair.forth == id) bench.act(pair.back);
    RC_ASSERT(bench.look() == start);
}

TEST(Viewer, AThousandFullTurnsEndWhereTheyBegan) {
    for (const bool camera : {false, true}) {
        Bench bench;
        if (camera) bench.act(Id::toggle_drive);
        bench.act(Id::roll_left);
        const scene::View before = bench.view();
        for (int i = 0; i < 1000 * 72; ++i)
            bench.act(Id::rotate_left);
        const scene::View after = bench.view();
        EXPECT_EQ(std::memcmp(&before.linear, &after.linear, sizeof before.linear), 0)
            << "camera " << camera;
    }
}

// HARD-CASES 22. libm's exp2l is the oracle.
TEST(Viewer, AMillionZoomStepsStayWithinFourUlpOfTheClosedForm) {
    Bench bench;
    std::uint32_t random = 1;
    std::int64_t expected = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        random = random * 1664525U + 1013904223U;
        const bool up = (random >> 31) != 0;
        bench.act(up ? Id::scale_up : Id::scale_down);
        expected = scene::clamp_zoom(expected + (up ? 8 : -8));
    }
    ASSERT_EQ(bench.look().pose.zoom, expected);
    const double scale = scene::zoom_scale(bench.look().pose.zoom);
    const auto exact = static_cast<double>(std::exp2(static_cast<long double>(expected) / 64));
    const double ulp = std::nextafter(exact, 1e300) - exact;
    EXPECT_LE(std::abs(scale - exact), 4 * ulp);
}

TEST(Viewer, ScaleStopsAtItsLimitsAndComesBackFromThem) {
    Bench bench;
    for (int i = 0; i < 1000; ++i)
        bench.act(Id::scale_up);
    EXPECT_EQ(bench.look().pose.zoom, scene::kMaxZoomLevel);
    EXPECT_TRUE(bench.viewer.view(bench.mesh));
    for (int i = 0; i < 2000; ++i)
        bench.act(Id::scale_down);
    EXPECT_EQ(bench.look().pose.zoom, -scene::kMaxZoomLevel);
    EXPECT_TRUE(bench.viewer.view(bench.mesh));
}

// HARD-CASES 24: a drag counts from where it began, so a closed loop is no turn at all.
RC_GTEST_PROP(Viewer, ADragThatReturnsToItsStartChangesNothing, (bool camera, int kind)) {
    const std::array kinds = {Id::drag_rotate, Id::drag_move, Id::drag_roll};
    const Id id = kinds[static_cast<std::size_t>(std::abs(kind % 3))];
    Bench bench;
    if (camera) bench.act(Id::toggle_drive);
    bench.act(Id::rotate_up);
    const Look start = bench.look();
    bench.act(Id::drag_begin);
    for (int i = 0; i < 20; ++i)
        bench.act(id, {*rc::gen::inRange(-5000, 5000), *rc::gen::inRange(-5000, 5000), 0});
    bench.act(id, {0, 0, 0});
    bench.act(Id::drag_end);
    RC_ASSERT(bench.look() == start);
}

TEST(Viewer, ADragOverThePicturesHeightIsHalfATurnInHoweverManySteps) {
    for (const int steps : {1, 3, 480}) {
        Bench bench;
        bench.act(Id::drag_begin);
        for (int i = 1; i <= steps; ++i)
            bench.act(Id::drag_rotate, {480 * i / steps, 0, 0});
        EXPECT_EQ(bench.look().pose.yaw, scene::kFullTurn / 2) << steps;
    }
}

TEST(Viewer, AMoveDragKeepsTheModelsCentreUnderThePointer) {
    for (const bool camera : {false, true})
        for (const bool orthographic : {false, true}) {
            Bench bench;
            if (camera) bench.act(Id::toggle_drive);
            if (orthographic) bench.act(Id::toggle_projection);
            const scene::View start = bench.view();
            bench.act(Id::drag_begin);
            bench.act(Id::drag_move, {100, -50, 0});
            const scene::View view = bench.view();
            const double unit = scene::world_units_per_pixel(view, 480);
            EXPECT_NEAR((view.translation.x - start.translation.x) / unit, 100, 1e-3);
            EXPECT_NEAR((view.translation.y - start.translation.y) / unit, 50, 1e-3);
        }
}

TEST(Viewer, TheWheelKeepsThePointUnderThePointer) {
    for (const bool camera : {false, true}) {
        Bench bench;
        if (camera) bench.act(Id::toggle_drive);
        bench.act(Id::move_right);
        const int x = 500, y = 100;
        // The point of the model that lies under the pixel, relative to the model's centre and in
        // units of its size, must be the same afterwards.
        const auto under = [&] {
            const scene::View view = bench.view();
            const double unit = scene::world_units_per_pixel(view, 480);
            const double size = scene::zoom_scale(bench.look().pose.zoom);
            return DVec2(((x + 0.5 - 320) * unit - view.translation.x) / size,
                         ((240 - y - 0.5) * unit - view.translation.y) / size);
        };
        const DVec2 before = under();
        bench.act(Id::zoom_at, {24, x, y});
        EXPECT_NEAR(under().x, before.x, 1e-5) << camera;
        EXPECT_NEAR(under().y, before.y, 1e-5) << camera;
        EXPECT_EQ(camera ? bench.look().orbit.zoom : bench.look().pose.zoom, 24);
    }
}

// HARD-CASES 25.
TEST(Viewer, TheCameraStopsAtThePolesAndTurnsBackAtOnce) {
    Settings settings;
    settings.camera.elevation_degrees = 20;
    Bench bench(settings);
    bench.act(Id::toggle_drive);
    for (int i = 0; i < 100; ++i)
        bench.act(Id::rotate_up);
    EXPECT_EQ(bench.look().orbit.elevation, 70 * scene::kAngleUnitsPerDegree);
    const Look top = bench.look();
    bench.act(Id::rotate_down);
    EXPECT_EQ(top.orbit.elevation - bench.look().orbit.elevation, 5 * scene::kAngleUnitsPerDegree);
}

RC_GTEST_PROP(Viewer, UndoBringsBackEveryEarlierLook, ()) {
    Bench bench;
    std::vector<Look> looks = {bench.look()};
    for (int i = 0; i < 30; ++i) {
        const auto id = static_cast<Id>(*rc::gen::inRange(0, static_cast<int>(Id::toggle_info)));
        bench.act(id);
        if (!(bench.look() == looks.back())) looks.push_back(bench.look());
    }
    for (std::size_t i = looks.size(); i-- > 1;) {
        RC_ASSERT(bench.look() == looks[i]);
        bench.act(Id::undo);
    }
    RC_ASSERT(bench.look() == looks.front());
    bench.act(Id::undo);
    RC_ASSERT(bench.look() == looks.front());
}

TEST(Viewer, ADragAndAHeldKeyAreUndoneAtOnce) {
    Bench bench;
    const Look start = bench.look();
    bench.act(Id::drag_begin);
    for (int i = 1; i < 50; ++i)
        bench.act(Id::drag_rotate, {i, i, 0});
    bench.act(Id::drag_end);
    const Look dragged = bench.look();
    bench.act(Id::rotate_left);
    for (int i = 0; i < 20; ++i)
        bench.viewer.apply({Id::rotate_left, {}, {}, true}, &bench.mesh);
    bench.act(Id::undo);
    EXPECT_EQ(bench.look(), dragged);
    bench.act(Id::undo);
    EXPECT_EQ(bench.look(), start);
}

RC_GTEST_PROP(Viewer, ResetIsTheStartWhateverWasDone, ()) {
    Settings settings;
    settings.camera.projection = scene::Projection::orthographic;
    settings.camera.up = scene::UpAxis::minus_z;
    settings.frame.cull = frame::Cull::front;
    Bench bench(settings);
    const Look start = bench.look();
    for (int i = 0; i < 30; ++i) {
        bench.act(static_cast<Id>(*rc::gen::inRange(0, static_cast<int>(Id::undo))),
                  {*rc::gen::inRange(-9, 9), *rc::gen::inRange(0, 640), *rc::gen::inRange(0, 480)});
        bench.viewer.advance_to(bench.viewer.step_number() + 7);
    }
    const Look before = bench.look();
    bench.act(Id::reset);
    RC_ASSERT(bench.look() == start);
    bench.act(Id::undo);
    RC_ASSERT(bench.look() == before || before == start);
}

TEST(Viewer, TakesTheUpAxisOfAFileUntilTheUserChooses) {
    Bench bench;
    bench.viewer.take_up_of_file(scene::UpAxis::plus_z);
    EXPECT_EQ(bench.look().up, scene::UpAxis::plus_z);
    bench.viewer.take_up_of_file(scene::UpAxis::plus_y);
    EXPECT_EQ(bench.look().up, scene::UpAxis::plus_y);
    bench.act(Id::up_axis_next);
    bench.act(Id::up_axis_next);
    bench.viewer.take_up_of_file(scene::UpAxis::plus_z);
    EXPECT_EQ(bench.look().up, scene::UpAxis::plus_x) << "the user's";
    bench.act(Id::reset);
    EXPECT_EQ(bench.look().up, scene::UpAxis::plus_z) << "the file's";
}

// What a hand did is undone; what the turntable turned meanwhile is not.
TEST(Viewer, UndoLeavesTheTurntablesTurnAlone) {
    Bench bench;
    bench.act(Id::toggle_turntable);
    bench.viewer.advance_to(100);
    bench.act(Id::rotate_up);
    bench.viewer.advance_to(250);
    bench.act(Id::undo);
    EXPECT_EQ(bench.look().pose.pitch, 0);
    EXPECT_EQ(bench.look().pose.yaw, 250 * kTurntableUnitsPerStep) << "no jump back to step 100";
    bench.act(Id::undo);
    EXPECT_FALSE(bench.look().turntable) << "the switch was the hand's";
    EXPECT_EQ(bench.look().pose.yaw, 250 * kTurntableUnitsPerStep);
}

TEST(Viewer, ASwitchAnswersWithItsNewState) {
    Bench bench;
    for (const auto& [id, answer] : std::vector<std::pair<Id, std::string>>{
             {Id::toggle_projection, "projection: orthographic"},
             {Id::toggle_projection, "projection: perspective"},
             {Id::up_axis_next, "up axis: z"},
             {Id::cull_next, "faces left out: back"},
             {Id::colour_next, "colour by: normal"},
             {Id::edges_next, "edges: feature"},
             {Id::edges_next, "edges: all"},
             {Id::edges_next, "edges: none"},
             {Id::toggle_points, "vertices: on"},
             {Id::toggle_axes, "axes: on"},
             {Id::toggle_points, "vertices: off"},
             {Id::toggle_axes, "axes: off"},
             {Id::toggle_drive, "keys drive: camera"},
             {Id::view_left, "view: left"},
             {Id::toggle_turntable, "turntable: on"},
             {Id::toggle_info, "information: on"},
             {Id::toggle_info, "information: off"},
             {Id::toggle_explain, "what runs, and why: on"},
             {Id::toggle_error_map, "map of the errors: on"},
             {Id::toggle_split, "split view: on"},
             {Id::rotate_left, ""}}) {
        bench.act(id);
        EXPECT_EQ(bench.viewer.answer(), answer);
    }
}

TEST(Viewer, AKeyThatCanDoNothingSaysWhy) {
    Bench bench;
    bench.act(Id::undo);
    EXPECT_EQ(bench.viewer.answer(), "nothing to undo");
    Viewer single(Settings(), 640, 480, 1);
    single.apply({Id::next_file, {}, {}, false}, nullptr);
    EXPECT_EQ(single.answer(), "there is one file only");
}

TEST(Viewer, TheTurntableTurnsByStepsHoweverTheyAreCut) {
    Bench once, often;
    once.act(Id::toggle_turntable);
    often.act(Id::toggle_turntable);
    once.viewer.advance_to(777);
    for (int step = 1; step <= 777; ++step)
        often.viewer.advance_to(step);
    EXPECT_EQ(once.look(), often.look());
    EXPECT_EQ(once.look().pose.yaw, scene::wrap_angle(std::int64_t{777} * kTurntableUnitsPerStep));
    once.viewer.advance_to(scene::kFullTurn / kTurntableUnitsPerStep);
    EXPECT_EQ(once.look().pose.yaw, 0) << "960 steps are a full turn";
}

TEST(Viewer, ThePointerHidesAfterThreeSecondsWithoutMotion) {
    Bench bench;
    EXPECT_FALSE(bench.viewer.moving());
    bench.act(Id::pointer, {10, 20, 0});
    bench.viewer.advance_to(100);
    bench.act(Id::pointer, {11, 20, 0});
    bench.viewer.advance_to(279);
    EXPECT_TRUE(bench.viewer.state().pointer.visible);
    bench.viewer.advance_to(280);
    EXPECT_FALSE(bench.viewer.state().pointer.visible);
    EXPECT_FALSE(bench.viewer.moving());
}

TEST(Viewer, NamedViewsLookFromTheSideOfTheirName) {
    Settings settings;
    settings.camera.azimuth_degrees = 33;
    settings.camera.eye = DVec3(1, 2, 3);
    settings.camera.target = DVec3(0, 0, 0);
    struct Row {
        Id id;
        DVec3 towards_eye; // unit, world
    };
    for (const Row& row : {Row{Id::view_front, {0, 0, 1}}, Row{Id::view_back, {0, 0, -1}},
                           Row{Id::view_right, {1, 0, 0}}, Row{Id::view_left, {-1, 0, 0}},
                           Row{Id::view_top, {0, 1, 0}}, Row{Id::view_bottom, {0, -1, 0}}}) {
        Bench bench(settings);
        bench.act(Id::rotate_left);
        bench.act(row.id);
        const DVec3 seen = bench.view().linear * row.towards_eye; // of a model of radius 1
        EXPECT_NEAR(seen.z, 1, 1e-12) << row_of(row.id).name;
    }
}

TEST(Viewer, FilesGoRoundAndASingleFileStays) {
    Bench bench;
    EXPECT_EQ(bench.act(Id::previous_file), Effect::load_file);
    EXPECT_EQ(bench.viewer.state().file, 2);
    EXPECT_EQ(bench.act(Id::next_file), Effect::load_file);
    EXPECT_EQ(bench.viewer.state().file, 0);
    Viewer single(Settings(), 640, 480, 1);
    EXPECT_EQ(single.apply({Id::next_file, {}, {}, false}, nullptr), Effect::none);
}

TEST(Viewer, EscapeClosesWhatIsOpenBeforeItQuits) {
    Bench bench;
    bench.act(Id::toggle_info);
    bench.act(Id::toggle_explain);
    bench.act(Id::toggle_error_map);
    bench.act(Id::toggle_split);
    EXPECT_EQ(bench.act(Id::rung_down), Effect::rung_down);
    EXPECT_EQ(bench.act(Id::rung_up), Effect::rung_up);
    EXPECT_TRUE(bench.viewer.state().frontier);
    bench.act(Id::light_next);
    for (int open = 0; open < 6; ++open)
        EXPECT_EQ(bench.act(Id::close), Effect::none);
    EXPECT_FALSE(bench.viewer.state().info);
    EXPECT_EQ(bench.act(Id::close), Effect::quit);
}

TEST(Viewer, EscapeClosesTheHelpAndElseQuits) {
    Bench bench;
    bench.act(Id::toggle_help);
    EXPECT_EQ(bench.act(Id::close), Effect::none);
    EXPECT_EQ(bench.viewer.state().help, 0);
    EXPECT_EQ(bench.act(Id::close), Effect::quit);
}

TEST(Viewer, ThePointerDragsTheSplitLineItStandsOnAndElseTheModel) {
    Bench bench;
    const auto drag_from = [&](int x, int by) {
        bench.act(Id::pointer, {x, 100, 0});
        bench.act(Id::drag_begin);
        bench.act(Id::drag_rotate, {by / 2, 3, 0});
        bench.act(Id::drag_rotate, {by, 7, 0});
        bench.act(Id::drag_end);
    };
    drag_from(320, 50);
    EXPECT_EQ(bench.viewer.state().split_x, 320) << "no split view is open";
    EXPECT_NE(bench.look().pose.yaw, 0);
    bench.act(Id::undo);
    bench.act(Id::toggle_split);
    const Look before = bench.look();
    drag_from(324, -50);
    EXPECT_EQ(bench.viewer.state().split_x, 270);
    EXPECT_EQ(bench.look(), before);
    drag_from(270, 2'000'000'000);
    EXPECT_EQ(bench.viewer.state().split_x, 640) << "not beyond the picture";
    drag_from(400, 50);
    EXPECT_NE(bench.look(), before) << "beside the line";
}

TEST(Viewer, KeysMoveTheSplitLineAndOpenIt) {
    Bench bench;
    bench.act(Id::split_left);
    EXPECT_TRUE(bench.viewer.state().split);
    EXPECT_EQ(bench.viewer.state().split_x, 310);
    for (int i = 0; i < 100; ++i)
        bench.act(Id::split_right);
    EXPECT_EQ(bench.viewer.state().split_x, 640);
    bench.act(Id::split_left);
    EXPECT_EQ(bench.viewer.state().split_x, 630);
}

RC_GTEST_PROP(Viewer, NoSequenceOfActionsMakesACameraThatSeesNothing, (bool no_mesh)) {
    Bench bench;
    for (int i = 0; i < 60; ++i) {
        const auto id = static_cast<Id>(*rc::gen::inRange(0, static_cast<int>(Id::frame)));
        const Action action{
            id,
            {*rc::gen::arbitrary<int>(), *rc::gen::arbitrary<int>(), *rc::gen::arbitrary<int>()},
            {},
            false};
        bench.viewer.apply(action, no_mesh ? nullptr : &bench.mesh);
        bench.viewer.advance_to(bench.viewer.step_number() + *rc::gen::inRange(0, 1000));
        RC_ASSERT(bench.viewer.view(bench.mesh).has_value());
    }
}

// ---- Lights

} // namespace
} // namespace scanout::app
