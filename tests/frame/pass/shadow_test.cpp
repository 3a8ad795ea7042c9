// Laws of the shadows, against rays in double.
#include "frame/shadow_shares.h"
#include "image/compare.h"
#include "oracle/rays.h"
#include "support/axes.h"
#include "support/scenes.h"

#include <cmath>
#include <map>
#include <numbers>

namespace scanout::test {
namespace {

using scene::LightKind;

const Names& kShadowTechniques = names_on("shadow");

// What a ray through a pixel finds, and whether light reaches it there.
class Oracle {
public:
    explicit Oracle(const Shot& s) : width_(s.options.width), height_(s.options.height) {
        const auto view =
            scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, width_, height_);
        if (!view) throw std::runtime_error(view.error().what);
        view_ = *view;
        const geom::Mesh& mesh = s.scene.mesh;
        for (std::size_t i = 0; i < mesh.triangles(); ++i) {
            std::array<DVec3, 3> corner;
            for (std::size_t k = 0; k < 3; ++k) {
                corner[k] =
                    view_.linear * DVec3(mesh.position[mesh.index[i * 3 + k]]) + view_.translation;
                for (int c = 0; c < 3; ++c)
                    extent_ = std::max(extent_, std::abs((corner[k] - view_.translation)[c]));
            }
            triangles_.corner.push_back(corner);
            for (std::size_t k = 0; k < 3; ++k)
                normals_.push_back(view_.normal * DVec3(mesh.normal[mesh.index[i * 3 + k]]));
        }
        for (const scene::Light& light : s.options.lights) {
            if (light.kind == LightKind::ambient) continue;
            directional_ = light.kind == LightKind::directional;
            const DVec3 place =
                (light.position - mesh.centre) / std::ldexp(mesh.radius, mesh.exponent);
            light_ = view_.world_axes * (directional_ ? light.towards : place) +
                     (directional_ ? DVec3(0) : view_.world_origin);
        }
    }
    oracle::Ray ray(double x, double y) const {
        const DVec3 at((2 * x / width_ - 1) * view_.half_width,
                       (1 - 2 * y / height_) * view_.half_height, 0);
        if (view_.projection == scene::Projection::orthographic)
            return {at + DVec3(0, 0, 100), {0, 0, -1}};
        return {DVec3(0), {at.x, at.y, -1}};
    }
    struct Place {
        std::size_t triangle = SIZE_MAX;
        DVec3 at{0}, normal{0};
    };
    Place place(double x, double y) const {
        const oracle::Ray r = ray(x, y);
        const auto hit = triangles_.first(r, 1e-9);
        if (!hit.any()) return {};
        const DVec3 n = triangles_.normal(hit.triangle);
        return {hit.triangle, r.from + r.way * hit.t, dot3(n, r.way) > 0 ? -n : n};
    }
    DVec3 towards(const DVec3& at) const {
        const DVec3 way = directional_ ? light_ : light_ - at;
        return directional_ ? way / std::sqrt(dot3(way, way)) : way;
    }
    // > 0: the light is on the side that is seen; the sine of its height above the surface.
    double height(const Place& p) const {
        const DVec3 way = towards(p.at);
        return dot3(p.normal, way) / std::sqrt(dot3(way, way));
    }
    // The face turns away from the light, and its smooth normals do not: it is lit as a round one
    // (HARD-CASES 74).
    bool is_round(const Place& p) const {
        if (height(p) > 0) return false;
        DVec3 smooth(0);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto& corner = triangles_.corner[p.triangle];
            const DVec3 area = cross3(corner[(k + 1) % 3] - p.at, corner[(k + 2) % 3] - p.at);
            smooth = smooth + normals_[p.triangle * 3 + k] * std::sqrt(dot3(area, area));
        }
        return dot3(smooth, towards(p.at)) * dot3(smooth, p.normal) > 0;
    }
    // Shifted across the light's ray, along the surface.
    bool lit(const Place& p, const DVec3& across = DVec3(0)) const {
        const DVec3 way = towards(p.at);
        if (dot3(p.normal, way) <= 0) return false;
        const DVec3 at = p.at + across - way * (dot3(p.normal, across) / dot3(p.normal, way));
        return !triangles_.blocks({at, towards(at)}, 1e-7, directional_ ? 1e9 : 1, p.triangle);
    }
    // All that is `reach` away, in view units across the light, is lit as the place itself is.
    bool alike(const Place& p, double reach) const {
        DVec3 way = towards(p.at), right = cross3(way, DVec3(0.31, 0.53, 0.79));
        way = way / std::sqrt(dot3(way, way));
        right = right / std::sqrt(dot3(right, right));
        const DVec3 up = cross3(way, right);
        for (const double radius : {reach, reach / 2}) {
            for (int i = 0; i < 16; ++i) {
                const double angle = std::numbers::pi * i / 8;
                const DVec3 across =
                    right * (radius * std::cos(angle)) + up * (radius * std::sin(angle));
                if (lit(p, across) != lit(p)) return false;
            }
        }
        return true;
    }
    // Of a map of so many texels, across the place.
    double texel(const Place& p, int size) const {
        const DVec3 way = towards(p.at);
        const double spread =
            directional_ ? 2 * std::sqrt(3) * extent_ : 2 * 1.75 * std::sqrt(dot3(way, way));
        return spread / (directional_ ? size - 16 : size / 2.0 - 16);
    }

private:
    int width_, height_;
    scene::View view_;
    oracle::Triangles triangles_;
    std::vector<DVec3> normals_; // of their corners
    bool directional_ = false;
    DVec3 light_{0};
    double extent_ = 0;
};

