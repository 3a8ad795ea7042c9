// Lights that keys and drags move.
#include "viewer_bench.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

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
