#include "math/quaternion.h"
#include "math/rotation.h"
#include "scene/fit.h"
#include "scene/motion/motion.h"
#include "scene/placement.h"
#include "support/random.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::scene {
namespace {

MotionTrack track(Moved moved, std::size_t width, std::vector<double> times,
                  std::vector<double> values, bool quaternions = false) {
    TrackKeys keys;
    keys.width = width;
    keys.quaternions = quaternions;
    keys.times = std::move(times);
    keys.values = std::move(values);
    return {moved, 0, *Track::create(std::move(keys))};
}

Motion motion_of(MotionTrack track) {
    Motion motion;
    motion.duration = track.track.end();
    motion.tracks.push_back(std::move(track));
    return motion;
}

// Two seconds, once around.
Motion turntable() {
    Motion motion = motion_of(track(Moved::rotate, 3, {0, 2}, {0, 0, 0, 0, 360, 0}));
    motion.loops = true;
    return motion;
}

struct Staged {
    ModelTransform model;
    CameraOptions camera;
};
Staged at(const Motion& motion, double seconds, Staged scene = {}) {
    motion.move(seconds, scene.model, scene.camera);
    return scene;
}

geom::Mesh cloud(std::uint64_t seed) {
    test::Random random(seed);
    geom::Mesh mesh;
    for (int i = 0; i < 100; ++i)
        mesh.position.push_back(Vec3(random.in_cube(0.5)) * Vec3(1, 0.4F, 0.2F));
    mesh.radius = 0.6F;
    return mesh;
}

TEST(Motion, ActsOnWhatTheOptionsMadeOfTheModel) {
    Staged options;
    options.model.scale = {2, 2, 1};
    options.model.translate = {1, 0, 0};
    options.model.rotate_degrees = {90, 0, 0};
    options.camera.shift = {0.5, 0};
    const auto after = [&](Moved moved, std::size_t width, const std::vector<double>& value) {
        return at(motion_of(track(moved, width, {0}, value)), 0, options);
    };
    EXPECT_EQ(after(Moved::scale, 3, {1, 3, 1}).model.scale, DVec3(2, 6, 1));
    const ModelTransform moved = after(Moved::translate, 3, {1, 3, 0}).model;
    EXPECT_EQ(placement_of(moved, {}, UpAxis::plus_y).offset, DVec3(2, 3, 0));
    EXPECT_EQ(after(Moved::shift, 2, {1, 2}).camera.shift, DVec2(1.5, 2));
    // Turned up by the option, then about the world's y by the track: the file's y ends at x.
    const ModelTransform model = after(Moved::rotate, 3, {0, 90, 0}).model;
    const auto world = [&](const ModelTransform& m, const DVec3& p) {
        const Placement placed = placement_of(m, {}, UpAxis::plus_y);
        return turned(DMat3(1), m) * placed.linear * p + placed.offset;
    };
    EXPECT_EQ(world(model, {0, 1, 0}), DVec3(3, 0, 0)) << "twice as long, from (1, 0, 0)";
    // Steps of the command line come before a motion, too.
    options.model.steps.push_back({scaling({3, 3, 3}), DVec3(0, 0, 1), {}});
    EXPECT_EQ(world(after(Moved::translate, 3, {1, 3, 0}).model, DVec3(0)), DVec3(4, 3, 1));
}

TEST(Motion, TakesThePlaceOfTheCamerasOptions) {
    const auto after = [&](Moved moved, const std::vector<double>& value) {
        return at(motion_of(track(moved, value.size(), {0}, value)), 0).camera;
    };
    EXPECT_EQ(after(Moved::azimuth, {-700}).azimuth_degrees, -700);
    EXPECT_EQ(after(Moved::elevation, {89}).elevation_degrees, 89);
    EXPECT_EQ(after(Moved::elevation, {95}).elevation_degrees, 90) << "a curve's way beyond it";
    EXPECT_EQ(after(Moved::distance, {4}).distance, 4);
    EXPECT_GT(after(Moved::distance, {-4}).distance, 0);
    EXPECT_EQ(after(Moved::fov, {60}).fov_degrees, 60);
    EXPECT_EQ(after(Moved::fov, {181}).fov_degrees, 175);
    EXPECT_EQ(after(Moved::eye, {1, 2, 3}).eye, DVec3(1, 2, 3));
    EXPECT_EQ(after(Moved::look_at, {1, 2, 3}).target, DVec3(1, 2, 3));
}

TEST(Motion, MovesEachLightByItsKind) {
    std::vector<Light> lights(2);
    lights[1].kind = LightKind::spot;
    Motion motion;
    for (const std::size_t light : {0U, 1U}) {
        motion.tracks.push_back(track(Moved::at, 3, {0}, {1, 2, 3}));
        motion.tracks.back().light = light;
    }
    for (auto& [moved, value] :
         std::vector<std::pair<Moved, std::vector<double>>>{{Moved::to, {4, 5, 6}},
                                                            {Moved::cone, {20, 10}},
                                                            {Moved::colour, {0.25, 2, -1}},
                                                            {Moved::power, {-1}},
                                                            {Moved::size, {0.5}}}) {
        motion.tracks.push_back(track(moved, value.size(), {0}, value));
        motion.tracks.back().light = 1;
    }
    EXPECT_TRUE(motion.has_lights());
    motion.move_lights(0, lights);
    EXPECT_EQ(lights[0].towards, DVec3(1, 2, 3));
    EXPECT_EQ(lights[0].position, DVec3(0));
    EXPECT_EQ(lights[1].position, DVec3(1, 2, 3));
    EXPECT_EQ(lights[1].target, DVec3(4, 5, 6));
    EXPECT_EQ(lights[1].inner_degrees, 20);
    EXPECT_EQ(lights[1].outer_degrees, 20) << "no narrower than the inner one";
    EXPECT_EQ(lights[1].colour, Vec3(0.25F, 1, 0));
    EXPECT_EQ(lights[1].power, 0);
    EXPECT_EQ(lights[1].size, 0.5);
}

TEST(Motion, IsOverOrBeginsAgain) {
    Motion motion = motion_of(track(Moved::azimuth, 1, {0, 2}, {0, 90}));
    EXPECT_EQ(at(motion, 3).camera.azimuth_degrees, 90);
    motion.loops = true;
    EXPECT_EQ(at(motion, 3).camera.azimuth_degrees, 45);
    motion.duration = 4; // the track rests for its last two seconds
    EXPECT_EQ(at(motion, 3).camera.azimuth_degrees, 90);
    EXPECT_EQ(at(motion, 5).camera.azimuth_degrees, 45);
}

// The same bits as a view of the model turned by hand.
TEST(Motion, OnceAroundIsTheTurntable) {
    const geom::Mesh mesh = cloud(71);
    const Motion motion = turntable();
    Staged rest;
    rest.model.rotate_degrees = {10, 20, 30};
    rest.model.scale = {1, 0.5, 2};
    rest.camera.elevation_degrees = 20;
    rest.camera.azimuth_degrees = 30;
    const CameraOptions camera = fitted(mesh, rest.model, rest.camera, 1.5, 16);
    const CameraOptions own = fitted(mesh, rest.model, rest.camera, 1.5, motion);
    EXPECT_EQ(camera.distance, own.distance);
    EXPECT_EQ(camera.shift, own.shift);
    for (int i = 0; i < 48; ++i) {
        Pose pose;
        pose.yaw = wrap_angle(std::int64_t{kFullTurn} * i / 48);
        const Staged now = at(motion, 2.0 * i / 48, {rest.model, own});
        const auto turned = make_view(mesh, rest.model, pose, camera, {}, 600, 400);
        const auto moved = make_view(mesh, now.model, {}, now.camera, {}, 600, 400);
        EXPECT_EQ(turned->linear, moved->linear) << i;
        EXPECT_EQ(turned->normal, moved->normal) << i;
        EXPECT_EQ(turned->translation, moved->translation) << i;
        EXPECT_EQ(turned->near_distance, moved->near_distance) << i;
    }
}

TEST(Motion, AQuaternionTurnsAsDegreesDo) {
    const DVec3 about(20, -50, 130);
    const DVec4 q = quaternion_of_degrees(about);
    const Motion degrees = motion_of(track(Moved::rotate, 3, {0}, {about.x, about.y, about.z}));
    const Motion turn = motion_of(track(Moved::turn, 4, {0}, {q.x, q.y, q.z, q.w}, true));
    const DMat3 a = *at(degrees, 0).model.turn, b = *at(turn, 0).model.turn;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            EXPECT_NEAR(a[column][row], b[column][row], 1e-15);
}

// The camera that the motion leaves at rest is made to fit; one that it places is not.
TEST(Motion, AFitIsOfTheWholeMotionAndOnlyWhereNothingSaysTheDistance) {
    const geom::Mesh mesh = cloud(72);
    const CameraOptions still = fitted(mesh, {}, {}, 1.5);
    EXPECT_GT(fitted(mesh, {}, {}, 0.5, turntable()).distance, 0);
    EXPECT_NE(fitted(mesh, {}, {}, 1.5, turntable()).distance, still.distance);
    const Motion walk = motion_of(track(Moved::distance, 1, {0, 1}, {3, 4}));
    EXPECT_EQ(fitted(mesh, {}, {}, 1.5, walk).distance, 0);
    EXPECT_EQ(at(walk, 1, {{}, fitted(mesh, {}, {}, 1.5, walk)}).camera.distance, 4);
    const Motion zoom = motion_of(track(Moved::fov, 1, {0, 1}, {30, 20}));
    CameraOptions narrow;
    narrow.fov_degrees = 30;
    EXPECT_EQ(fitted(mesh, {}, {}, 1.5, zoom).distance, fitted(mesh, {}, narrow, 1.5).distance)
        << "as it begins";
    EXPECT_EQ(fitted(mesh, {}, {}, 1.5, zoom).fov_degrees, 45);
}

} // namespace
} // namespace scanout::scene