struct Count {
    int compared = 0, edge = 0, wrong = 0, dark = 0;
};

// Compares every pixel that alike(oracle, place, x, y) calls far enough from an edge.
template <class Alike>
Count compare_with_rays(const Shot& s, const std::string& technique, double tolerance,
                        Alike alike) {
    const Oracle oracle(s);
    const std::vector<double> share = shares(s, technique);
    Count count;
    for (int y = 0; y < s.options.height; ++y) {
        for (int x = 0; x < s.options.width; ++x) {
            const double got = share[static_cast<std::size_t>(y * s.options.width + x)];
            const Oracle::Place p = oracle.place(x + 0.5, y + 0.5);
            if (got < 0 || p.triangle == SIZE_MAX || oracle.is_round(p)) continue;
            if (!alike(oracle, p, x + 0.5, y + 0.5)) {
                ++count.edge;
                continue;
            }
            ++count.compared;
            const bool lit = oracle.lit(p);
            count.dark += lit ? 0 : 1;
            if (std::abs(got - (lit ? 1 : 0)) > tolerance) {
                ++count.wrong;
                if (count.wrong < 4)
                    ADD_FAILURE() << s.name << ' ' << technique << " at " << x << ' ' << y << ": "
                                  << got << ", rays say " << lit << ", triangle " << p.triangle;
            }
        }
    }
    return count;
}

// On the screen, 1/64 pixel around: coverage is snapped to 1/256.
bool alike_on_screen(const Oracle& oracle, const Oracle::Place& p, double x, double y) {
    if (std::abs(oracle.height(p)) < 1e-4) return false;
    for (int i = 0; i < 8; ++i) {
        const double angle = std::numbers::pi * i / 4;
        const Oracle::Place q = oracle.place(x + std::cos(angle) / 64, y + std::sin(angle) / 64);
        if (q.triangle != p.triangle || oracle.lit(q) != oracle.lit(p)) return false;
    }
    return oracle.alike(p, 1e-4);
}

std::vector<Shot> rooms() {
    std::vector<Shot> shots;
    for (const auto kind : {LightKind::directional, LightKind::point, LightKind::spot}) {
        Shot s = stage(std::string(name_of(kind)), {lamp(kind)});
        s.options.width = s.options.height = 48;
        s.options.lights[0].outer_degrees = 55;
        for (scene::Material& m : s.scene.materials)
            m.specular = Vec3(0);
        shots.push_back(s);
        s.name += " orthographic";
        s.camera.projection = scene::Projection::orthographic;
        shots.push_back(s);
    }
    // A light among the things, which shines all ways.
    Shot inside = shots[2];
    inside.name = "lamp inside";
    inside.options.lights[0].position = {0.05, -0.3, 0.45};
    shots.push_back(inside);
    // The eye stands in the shadow of the ball, and the near plane cuts it.
    Shot shadow = shots[0];
    shadow.name = "eye in the shadow";
    shadow.camera.eye = DVec3(-0.59, -0.46, -0.12);
    shadow.camera.target = DVec3(0.6, -0.5, -0.6);
    shots.push_back(shadow);
    return shots;
}

