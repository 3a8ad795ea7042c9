// The reference against answers that need no renderer, and against a plain ray caster without any
// hierarchy.
#include "image/hash.h"
#include "oracle/rays.h"
#include "support/meshes.h"
#include "trace/render.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scanout::trace {
namespace {

// Orthographic, so that view space is mesh space, from -1 to 1.
scene::View straight_on() {
    scene::View view;
    view.projection = scene::Projection::orthographic;
    return view;
}

Look look(int size) {
    Look l;
    l.width = l.height = size;
    return l;
}

scene::Light light_from(const DVec3& towards, double power = 1) {
    scene::Light light;
    light.frame = scene::LightFrame::camera;
    light.towards = towards;
    light.power = power;
    return light;
}

scene::Light ambient(double power) {
    scene::Light light;
    light.kind = scene::LightKind::ambient;
    light.power = power;
    return light;
}

Reference traced(const scene::Scene& scene, const scene::View& view, const Look& l,
                 int threads = 2) {
    Jobs jobs(threads);
    auto made = render(scene, view, l, jobs);
    EXPECT_TRUE(made) << (made ? "" : made.error().what);
    return made ? std::move(*made) : Reference();
}

double srgb_code(double light) {
    const double x = std::min(std::max(light, 0.0), 1.0);
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

// Half a code of rounding, and what the reference allows itself.
void expect_code(const Reference& r, int x, int y, double light) {
    EXPECT_NEAR(r.image.at(x, y).r, srgb_code(light), 0.5 + 0.5) << x << " " << y;
    EXPECT_NEAR(srgb_code(double{r.light[static_cast<std::size_t>(y * r.image.width() + x)].x}),
                srgb_code(light), 0.5)
        << x << " " << y;
}

// The mean over a pixel of f(x, y), x right and y up from -1 to 1.
template <class F>
double mean_over(int px, int py, int size, F f) {
    constexpr int kSide = 32;
    double sum = 0;
    for (int i = 0; i < kSide * kSide; ++i) {
        const double x = px + (i % kSide + 0.5) / kSide, y = py + (i / kSide + 0.5) / kSide;
        sum += f(2 * x / size - 1, 1 - 2 * y / size);
    }
    return sum / (kSide * kSide);
}

TEST(Reference, OfALitSphereIsTheFormula) {
    scene::Scene s;
    s.mesh = test::empty_mesh();
    s.materials = {{}};
    s.materials[0].diffuse = Vec3(0.5F);
    s.materials[0].specular = Vec3(0.4F);
    s.materials[0].shininess = 20;
    test::add_sphere(s.mesh, Vec3(0), 0.9F, 512, 256, 0);
    const DVec3 towards = DVec3(1, 2, 2) / 3.0;
    Look l = look(32);
    l.lights = {light_from(towards, 0.8), ambient(0.1)};
    const Reference r = traced(s, straight_on(), l);
    int compared = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const double px = (x + 0.5) / 16 - 1, py = 1 - (y + 0.5) / 16;
            if (std::hypot(px, py) > 0.78) continue; // the facets' rim is another place
            expect_code(r, x, y, mean_over(x, y, 32, [&](double a, double b) {
                            const double c = std::sqrt(0.81 - a * a - b * b);
                            const DVec3 n = DVec3(a, b, c) / 0.9;
                            const double falls = std::max(dot3(n, towards), 0.0);
                            const DVec3 h = towards + DVec3(0, 0, 1);
                            const double lobe =
                                std::pow(std::max(dot3(n, h) / std::sqrt(dot3(h, h)), 0.0), 20);
                            return 0.5 * (0.1 + 0.8 * falls) + 0.8 * 0.4 * lobe;
                        }));
            ++compared;
        }
    EXPECT_GT(compared, 400);
}

TEST(Reference, OfASmoothCoarseSphereLosesNoLightToItsOwnFaces) {
    scene::Scene s;
    s.mesh = test::empty_mesh();
    s.materials = {{}};
    s.materials[0].diffuse = Vec3(0.5F);
    s.materials[0].specular = Vec3(0.4F);
    s.materials[0].shininess = 20;
    test::add_sphere(s.mesh, Vec3(0), 0.9F, 12, 6, 0);
    for (const DVec3& towards : {DVec3(1, 0.2, -0.3), DVec3(-1, 1, 0.1), DVec3(0.1, -1, -0.2)}) {
        Look l = look(32);
        l.lights = {light_from(towards)};
        const Reference without = traced(s, straight_on(), l);
        l.shadows = true;
        EXPECT_EQ(traced(s, straight_on(), l).image, without.image) << towards.x;
    }
}

TEST(Reference, OfASphereUnderASkyIsTheFormula) {
    scene::Scene s;
    s.mesh = test::empty_mesh();
    s.materials = {{}};
    s.materials[0].diffuse = Vec3(0.5F);
    test::add_sphere(s.mesh, Vec3(0), 0.9F, 512, 256, 0);
    scene::Light sky;
    sky.kind = scene::LightKind::hemisphere;
    sky.frame = scene::LightFrame::camera;
    sky.towards = {1, 2, 2};
    sky.ground = Vec3(0.125F);
    Look l = look(32);
    l.lights = {sky};
    const Reference r = traced(s, straight_on(), l);
    int compared = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const double px = (x + 0.5) / 16 - 1, py = 1 - (y + 0.5) / 16;
            if (std::hypot(px, py) > 0.78) continue; // the facets' rim is another place
            expect_code(r, x, y, mean_over(x, y, 32, [&](double a, double b) {
                            const double c = std::sqrt(0.81 - a * a - b * b);
                            const double seen = (1 + (a + 2 * b + 2 * c) / 2.7) / 2;
                            return 0.5 * (seen + 0.125 * (1 - seen));
                        }));
            ++compared;
        }
    EXPECT_GT(compared, 400);
}

