// What is told from the model's bounding sphere, against its vertices one by one.
#include "frame/view/bounding_sphere.h"
#include "support/random.h"
#include "support/scenes.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace scanout::frame {
namespace {

// A ball that fills its bounding sphere; its vertices lie less than eight degrees apart.
const geom::Mesh& ball() {
    static const geom::Mesh mesh = [] {
        geom::Mesh made = test::empty_mesh();
        made.centre = {3, -2, 7};
        made.exponent = 3;
        test::add_sphere(made, Vec3(0), 1, 64, 32);
        return made;
    }();
    return mesh;
}

// A view of the ball from somewhere about it, moved aside; it may not be possible.
Result<scene::View> any_view(test::Random& random) {
    scene::CameraOptions camera;
    camera.projection =
        random.whole(0, 3) == 0 ? scene::Projection::orthographic : scene::Projection::perspective;
    camera.azimuth_degrees = random.in(0, 360);
    camera.elevation_degrees = random.in(-80, 80);
    auto view = scene::make_view(ball(), {}, {}, camera, {}, 160, 90);
    if (view) view->translation += random.in_cube(6);
    return view;
}

// The vertices, the ball so many times as large.
template <class Holds>
bool any_vertex(const scene::View& view, double larger, const Holds& holds) {
    for (const Vec3& p : ball().position)
        if (holds(view.linear * (DVec3(p) * larger) + view.translation)) return true;
    return false;
}

TEST(BoundingSphere, NothingThatAPictureShowsIsOutOfView) {
    test::Random random(5);
    int seen = 0, unseen = 0;
    for (int round = 0; round < 3000; ++round) {
        const auto view = any_view(random);
        if (!view) continue;
        const bool parallel = view->projection == scene::Projection::orthographic;
        const auto shown = [&](const DVec3& at) {
            const double far = parallel ? 1 : -at.z;
            return (parallel || far > view->near_distance) &&
                   std::abs(at.x) <= view->half_width * far &&
                   std::abs(at.y) <= view->half_height * far;
        };
        if (any_vertex(*view, 1, shown)) {
            ++seen;
            EXPECT_TRUE(may_be_visible(*view)) << round;
        } else if (!may_be_visible(*view)) {
            ++unseen;
        }
    }
    EXPECT_GT(seen, 500);
    EXPECT_GT(unseen, 500);
    EXPECT_TRUE(may_be_visible(scene::View()));
}

TEST(BoundingSphere, NothingThatASpotShinesOnIsBesideItsCone) {
    test::Random random(6);
    int lit = 0, beside = 0, missed = 0;
    for (int round = 0; round < 3000; ++round) {
        const auto view = any_view(random);
        if (!view) continue;
        scene::Light light;
        light.kind = scene::LightKind::spot;
        light.position = ball().centre + random.in_cube(40); // the ball's radius is 8
        light.target = ball().centre + random.in_cube(40);
        light.outer_degrees = random.in(10, 180);
        light.inner_degrees = 0;
        const scene::ViewLight seen = in_view(light, *view, ball());
        const DVec3 from = DVec3(seen.position) / to_floats(*view), axis(seen.axis);
        const auto within = [&](const DVec3& at) {
            const DVec3 way = at - from;
            const double angle =
                std::atan2(glm::length(glm::cross(axis, way)), glm::dot(axis, way));
            return angle * 180 / std::numbers::pi < light.outer_degrees;
        };
        const bool may = may_be_lit(seen, *view);
        if (any_vertex(*view, 1, within)) {
            ++lit;
            EXPECT_TRUE(may) << round;
        } else {
            ++beside;
            missed += may && !any_vertex(*view, 1.2, within) ? 1 : 0;
        }
    }
    EXPECT_GT(lit, 500);
    EXPECT_GT(beside, 500);
    EXPECT_LT(missed, beside / 20) << "it is no wider than it has to be";
    scene::ViewLight point;
    point.kind = scene::LightKind::point;
    EXPECT_TRUE(may_be_lit(point, scene::View()));
}

} // namespace
} // namespace scanout::frame