// Closed: a ball above a thick slab.
Shot ball_on_slab() {
    Shot s = shot("closed", 48, 48);
    s.scene.materials = {plain({0.8F, 0.5F, 0.3F})};
    add_cube(s.scene.mesh, 0.6F, 0);
    for (Vec3& p : s.scene.mesh.position)
        p.y = p.y * 0.25F - 0.5F;
    add_sphere(s.scene.mesh, {0.1F, 0.2F, 0}, 0.3F, 16, 8, 0);
    s.scene.mesh.uv.clear();
    s.camera.elevation_degrees = 30;
    s.options.lights = {lamp(LightKind::directional)};
    return s;
}

TEST(Shadow, VolumesAreWhereRaysSayToTheLastPixel) {
    std::vector<Shot> shots = rooms();
    shots.push_back(ball_on_slab());
    shots.push_back(ball_on_slab());
    shots.back().name = "closed, lamp";
    shots.back().options.lights = {lamp(LightKind::point)};
    shots.push_back(shots.back());
    shots.back().name = "closed, lamp within";
    shots.back().options.lights[0].position = {0.12, 0.22, 0.03}; // all else is dark
    for (const Shot& s : shots) {
        const Count count = compare_with_rays(s, "volume", 0, alike_on_screen);
        EXPECT_EQ(count.wrong, 0) << s.name << " of " << count.compared;
        EXPECT_GT(count.dark, 30) << s.name;
        EXPECT_GT(count.compared, 8 * count.edge) << s.name;
    }
}

TEST(Shadow, MapsAreWhereRaysSayButForTheirTexels) {
    for (const Shot& room : rooms()) {
        Shot s = room;
        s.options.shadow_size = 1024;
        for (const auto& [technique, texels] :
             {std::pair{"map", 1.5}, std::pair{"map_pcf", 3.0}, std::pair{"map_soft", 3.0}}) {
            const auto away = [&, texels = texels](const Oracle& oracle, const Oracle::Place& p,
                                                   double, double) {
                return std::abs(oracle.height(p)) > 1e-3 &&
                       oracle.alike(p, texels * oracle.texel(p, 1024));
            };
            const Count count = compare_with_rays(s, technique, 0, away);
            EXPECT_EQ(count.wrong, 0) << s.name << ' ' << technique << " of " << count.compared;
            EXPECT_GT(count.dark, 30) << s.name;
            EXPECT_GT(count.compared, 2 * count.edge) << s.name << ' ' << technique;
        }
    }
}

TEST(Shadow, ProjectedOntoTheFloorIsWhereRaysSay) {
    for (const Shot& s : rooms()) {
        const auto on_floor = [&](const Oracle& oracle, const Oracle::Place& p, double x,
                                  double y) {
            return p.triangle < 2 && alike_on_screen(oracle, p, x, y);
        };
        const Count count = compare_with_rays(s, "projected", 0, on_floor);
        EXPECT_EQ(count.wrong, 0) << s.name << " of " << count.compared;
        EXPECT_GT(count.dark, 30) << s.name;
    }
}