TEST(Reference, OfATexturedPlaneIsTheMeanOfWhatThePixelShows) {
    scene::Scene s;
    s.mesh = test::empty_mesh();
    s.materials = {{}};
    s.materials[0].diffuse = Vec3(1);
    s.materials[0].map_diffuse.edit().texture = 0;
    s.materials[0].map_diffuse.edit().path = "m.png";
    s.textures.resize(1);
    image::Image& texels = s.textures[0].image = image::Image(8, 8);
    test::Random random(3);
    for (image::Rgba8& texel : texels.pixels())
        texel.r = texel.g = texel.b = static_cast<std::uint8_t>(random.whole(0, 255));
    test::add_square(s.mesh, 1, 0, 0);
    Look l = look(11);
    l.maps.diffuse = true;
    l.lights = {ambient(1)};
    const Reference r = traced(s, straight_on(), l);
    const auto light_at = [&](int x, int y) { // repeated
        const double code = texels.at((x + 8) % 8, 7 - (y + 8) % 8).r / 255.0;
        return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
    };
    for (int y = 0; y < 11; ++y)
        for (int x = 0; x < 11; ++x)
            expect_code(
                r, x, y, mean_over(x, y, 11, [&](double a, double b) {
                    const double u = (a + 1) * 4 - 0.5, v = (b + 1) * 4 - 0.5;
                    const int i = static_cast<int>(std::floor(u)),
                              k = static_cast<int>(std::floor(v));
                    const double fu = u - i, fv = v - k;
                    return (light_at(i, k) * (1 - fu) + light_at(i + 1, k) * fu) * (1 - fv) +
                           (light_at(i, k + 1) * (1 - fu) + light_at(i + 1, k + 1) * fu) * fv;
                }));
}

