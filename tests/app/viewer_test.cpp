#include "app/viewer.h"
#include "triangle_mesh.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::app {
namespace {

using Id = ActionId;

struct Bench {
    explicit Bench(const Settings& settings = {}) : viewer(settings, 640, 480, 3) {}
    Effect act(Id id, std::array<int, 3> numbers = {}) {
        return viewer.apply({id, numbers, {}, false}, &mesh);
    }
    const Look& look() const { return viewer.state().look; }
    scene::View view() const { return *viewer.view(mesh); }
    geom::Mesh mesh = test::triangle_mesh();
    Viewer viewer;
};

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
    EXPECT_FALSE(bench.viewer.state().help);
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

TEST(ViewerLights, AreThoseOfTheCommandLineUntilTheyAreMoved) {
    Bench bench;
    EXPECT_EQ(bench.viewer.lights(bench.mesh), scene::default_lights());
    bench.act(Id::light_next);
    EXPECT_EQ(bench.viewer.state().light, 0);
    EXPECT_EQ(bench.viewer.lights(bench.mesh), scene::default_lights());
    bench.act(Id::rotate_left);
    const std::vector<scene::Light> moved = bench.viewer.lights(bench.mesh);
    EXPECT_NE(moved[0].towards, scene::default_lights()[0].towards);
    EXPECT_EQ(moved[1], scene::default_lights()[1]);
    EXPECT_EQ(bench.look().pose, scene::Pose()) << "the model stays";
}

TEST(ViewerLights, AreSelectedInTurnAndLetGoByEscape) {
    Bench bench;
    for (const int expected : {0, 1, 2, 0}) {
        bench.act(Id::light_next);
        EXPECT_EQ(bench.viewer.state().light, expected);
    }
    bench.act(Id::toggle_help);
    EXPECT_EQ(bench.act(Id::close), Effect::none);
    EXPECT_EQ(bench.viewer.state().light, 0) << "the help goes first";
    EXPECT_EQ(bench.act(Id::close), Effect::none);
    EXPECT_EQ(bench.viewer.state().light, -1);
    EXPECT_EQ(bench.act(Id::close), Effect::quit);
    bench.act(Id::rotate_left);
    EXPECT_NE(bench.look().pose.yaw, 0) << "the keys turn the model again";
}

TEST(ViewerLights, ForthAndBackIsTheIdentityAndUndoBringsThemBack) {
    Bench bench;
    bench.act(Id::light_next);
    const Look start = bench.look();
    for (const auto& [forth, back] : {std::pair{Id::rotate_left, Id::rotate_right},
                                      {Id::rotate_up, Id::rotate_down},
                                      {Id::scale_up, Id::scale_down}}) {
        for (int i = 0; i < 5; ++i)
            bench.act(forth);
        EXPECT_FALSE(bench.look() == start);
        for (int i = 0; i < 5; ++i)
            bench.act(back);
        EXPECT_TRUE(bench.look() == start);
    }
    bench.act(Id::scale_up);
    EXPECT_GT(bench.viewer.lights(bench.mesh)[0].power, 0.8);
    bench.act(Id::undo);
    EXPECT_TRUE(bench.look() == start);
    bench.act(Id::rotate_up);
    bench.act(Id::reset);
    EXPECT_TRUE(bench.look() == start);
    EXPECT_EQ(bench.viewer.state().light, 0) << "it stays selected";
}

TEST(ViewerLights, StopAtThePoles) {
    Bench bench;
    bench.act(Id::light_next);
    for (int i = 0; i < 100; ++i)
        bench.act(Id::rotate_up);
    const auto elevation = [&] {
        return place_of(bench.viewer.lights(bench.mesh)[0], scene::UpAxis::plus_y, bench.mesh)
            .elevation_degrees;
    };
    EXPECT_NEAR(elevation(), 90, 0.01);
    bench.act(Id::rotate_down);
    EXPECT_NEAR(elevation(), 85, 0.01) << "no dead way back";
}

TEST(ViewerLights, ADragIsTheSameInOneStepAndInMany) {
    Bench one, many;
    for (Bench* bench : {&one, &many}) {
        bench->act(Id::light_next);
        bench->act(Id::drag_begin);
    }
    one.act(Id::drag_rotate, {120, -40, 0});
    for (int i = 1; i <= 40; ++i)
        many.act(Id::drag_rotate, {3 * i, -i, 0});
    EXPECT_TRUE(one.look() == many.look());
    EXPECT_EQ(one.look().pose, scene::Pose());
    EXPECT_GT(one.look().lights[0].azimuth, 0);   // right
    EXPECT_GT(one.look().lights[0].elevation, 0); // and up
    one.act(Id::drag_end);
    one.act(Id::undo);
    EXPECT_EQ(one.look().lights[0], scene::LightMove());
}

TEST(ViewerLights, TheLineNamesTheOneThatIsSelected) {
    Bench bench;
    EXPECT_EQ(bench.viewer.light_line(bench.mesh, 80), "");
    bench.act(Id::light_next);
    EXPECT_EQ(bench.viewer.light_line(bench.mesh, 80),
              "light 1 of 3: key  azimuth -51  elevation 38  power 0.8");
    EXPECT_EQ(bench.viewer.light_line(bench.mesh, 54), // one letter less than it has
              "light 1 of 3: key  az -51  el 38  power 0.8");
    bench.act(Id::light_next);
    bench.act(Id::light_next);
    EXPECT_EQ(bench.viewer.light_line(bench.mesh, 80),
              "light 3 of 3: hemisphere  azimuth 0  elevation 90  power 0.18");
    Settings dark;
    dark.frame.lights.clear();
    Bench none(dark);
    none.act(Id::light_next);
    EXPECT_EQ(none.viewer.state().light, -1);
    EXPECT_EQ(none.viewer.light_line(none.mesh, 80), "");
}

} // namespace
} // namespace scanout::app