// A sheet that leans, under a ball, in a room whose floor is larger: found only when it is asked
// for, in the file's coordinates.
TEST(Shadow, ProjectedOntoThePlaneThatIsAskedForIsWhereRaysSay) {
    Shot s = shot("leaning", 64, 64);
    s.scene.materials = {plain(Vec3(0.8F))};
    geom::Mesh& mesh = s.scene.mesh;
    mesh.centre = {5, 7, 9};
    mesh.exponent = 3;
    add_quad(mesh,
             {{{-0.6F, -0.4F, 0.5F}, {0.6F, -0.4F, 0.5F}, {0.6F, 0, -0.5F}, {-0.6F, 0, -0.5F}}},
             {0, 0.93F, 0.37F}, 0);
    add_quad(mesh, {{{-1, -0.7F, 1}, {1, -0.7F, 1}, {1, -0.7F, -1}, {-1, -0.7F, -1}}}, {0, 1, 0},
             0);
    add_sphere(mesh, {0.1F, 0.25F, 0.1F}, 0.2F, 16, 8, 0);
    mesh.uv.clear();
    s.camera.elevation_degrees = 40;
    for (const auto kind : {LightKind::directional, LightKind::point}) {
        s.options.lights = {lamp(kind)};
        // Above the ball, in the file's coordinates.
        s.options.lights[0].position = mesh.centre + DVec3(0.3, 1.6, 0.3) * 8.0;
        const auto in_plane = [&](const Oracle& oracle, const Oracle::Place& p, double x,
                                  double y) {
            return p.triangle < 2 && alike_on_screen(oracle, p, x, y);
        };
        // y = -1/5 - 2/5 z of the mesh.
        s.options.shadow_plane = {DVec3(0, 5, 2), 5 * 7 + 2 * 9 - 8.0};
        const Count count = compare_with_rays(s, "projected", 0, in_plane);
        EXPECT_EQ(count.wrong, 0) << name_of(kind) << " of " << count.compared;
        EXPECT_GT(count.dark, 30) << name_of(kind);
        // On its own the floor is the ground, and nothing else receives.
        s.options.shadow_plane.reset();
        shade::LinearPicture floor, none;
        frame::Visibility seen;
        s.options.shadow = "projected";
        draw(s, {.visibility = &seen, .linear = &floor});
        s.options.effects["shadow"] = false;
        draw(s, {.linear = &none});
        s.options.effects.clear();
        for (std::size_t i = 0; i < seen.id.size(); ++i)
            EXPECT_TRUE(seen.id[i] >= 2 || floor.pixel[i] == none.pixel[i]) << i;
    }
}

TEST(Shadow, NeverFallsOnThePlaneThatThrowsIt) {
    for (const int degrees : {0, 10, 30, 45, 60, 75, 80, 85, 88, 89}) {
        Shot s = shot("plane", 64, 64);
        s.scene.materials = {plain(Vec3(0.8F))};
        add_square(s.scene.mesh, 1, 0, 0);
        s.scene.mesh.uv.clear();
        s.camera.azimuth_degrees = 20;
        s.camera.elevation_degrees = 35;
        s.options.shadow_size = 128;
        scene::Light light = lamp(LightKind::directional);
        const double angle = degrees * std::numbers::pi / 180;
        light.towards = {std::sin(angle) * 0.6, std::sin(angle) * 0.8, std::cos(angle)};
        light.size = 3;
        for (const auto kind : {LightKind::directional, LightKind::point}) {
            light.kind = kind;
            light.position = light.towards * 2.5;
            s.options.lights = {light};
            for (const std::string& technique : kShadowTechniques) {
                if (technique == "attached") continue;
                for (const double share : shares(s, technique)) {
                    if (share >= 0) {
                        ASSERT_EQ(share, 1) << technique << ' ' << degrees << ' ' << name_of(kind);
                    }
                }
            }
        }
    }
}

TEST(Shadow, DoesNotGatherInAHollowEdgeThatTheLightLooksInto) {
    for (const int degrees : {25, 35, 45, 55, 65}) {
        Shot s = shot("hollow", 64, 64);
        s.scene.materials = {plain(Vec3(0.8F))};
        add_quad(s.scene.mesh, {{{0, 0, 1}, {1, 0, 1}, {1, 0, -1}, {0, 0, -1}}}, {0, 1, 0}, 0);
        add_quad(s.scene.mesh, {{{0, 0, 1}, {0, 1, 1}, {0, 1, -1}, {0, 0, -1}}}, {1, 0, 0}, 0);
        s.scene.mesh.uv.clear();
        s.camera.azimuth_degrees = 60;
        s.camera.elevation_degrees = 40;
        s.options.shadow_size = 128;
        scene::Light light = lamp(LightKind::directional);
        const double angle = degrees * std::numbers::pi / 180;
        light.towards = {std::cos(angle), std::sin(angle), 0.1};
        for (const double size : {0.0, 2.0}) {
            light.size = size;
            s.options.lights = {light};
            for (const std::string& technique : kShadowTechniques) {
                int lit = 0;
                for (const double share : shares(s, technique)) {
                    lit += share == 1 ? 1 : 0;
                    EXPECT_TRUE(share < 0 || share == 1)
                        << technique << ' ' << degrees << ' ' << size << ' ' << share;
                }
                EXPECT_GT(lit, 800) << technique;
            }
        }
    }
}