// A half plane between a wall and a square light: the wall sees a share of it that grows evenly.
TEST(Reference, OfTheShadowUnderASquareLightIsItsPenumbra) {
    scene::Scene s;
    s.mesh = test::empty_mesh();
    s.materials = {{}};
    s.materials[0].diffuse = Vec3(1);
    test::add_square(s.mesh, 1, 0, 0);
    // From x = 0 to the left, at half the light's height: beyond the camera's picture.
    test::add_quad(s.mesh, {{{-9, -9, 2}, {0, -9, 2}, {0, 9, 2}, {-9, 9, 2}}}, {0, 0, 1}, 0);
    scene::View view = straight_on();
    view.half_height = 0.125; // the picture's middle rows
    Look l = look(64);
    l.height = 8;
    l.left = Left::none;
    scene::Light light;
    light.kind = scene::LightKind::point;
    light.frame = scene::LightFrame::camera;
    light.position = {0, 0, 4};
    light.size = 0.5;
    light.shape = scene::LightShape::square;
    l.lights = {light};
    l.shadows = true;
    // The half plane is not seen, but casts.
    s.materials.push_back(s.materials[0]);
    s.mesh.material[2] = s.mesh.material[3] = 1;
    l.alpha = {Alpha::opaque, Alpha::opaque, Alpha::nothing};
    const Reference r = traced(s, view, l);
    int half_lit = 0;
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 64; ++x) {
            const double light_share = mean_over(x, y, 64, [&](double a, double b) {
                const double square = a * a + (b - 0.875) * (b - 0.875) + 16;
                const double arrives = 16 / square * (4 / std::sqrt(square)); // and Lambert
                // The point of the light at x sees `a` by the plane's point (a + x) / 2.
                return arrives * std::min(std::max((0.5 + a) / 1.0, 0.0), 1.0);
            });
            expect_code(r, x, y, light_share);
            half_lit += light_share > 0.1 && light_share < 0.8 ? 1 : 0;
        }
    EXPECT_GT(half_lit, 80);
}

TEST(Reference, OfTwoGlassesIsWhatEachLetsThrough) {
    scene::Scene s;
    s.mesh = test::empty_mesh();
    s.materials.resize(2);
    s.materials[0].diffuse = Vec3(0.9F);
    s.materials[0].opacity = 0.25F;
    s.materials[1].diffuse = Vec3(0.2F);
    s.materials[1].opacity = 0.5F;
    test::add_square(s.mesh, 2, -0.5F, 1); // behind, first in the file
    test::add_square(s.mesh, 2, 0.5F, 0);
    Look l = look(4);
    l.background = {255, 255, 255, 255};
    l.lights = {ambient(1)};
    l.alpha = {Alpha::opaque, Alpha::blended, Alpha::blended};
    const double expected = 0.25 * double{0.9F} + 0.75 * (0.5 * double{0.2F} + 0.5);
    const Reference r = traced(s, straight_on(), l);
    for (int i = 0; i < 16; ++i)
        expect_code(r, i % 4, i / 4, expected);
    l.background.a = 0;
    EXPECT_EQ(traced(s, straight_on(), l).image.at(1, 1).a,
              static_cast<int>(255 * (1 - 0.75 * 0.5)));
}

// All that there is to it, once more: every ray against every triangle, an even grid of samples,
// Lambert's law, hard shadows.
class PlainCaster {
public:
    PlainCaster(const scene::Scene& scene, const scene::View& view, const DVec3& towards)
        : scene_(scene), view_(view), towards_(towards) {
        for (std::size_t i = 0; i < scene.mesh.triangles(); ++i) {
            std::array<DVec3, 3> corner;
            for (std::size_t k = 0; k < 3; ++k)
                corner[k] = view.linear * DVec3(scene.mesh.position[scene.mesh.index[3 * i + k]]) +
                            view.translation;
            triangles_.corner.push_back(corner);
        }
    }
    // Linear light of a pixel, of samples x samples.
    double pixel(int x, int y, int size, int samples) const {
        double sum = 0;
        for (int i = 0; i < samples * samples; ++i)
            sum += at(x + (i % samples + 0.5) / samples, y + (i / samples + 0.5) / samples, size);
        return sum / (samples * samples);
    }

    // Something changes in the pixel, or close to it.
    bool edge_near(int x, int y, int size) const {
        double low = 1, high = 0;
        for (int v = y - 1; v <= y + 1; ++v)
            for (int u = x - 1; u <= x + 1; ++u)
                for (int i = 0; i < 9; ++i) {
                    const double light = at(u + (i % 3 + 0.5) / 3, v + (i / 3 + 0.5) / 3, size);
                    low = std::min(low, light);
                    high = std::max(high, light);
                }
        return high - low > 1e-9;
    }

private:
    double at(double x, double y, int size) const {
        return sample(
            {DVec3(0),
             {(2 * x / size - 1) * view_.half_width, (1 - 2 * y / size) * view_.half_height, -1}});
    }
    double sample(const oracle::Ray& ray) const {
        const auto hit = triangles_.first(ray, 1e-6);
        if (!hit.any()) return 0;
        DVec3 normal = triangles_.normal(hit.triangle);
        if (dot3(normal, ray.way) > 0) normal = -normal;
        const double falls = dot3(normal, towards_);
        const double kd =
            double{scene_.materials[static_cast<std::size_t>(scene_.mesh.material[hit.triangle])]
                       .diffuse.x};
        const bool dark = falls <= 0 || triangles_.blocks({ray.from + ray.way * hit.t, towards_},
                                                          1e-9, 1e9, hit.triangle);
        return kd * (0.2 + (dark ? 0 : 0.8 * falls));
    }
    const scene::Scene& scene_;
    const scene::View& view_;
    DVec3 towards_;
    oracle::Triangles triangles_;
};

