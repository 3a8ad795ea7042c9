// The reference's ambient occlusion against closed forms.
#include "oracle/obscurance.h"
#include "support/meshes.h"
#include "trace/render.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scanout::trace {
namespace {

constexpr int kPixels = 24;
constexpr double kReach = 0.6, kPower = 0.9;

// A floor that faces the eye, seen straight on from -1 to 1; what stands on it is seen edge on.
scene::Scene floor_alone() {
    scene::Scene s;
    s.mesh = test::empty_mesh();
    s.materials = {{}};
    s.materials[0].diffuse = Vec3(0.8F);
    test::add_square(s.mesh, 4, 0, 0);
    return s;
}

// From a to b, up to 20.
void add_tall_wall(scene::Scene& s, const DVec2& a, const DVec2& b) {
    const auto at = [](const DVec2& p, double z) { return Vec3(DVec3(p.x, p.y, z)); };
    test::add_quad(s.mesh, {at(a, 0), at(b, 0), at(b, 20), at(a, 20)}, {1, 0, 0}, 0);
}

// half: of the picture's side.
Reference traced_floor(const scene::Scene& s, double radius, int pixels = kPixels,
                       double half = 1) {
    scene::View view;
    view.projection = scene::Projection::orthographic;
    view.half_width = view.half_height = half;
    Look l;
    l.width = l.height = pixels;
    l.occlusion_radius = radius;
    scene::Light ambient;
    ambient.kind = scene::LightKind::ambient;
    ambient.power = kPower;
    l.lights = {ambient};
    Jobs jobs(2);
    auto made = render(s, view, l, jobs);
    EXPECT_TRUE(made) << (made ? "" : made.error().what);
    return made ? std::move(*made) : Reference();
}

double code_of_light(double light) {
    return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

// Compares with the mean over each pixel of open(x, y).
template <class Open>
void expect_open(const Reference& r, int first, int end, Open open) {
    for (int py = first; py < end; ++py)
        for (int px = first; px < end; ++px) {
            constexpr int kFine = 8;
            double sum = 0;
            for (int i = 0; i < kFine * kFine; ++i)
                sum += open(2 * (px + (i % kFine + 0.5) / kFine) / kPixels - 1,
                            1 - 2 * (py + (i / kFine + 0.5) / kFine) / kPixels);
            const double expected = code_of_light(0.8 * kPower * sum / (kFine * kFine));
            const auto i = static_cast<std::size_t>(py * kPixels + px);
            EXPECT_NEAR(code_of_light(double{r.light[i].x}), expected, 0.5) << px << ' ' << py;
        }
}

TEST(ReferenceOcclusion, BesideAWallIsTheClosedForm) {
    scene::Scene s = floor_alone();
    add_tall_wall(s, {-1.1, -30}, {-1.1, 30});
    expect_open(traced_floor(s, kReach), 0, kPixels,
                [](double x, double) { return oracle::open_beside_wall((x + 1.1) / kReach); });
    expect_open(traced_floor(s, 0), 0, kPixels, [](double, double) { return 1.0; });
}

TEST(ReferenceOcclusion, InTheMiddleOfARoomIsTheClosedForm) {
    for (const double away : {0.15, 0.3, 0.5}) {
        scene::Scene square = floor_alone(), round = floor_alone();
        for (int i = 0; i < 4; ++i) {
            const DVec2 corners[] = {{away, away}, {-away, away}, {-away, -away}, {away, -away}};
            add_tall_wall(square, corners[i], corners[(i + 1) % 4]);
        }
        constexpr int kWalls = 256;
        const auto on_circle = [&](int i) {
            const double angle = i * std::asin(1.0) * 4 / kWalls;
            return DVec2(std::cos(angle), std::sin(angle)) * away;
        };
        for (int i = 0; i < kWalls; ++i)
            add_tall_wall(round, on_circle(i), on_circle(i + 1));
        for (const auto& [scene, open] :
             {std::pair{&square, oracle::open_in_square_shaft(away / kReach)},
              {&round, oracle::open_in_round_shaft(away / kReach)}}) {
            const Reference r = traced_floor(*scene, kReach, 4, 0.002);
            for (const Vec3& light : r.light)
                EXPECT_NEAR(code_of_light(double{light.x}), code_of_light(0.8 * kPower * open), 0.5)
                    << away;
        }
    }
}

// A convex body hides nothing from itself, at any place: light is whole, without noise.
TEST(ReferenceOcclusion, OfAConvexBodyIsNone) {
    scene::Scene s;
    s.mesh = test::empty_mesh();
    s.materials = {{}};
    s.materials[0].diffuse = Vec3(0.8F);
    test::add_sphere(s.mesh, Vec3(0), 0.9F, 24, 12, 0);
    EXPECT_EQ(traced_floor(s, kReach).image, traced_floor(s, 0).image);
}

TEST(ReferenceOcclusion, BlendedSurfacesHideNothing) {
    scene::Scene s = floor_alone();
    s.materials.push_back(s.materials[0]);
    s.materials[1].opacity = 0.5F;
    const std::size_t before = s.mesh.material.size();
    add_tall_wall(s, {-1.1, -30}, {-1.1, 30});
    for (std::size_t t = before; t < s.mesh.material.size(); ++t)
        s.mesh.material[t] = 1;
    scene::View view;
    view.projection = scene::Projection::orthographic;
    Look l;
    l.width = l.height = kPixels;
    l.occlusion_radius = kReach;
    l.alpha = {Alpha::opaque, Alpha::opaque, Alpha::blended};
    scene::Light ambient;
    ambient.kind = scene::LightKind::ambient;
    ambient.power = kPower;
    l.lights = {ambient};
    Jobs jobs(2);
    const auto made = render(s, view, l, jobs);
    ASSERT_TRUE(made);
    expect_open(*made, 0, kPixels, [](double, double) { return 1.0; });
}

} // namespace
} // namespace scanout::trace