TEST(Shadow, OfALoneConvexBodyIsNotOnItsLitSide) {
    for (const auto kind : {LightKind::directional, LightKind::point}) {
        Shot s = shot("convex", 64, 64);
        s.scene.materials = {plain(Vec3(0.8F))};
        add_sphere(s.scene.mesh, Vec3(0), 0.9F, 20, 11, 0);
        s.scene.mesh.uv.clear();
        s.options.lights = {lamp(kind)};
        s.options.lights[0].position = {1, 1.5, 0.5};
        s.options.shadow_size = 128;
        const Oracle oracle(s);
        for (const std::string& technique : kShadowTechniques) {
            const std::vector<double> share = shares(s, technique);
            int lit = 0;
            for (int y = 0; y < 64; ++y) {
                for (int x = 0; x < 64; ++x) {
                    const Oracle::Place p = oracle.place(x + 0.5, y + 0.5);
                    const double got = share[static_cast<std::size_t>(y * 64 + x)];
                    if (p.triangle == SIZE_MAX || got < 0 || oracle.height(p) < 1e-3) continue;
                    ++lit;
                    EXPECT_EQ(got, 1) << technique << ' ' << x << ' ' << y;
                }
            }
            EXPECT_GT(lit, 300);
        }
    }
}

TEST(Shadow, OfWhatStandsBehindTheLightFallsNowhere) {
    Shot s = stage("behind", {lamp(LightKind::point)});
    s.options.tone = "clamp"; // else the tone's white depends on what stands around the lamp
    s.options.lights[0].position = {0.1, 0.35, 0.6};
    const std::size_t before = s.scene.mesh.triangles();
    add_quad(s.scene.mesh, {{{-1, 0.8F, 1}, {1, 0.8F, 1}, {1, 0.8F, 0.1F}, {-1, 0.8F, 0.1F}}},
             {0, -1, 0}, 2);
    s.scene.mesh.uv.clear();
    s.camera.elevation_degrees = 10;
    Shot without = s;
    without.scene.mesh.index.resize(before * 3);
    without.scene.mesh.material.resize(before);
    without.scene.mesh.face.resize(before);
    for (const std::string& technique : {std::string("projected"), std::string("volume")}) {
        s.options.shadow = without.options.shadow = technique;
        frame::Visibility seen;
        const image::Image a = draw(s, {.visibility = &seen}), b = draw(without);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                if (seen.id[static_cast<std::size_t>(y * 64 + x)] < before) {
                    EXPECT_EQ(a.at(x, y), b.at(x, y)) << technique << ' ' << x << ' ' << y;
                }
    }
}

TEST(Shadow, ChangesNoBitWhereNoLightCasts) {
    for (const auto kind : {LightKind::directional, LightKind::point, LightKind::spot}) {
        Shot s = stage("plain", {light_of(kind, 0.9)});
        const image::Image plain = draw(s);
        for (const std::string& technique : kShadowTechniques) {
            s.options.shadow = technique;
            s.options.effects["shadow"] = true;
            frame::FrameStats stats;
            EXPECT_EQ(draw(s, {.stats = &stats}), plain) << technique;
            EXPECT_EQ(stats.shadow_bytes, 0U);
        }
    }
}

TEST(Shadow, OfALightWithoutSizeIsTheFilteredOneToTheBit) {
    for (Shot s : rooms()) {
        s.options.shadow = "map_pcf";
        s.options.shadow_size = 256;
        const image::Image filtered = draw(s);
        s.options.shadow = "map_soft";
        EXPECT_EQ(draw(s), filtered) << s.name;
    }
}