TEST(Reference, AgreesWithAPlainRayCaster) {
    test::Random random(21);
    scene::Scene s;
    s.mesh = test::empty_mesh();
    s.materials.resize(2);
    s.materials[0].diffuse = Vec3(0.8F);
    s.materials[1].diffuse = Vec3(0.3F);
    for (int i = 0; i < 40; ++i) {
        const DVec3 middle = random.in_cube(0.6);
        std::array<Vec3, 3> corner;
        for (Vec3& c : corner)
            c = Vec3(middle + random.in_cube(0.5));
        const Vec3 normal = glm::normalize(cross3(corner[1] - corner[0], corner[2] - corner[0]));
        const std::uint32_t first = test::add_vertex(s.mesh, corner[0], normal);
        test::add_vertex(s.mesh, corner[1], normal);
        test::add_vertex(s.mesh, corner[2], normal);
        test::add_triangle(s.mesh, first, first + 1, first + 2, i % 2);
    }
    scene::View view;
    view.translation = {0, 0, -3};
    view.half_width = view.half_height = 0.4;
    view.near_distance = 0.01;
    const DVec3 towards = DVec3(2, 6, 9) / 11.0;
    Look l = look(40);
    l.lights = {light_from(towards, 0.8), ambient(0.2)};
    l.shadows = true;
    const Reference r = traced(s, view, l);
    const PlainCaster plain(s, view, towards);
    double square = 0;
    int edges = 0, covered = 0;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 40; ++x) {
            const std::size_t i = static_cast<std::size_t>(y * 40 + x);
            const double expected = srgb_code(plain.pixel(x, y, 40, 12)),
                         found = srgb_code(double{r.light[i].x});
            covered += expected > 0 ? 1 : 0;
            // Its even grid is off at edges: by a twelfth of what differs there, and more where the
            // grid and an edge run alike.
            const bool edge = plain.edge_near(x, y, 40);
            edges += edge ? 1 : 0;
            EXPECT_NEAR(found, expected, edge ? 255 / 12.0 : 0.5) << x << " " << y;
            square += edge ? (found - expected) * (found - expected) : 0;
        }
    EXPECT_GT(covered, 400);
    EXPECT_GT(1600 - edges, 200);
    EXPECT_LT(std::sqrt(square / edges), 2.5);
}

// A lamp stands so low over the upper face of a block that half of it lies below the face's plane.
// Lambert's law of its middle has counted that: no shadow comes on top.
TEST(Reference, CountsTheLightBelowAPlaneOnce) {
    scene::Scene s;
    s.mesh = test::empty_mesh();
    s.materials = {{}};
    test::add_cube(s.mesh, 0.5F);
    scene::View view;
    view.linear = DMat3(1, 0, 0, 0, 0, 1, 0, -1, 0); // from above
    view.translation = {0, 0, -3};
    view.half_width = view.half_height = 0.15;
    view.near_distance = 0.01;
    Look l = look(16);
    scene::Light lamp;
    lamp.kind = scene::LightKind::point;
    lamp.frame = scene::LightFrame::camera;
    lamp.position = {1.5, 0, -2.4}; // 0.1 above the face
    lamp.size = 0.6;
    l.lights = {lamp};
    const Reference open = traced(s, view, l);
    l.shadows = true;
    const Reference shadowed = traced(s, view, l);
    EXPECT_GT(open.light[16 * 8 + 8].x, 0.01F);
    for (std::size_t i = 0; i < open.light.size(); ++i)
        EXPECT_NEAR(shadowed.light[i].x, open.light[i].x, 1e-6) << i;
}