// Something leans over the floor that it stands on, so steeply that its far end, high above, lies
// next to its foot as the light sees it. All of the light is behind it: none may come in beside it.
TEST(Shadow, IsWholeAtTheFootOfWhatLeansOverIt) {
    Shot s = shot("leaning", 96, 96);
    s.scene.materials = {plain(Vec3(0.8F))};
    add_square(s.scene.mesh, 1, 0, 0);
    add_quad(s.scene.mesh, {{{0, -0.9F, 0}, {0, 0.9F, 0}, {0.5F, 0.9F, 1}, {0.5F, -0.9F, 1}}},
             {-0.894F, 0, 0.447F}, 0);
    s.scene.mesh.uv.clear();
    s.camera.projection = scene::Projection::orthographic;
    s.camera.elevation_degrees = 25;
    s.options.lights = {lamp(LightKind::directional)};
    s.options.lights[0].towards = {0, 0, 1};
    s.options.lights[0].size = 10;
    std::vector<Shot> rim(25, s); // the same with one ray of the light's, or a little beyond
    for (std::size_t i = 1; i < rim.size(); ++i) {
        const double turn = std::numbers::pi * static_cast<double>(i) / 12,
                     off = std::tan(11 * std::numbers::pi / 180);
        rim[i].options.lights[0].towards = {off * std::cos(turn), off * std::sin(turn), 1};
    }
    for (const int map_size : {512, 2048}) {
        int dark = 0, leaks = 0;
        for (const double azimuth : {0, 45, 90, 135, 180, 225, 270, 315}) {
            std::vector<Oracle> rays;
            for (Shot& ray : rim) {
                ray.camera.azimuth_degrees = azimuth;
                rays.emplace_back(ray);
            }
            Shot seen = rim.front();
            seen.options.shadow_size = map_size;
            const std::vector<double> share = shares(seen, "map_soft");
            for (int i = 0; i < 96 * 96; ++i) {
                const auto lit = [&](const Oracle& o) {
                    return o.lit(o.place(i % 96 + 0.5, i / 96 + 0.5));
                };
                if (share[static_cast<std::size_t>(i)] < 0) continue;
                if (std::any_of(rays.begin(), rays.end(), lit)) continue;
                ++dark;
                leaks += share[static_cast<std::size_t>(i)] > 0.02 ? 1 : 0;
            }
        }
        EXPECT_GT(dark, 500);
        // A coarse map does not know what stands within a texel of the foot.
        EXPECT_LE(leaks, map_size > 512 ? 0 : dark / 8) << map_size << " of " << dark;
    }
}

// Two faces that meet at an edge, one close behind the other as the light sees them, as at the
// mouth of a head with a lamp in it. The one behind sees the light nowhere.
TEST(Shadow, IsWholeWhereOneFaceStandsCloseBehindAnother) {
    Shot s = shot("fold", 192, 192);
    s.scene.materials = {plain(Vec3(0.8F))};
    const auto face = [&](float x, float y, const Vec3& normal) {
        add_quad(s.scene.mesh, {{{0, -0.5F, 0.5F}, {0, -0.5F, -0.5F}, {x, y, -0.5F}, {x, y, 0.5F}}},
                 normal, 0);
    };
    face(-0.1F, 0.4F, {0.994F, 0.11F, 0});
    face(0.25F, 0.5F, {0.97F, -0.243F, 0});
    s.scene.mesh.uv.clear();
    s.camera.projection = scene::Projection::orthographic;
    s.camera.azimuth_degrees = 90;
    s.camera.elevation_degrees = 84;
    scene::Light light = lamp(LightKind::directional);
    light.towards = {1, 0, 0};
    for (const int size : {128, 256, 1024}) {
        s.options.shadow_size = size;
        for (const auto kind : {LightKind::directional, LightKind::point}) {
            light.kind = kind;
            light.position = {1.5, -0.1, 0.02};
            s.options.lights = {light};
            const Oracle oracle(s);
            for (const char* technique : {"map", "map_pcf", "map_soft", "volume"}) {
                const std::vector<double> share = shares(s, technique);
                int dark = 0, leaks = 0;
                for (int i = 0; i < 192 * 192; ++i) {
                    const Oracle::Place p = oracle.place(i % 192 + 0.5, i / 192 + 0.5);
                    if (p.triangle > 1) continue; // not of the face behind
                    if (share[static_cast<std::size_t>(i)] < 0) continue;
                    ++dark;
                    leaks += share[static_cast<std::size_t>(i)] > 0.02 ? 1 : 0;
                }
                EXPECT_GT(dark, 1500);
                // What stands three texels behind or less is forgiven: a strip at the edge.
                const double most = technique == std::string("volume") ? 0 : 16.0 / size;
                EXPECT_LE(leaks, most * dark) << size << ' ' << name_of(kind) << ' ' << technique;
            }
        }
    }
}

// A renderer keeps what it found out about a scene's triangles, but only while that holds: for the
// same revision of a scene, the same materials that let light through, and the same ground.
TEST(Shadow, IsThatOfItsOwnSceneWhateverWasDrawnBefore) {
    const auto lifted = [](Shot s, float by, std::uint64_t revision) {
        s.scene.revision = revision;
        for (Vec3& p : s.scene.mesh.position) // the ball; the slab lies below
            if (p.y > -0.2F) p.x += by;
        return s;
    };
    const Shot ball = lifted(ball_on_slab(), 0, 1);
    Shot glass = ball, opaque = ball, top = ball;
    for (std::size_t i = 12; i < glass.scene.mesh.triangles(); ++i)
        glass.scene.mesh.material[i] = 1;
    glass.scene.materials.push_back(plain({0.8F, 0.5F, 0.3F}));
    glass.scene.materials[1].opacity = 0.5F;
    glass.scene.revision = 2;
    opaque = glass;
    opaque.options.blend = "none";
    top.options.shadow_plane = {DVec3(0, 1, 0), double{0.6F * 0.25F - 0.5F}}; // not the foot
    const Shot shots[] = {ball,  lifted(ball, 0.3F, 3),
                          ball,  lifted(ball, 0.2F, 0),
                          glass, opaque,
                          glass, lifted(ball, 0.1F, 0),
                          ball,  top,
                          top,   ball};
    Jobs jobs(1);
    frame::Renderer renderer(jobs);
    std::map<std::string, std::vector<image::Image>> drawn;
    for (const std::string technique : {"volume", "projected", "volume", "map"}) {
        for (std::size_t i = 0; i < std::size(shots); ++i) {
            Shot s = shots[i];
            s.options.shadow = technique;
            s.options.effects["shadow"] = true;
            const auto view = scene::make_view(s.scene.mesh, {}, {}, s.camera, {}, 48, 48);
            const auto plan =
                frame::plan(s.options, frame::facts(s.scene, s.options.shadow_plane), *view);
            ASSERT_TRUE(plan) << plan.error().what;
            EXPECT_EQ(renderer.render(s.scene, *view, *plan), draw(s)) << technique << ' ' << i;
            drawn[technique].push_back(draw(s));
        }
    }
    // They do differ.
    for (const std::string technique : {"volume", "projected"}) {
        EXPECT_NE(drawn[technique][0], drawn[technique][1]) << technique;
        EXPECT_NE(drawn[technique][3], drawn[technique][7]) << technique;
        EXPECT_NE(drawn[technique][4], drawn[technique][5]) << technique;
    }
    EXPECT_NE(drawn["projected"][8], drawn["projected"][9]);
}

TEST(Shadow, TakesNoMemoryOnceThePlanNeedsNone) {
    const Shot s = shadowed("maps", "map");
    Jobs jobs(1);
    frame::Renderer renderer(jobs);
    const auto view = scene::make_view(s.scene.mesh, {}, {}, s.camera, {}, 64, 64);
    auto plan = frame::plan(s.options, frame::facts(s.scene));
    renderer.render(s.scene, *view, *plan);
    EXPECT_EQ(renderer.stats().shadow_bytes, 256U * 256 * 4);
    frame::FrameOptions off = s.options;
    off.effects["shadow"] = false;
    plan = frame::plan(off, frame::facts(s.scene));
    renderer.render(s.scene, *view, *plan);
    EXPECT_EQ(renderer.stats().shadow_bytes, 0U);
}

} // namespace
} // namespace scanout::test