TEST(Reference, IsTheSameOnAnyNumberOfThreads) {
    scene::Scene s;
    s.mesh = test::empty_mesh();
    s.materials = {{}};
    test::add_sphere(s.mesh, Vec3(0), 0.8F, 24, 12, 0);
    Look l = look(12);
    scene::Light lamp;
    lamp.kind = scene::LightKind::point;
    lamp.frame = scene::LightFrame::camera;
    lamp.position = {2, 2, 2};
    lamp.size = 0.5;
    l.lights = {lamp, ambient(0.1)};
    l.shadows = true;
    const Reference once = traced(s, straight_on(), l, 1);
    EXPECT_EQ(image::frame_hash(once.image), 6096959900396690482U);
    for (const int threads : {2, 5}) {
        const Reference again = traced(s, straight_on(), l, threads);
        EXPECT_EQ(again.image, once.image);
        EXPECT_EQ(again.light, once.light);
        EXPECT_EQ(again.error, once.error);
        EXPECT_EQ(again.samples, once.samples);
    }
}

// Where nothing changes, 16 samples do; an edge gets many more. The error that is estimated is one
// that is there.
TEST(Reference, TakesAsManySamplesAsAPixelNeeds) {
    scene::Scene s;
    s.mesh = test::empty_mesh();
    s.materials = {{}};
    s.materials[0].diffuse = Vec3(1);
    Look l = look(16);
    l.lights = {ambient(1)};
    EXPECT_EQ(traced(s, straight_on(), l).samples, 16U * 256);
    test::add_quad(s.mesh, {{{-3, -3, 0}, {0.13F, -3, 0}, {0.31F, 3, 0}, {-3, 3, 0}}}, {0, 0, 1},
                   0);
    const Reference r = traced(s, straight_on(), l);
    EXPECT_GT(r.samples, 16U * 256 + 16 * 500);
    EXPECT_LT(r.samples, 16U * 256 + 64 * 4096);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) {
            const double expected = mean_over(
                x, y, 16, [&](double a, double b) { return a < 0.22 + 0.03 * b ? 1.0 : 0.0; });
            const auto i = static_cast<std::size_t>(y * 16 + x);
            EXPECT_NEAR(double{r.light[i].x}, expected, 0.01) << x << " " << y;
        }
    EXPECT_LT(r.noise, 0.25);
}

// Less effort: fewer samples where they are many, more noise, which is said.
TEST(Reference, SpendsNoMoreThanItIsAllowed) {
    scene::Scene s;
    s.mesh = test::empty_mesh();
    s.materials = {{}};
    s.materials[0].diffuse = Vec3(1);
    test::add_quad(s.mesh, {{{-3, -3, 0}, {0.13F, -3, 0}, {0.31F, 3, 0}, {-3, 3, 0}}}, {0, 0, 1},
                   0);
    Look l = look(16);
    l.lights = {ambient(1)};
    Jobs jobs(2);
    const auto with = [&](std::uint32_t most) {
        return *render(s, straight_on(), l, jobs, {}, {most});
    };
    const Reference all = traced(s, straight_on(), l), same = with(kMostSamples), some = with(64),
                    least = with(16);
    EXPECT_EQ(image::frame_hash(all.image), image::frame_hash(same.image));
    EXPECT_EQ(all.samples, same.samples);
    EXPECT_EQ(least.samples, 16U * 256);
    EXPECT_LE(some.samples, 64U * 256);
    EXPECT_GT(some.samples, least.samples);
    EXPECT_GT(some.noise, 2 * all.noise);
    EXPECT_GT(least.noise, some.noise);
}

TEST(Reference, SaysWhatItDoesNotKnow) {
    scene::Scene s;
    s.mesh = test::empty_mesh();
    Jobs jobs(1);
    Look l = look(4);
    l.tone = "sepia";
    EXPECT_EQ(render(s, straight_on(), l, jobs).error().exit, Exit::usage);
    l.tone = "clamp";
    l.reflection[0] = "velvet";
    EXPECT_EQ(render(s, straight_on(), l, jobs).error().exit, Exit::usage);
}

} // namespace
} // namespace scanout::trace
