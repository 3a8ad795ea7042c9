// Ambient occlusion in screen space against closed forms, and what it must leave alone.
#include "frame/pass/ambient_occlusion.h"
#include "frame/plan/ignored_options.h"
#include "oracle/obscurance.h"
#include "support/scenes.h"

#include <cmath>

#include <gmock/gmock.h>

namespace scanout::test {
namespace {

constexpr const char* kOcclusionRungs[] = {"gtao_4", "gtao_8", "gtao_16"};
constexpr scene::Projection kProjections[] = {scene::Projection::perspective,
                                              scene::Projection::orthographic};

Shot occluded(Shot s, const std::string& rung) {
    s.options.ambient_occlusion = rung;
    return s;
}

// In light from everywhere alone.
Shot in_ambient_light(Shot s) {
    s.options.lights = {light_of(scene::LightKind::ambient, 0.8)};
    return s;
}

scene::View view_of_shot(const Shot& s) {
    return *scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                             s.options.height);
}

// The share of the light that arrives at each pixel; -1 where nothing is seen.
std::vector<double> open_shares(const Shot& s, const std::string& rung) {
    shade::LinearPicture with, without;
    draw(occluded(s, rung), {.linear = &with});
    draw(occluded(s, "none"), {.linear = &without});
    std::vector<double> found;
    for (std::size_t i = 0; i < with.pixel.size(); ++i)
        found.push_back(
            without.pixel[i][0] > 0 ? double{with.pixel[i][0]} / double{without.pixel[i][0]} : -1);
    return found;
}

// A floor, and a wall that stands on it along z = 0; half as high as the floor is wide.
Shot right_angle(std::string name) {
    Shot s = in_ambient_light(shot(std::move(name), 160, 120));
    s.scene.materials = {plain(Vec3(0.8F))};
    add_quad(s.scene.mesh, {Vec3(-1, 0, 0), {-1, 0, 1}, {1, 0, 1}, {1, 0, 0}}, {0, 1, 0}, 0);
    add_quad(s.scene.mesh, {Vec3(-1, 0, 0), {1, 0, 0}, {1, 1, 0}, {-1, 1, 0}}, {0, 0, 1}, 0);
    s.scene.mesh.uv.clear();
    s.camera.elevation_degrees = 45;
    s.camera.azimuth_degrees = 10;
    return s;
}

// What each pixel shows, in the mesh's space.
std::vector<std::optional<DVec3>> places_seen(const Shot& s) {
    const scene::View view = view_of_shot(s);
    frame::Visibility visible;
    draw(s, view, {.visibility = &visible});
    std::vector<std::optional<DVec3>> found;
    for (int y = 0; y < visible.height; ++y)
        for (int x = 0; x < visible.width; ++x) {
            const auto i = static_cast<std::size_t>(y * visible.width + x);
            if (visible.id[i] == raster::kNoPrimitive) {
                found.emplace_back();
                continue;
            }
            const bool flat = view.projection == scene::Projection::orthographic;
            const double depth = visible.depth[i];
            const double z =
                flat ? depth / view.depth_scale + view.depth_origin : -view.near_distance / depth;
            const double spread = flat ? 1 : -z;
            const DVec3 p((2 * (x + 0.5) / visible.width - 1) * view.half_width * spread,
                          (1 - 2 * (y + 0.5) / visible.height) * view.half_height * spread, z);
            const DVec3 q = p - view.translation;
            DVec3 in_mesh;
            for (int c = 0; c < 3; ++c) // a rotation times a scale
                in_mesh[c] = dot3(view.linear[c], q) / dot3(view.linear[c], view.linear[c]);
            found.emplace_back(in_mesh);
        }
    return found;
}

TEST(AmbientOcclusion, InARightAngleIsTheClosedForm) {
    for (const scene::Projection projection : kProjections) {
        Shot s = right_angle("corner");
        s.camera.projection = projection;
        const auto at = places_seen(s);
        double before = 1;
        for (const char* rung : kOcclusionRungs) {
            const std::vector<double> share = open_shares(s, rung);
            double squares = 0;
            int compared = 0;
            for (std::size_t i = 0; i < share.size(); ++i) {
                // Away from the ends of both, which the closed form does not know.
                if (!at[i] || std::abs(at[i]->x) > 0.7) continue;
                const bool floor = at[i]->z > at[i]->y;
                const double away = floor ? at[i]->z : at[i]->y;
                if (away > 0.7 || away < 0.04) continue;
                const double expected = oracle::open_beside_wall(away / shade::kOcclusionRadius);
                ASSERT_NEAR(share[i], expected, 0.08) << rung << ' ' << i << ' ' << away;
                squares += (share[i] - expected) * (share[i] - expected);
                ++compared;
            }
            ASSERT_GT(compared, 1000);
            const double error = std::sqrt(squares / compared);
            EXPECT_LT(error, 0.02) << rung;
            EXPECT_LT(error, before) << rung << " errs no less than the rung before it";
            before = error;
        }
    }
}

// However many samples, or pixels that are shaded for one, away from the outline and the edge.
TEST(AmbientOcclusion, IsTheSameWithSeveralSamples) {
    const Shot one = occluded(right_angle("corner"), "gtao_16");
    const auto at = places_seen(one);
    const image::Image expected = draw(one);
    for (const char* aa : {"samples_4", "supersampling_2", "area"}) {
        Shot s = one;
        s.options.aa = aa;
        const image::Image found = draw(s);
        int compared = 0;
        for (std::size_t i = 0; i < at.size(); ++i) {
            if (!at[i] || std::abs(at[i]->x) > 0.8) continue;
            const double away = std::max(at[i]->z, at[i]->y);
            if (away > 0.8 || away < 0.04) continue;
            ASSERT_NEAR(found.pixels()[i].r, expected.pixels()[i].r, 3) << aa << ' ' << i;
            ++compared;
        }
        EXPECT_GT(compared, 1000) << aa;
    }
}

// Forced on where the plan leaves it out: it changes no bit.
TEST(AmbientOcclusion, OfFlatAndConvexBodiesChangesNoBit) {
    Shot plane = shot("plane"), cube = shot("cube"), sphere = shot("sphere"),
         coarse = shot("coarse");
    add_square(plane.scene.mesh, 2);
    add_cube(cube.scene.mesh, 0.6F);
    add_sphere(sphere.scene.mesh, Vec3(0), 0.9F, 160, 80, -1);
    add_sphere(coarse.scene.mesh, Vec3(0), 0.9F, 9, 5, -1);
    for (Shot& s : {std::ref(plane), std::ref(cube), std::ref(sphere), std::ref(coarse)}) {
        s.scene.mesh.uv.clear();
        s.options.width = 150;
        s.options.height = 110;
        for (const scene::Projection projection : kProjections)
            for (const double turn : {0.0, 37.0})
                for (const int samples : {1, 4}) {
                    s.camera.projection = projection;
                    s.camera.azimuth_degrees = turn;
                    s.camera.elevation_degrees = turn / 2;
                    s.options.samples = samples;
                    for (const char* rung : kOcclusionRungs) {
                        Shot forced = occluded(s, rung);
                        frame::FrameStats stats;
                        EXPECT_EQ(draw(forced, {.stats = &stats}), draw(s)) << s.name;
                        if (s.name == "plane" || s.name == "cube") { // plain to see
                            EXPECT_EQ(stats.occlusion_bytes, 0U) << s.name << ": the plan runs it";
                        }
                        forced.options.effects["ambient_occlusion"] = true;
                        EXPECT_EQ(draw(forced, {.stats = &stats}), draw(s))
                            << s.name << ' ' << rung << ' ' << turn << ' ' << samples;
                        EXPECT_GT(stats.occlusion_bytes, 0U) << s.name;
                    }
                }
    }
}

TEST(AmbientOcclusion, DependsOnNoTileAndNoThread) {
    for (const char* rung : kOcclusionRungs)
        for (const char* aa : {"none", "samples_4", "supersampling_2", "tent", "area"})
            for (const scene::Projection projection : kProjections) {
                Shot s = occluded(solids("solids"), rung);
                s.options.width = 131;
                s.options.height = 67;
                s.options.aa = aa;
                s.camera.projection = projection;
                const image::Image first = draw(s);
                EXPECT_EQ(draw(s, {.threads = 3, .tile_size = 8}), first) << rung << ' ' << aa;
                EXPECT_NE(draw(occluded(s, "none")), first) << rung << ' ' << aa;
            }
}

// A ball far before a wall: no halo around it, and none on its rim, at any number of samples.
TEST(AmbientOcclusion, WhatIsFarApartHidesNothing) {
    Shot s = in_ambient_light(shot("halo", 120, 120));
    s.scene.materials = {plain(Vec3(0.8F))};
    add_square(s.scene.mesh, 2, -0.9F, 0);
    add_sphere(s.scene.mesh, {0, 0, 0.5F}, 0.3F, 64, 32, 0);
    s.scene.mesh.uv.clear();
    for (const int samples : {1, 4, 16})
        for (const char* rung : kOcclusionRungs) {
            s.options.samples = samples;
            Shot forced = occluded(s, rung);
            forced.options.effects["ambient_occlusion"] = true;
            EXPECT_EQ(draw(forced), draw(s)) << rung << ' ' << samples;
        }
}

TEST(AmbientOcclusion, DarkensOnlyTheLightFromEverywhere) {
    Shot s = solids("solids");
    s.options.lights = {light_of(scene::LightKind::directional, 0.8)};
    for (const char* rung : kOcclusionRungs) {
        EXPECT_EQ(draw(occluded(s, rung)), draw(s)) << rung;
        const auto plan =
            frame::plan(occluded(s, rung).options, frame::facts(s.scene), view_of_shot(s));
        ASSERT_TRUE(plan);
        EXPECT_EQ(plan->decision("ambient_occlusion")->because, "no light comes from everywhere");
    }
    Shot lit = in_ambient_light(solids("solids"));
    const image::Image with = draw(occluded(lit, "gtao_8")), without = draw(lit);
    int darker = 0;
    for (std::size_t i = 0; i < with.pixels().size(); ++i) {
        ASSERT_LE(with.pixels()[i].r, without.pixels()[i].r);
        darker += with.pixels()[i].r < without.pixels()[i].r ? 1 : 0;
    }
    EXPECT_GT(darker, 40);
}

// Behind a pane the corner is as dark as without it, and the pane is as bright as far from it.
TEST(AmbientOcclusion, BlendedSurfacesNeitherHideNorAreHidden) {
    Shot s = right_angle("corner");
    s.scene.materials.push_back(glass(Vec3(0.3F), 0.5F));
    add_quad(s.scene.mesh,
             {Vec3(-1, 0.1F, 0.3F), {1, 0.1F, 0.3F}, {1, 0.3F, 0.1F}, {-1, 0.3F, 0.1F}}, {0, 1, 1},
             1);
    s.scene.mesh.uv.clear();
    shade::LinearPicture dark, bright, alone;
    draw(occluded(s, "gtao_8"), {.linear = &dark});
    draw(s, {.linear = &bright});
    draw(occluded(right_angle("corner"), "gtao_8"), {.linear = &alone});
    const auto at = places_seen(right_angle("corner"));
    int seen = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        if (!at[i] || std::abs(at[i]->x) > 0.9) continue;
        // The opaque light behind a pane of alpha 1/2, and the pane's own.
        const double pane = double{bright.pixel[i][0]} - 0.5 * 0.8 * 0.8;
        if (std::abs(pane - 0.5 * 0.3 * 0.8) > 1e-4) continue;
        EXPECT_NEAR(double{dark.pixel[i][0]} - pane, 0.5 * double{alone.pixel[i][0]}, 2e-3);
        ++seen;
    }
    EXPECT_GT(seen, 500);
}

TEST(AmbientOcclusion, IsOffWhereItChangesNothing) {
    const auto row = [](const Shot& s) {
        const auto plan = frame::plan(s.options, frame::facts(s.scene), view_of_shot(s));
        EXPECT_TRUE(plan);
        EXPECT_EQ(plan->occlusion != nullptr,
                  plan->decision("ambient_occlusion")->technique == "gtao_4");
        return plan->decision("ambient_occlusion")->because;
    };
    Shot s = occluded(solids("solids"), "gtao_4");
    EXPECT_THAT(row(s), testing::HasSubstr("in 4 directions"));
    s.options.shading = "gouraud";
    EXPECT_THAT(row(s), testing::HasSubstr("light at pixels"));
    s.options.shading = "auto";
    s.options.depth_test = "greater";
    EXPECT_THAT(row(s), testing::HasSubstr("--depth-test"));
    s.options.depth_test = "auto";
    s.options.lights.clear();
    EXPECT_THAT(row(s), testing::HasSubstr("no light shines"));
    const auto plan = frame::plan(s.options, frame::facts(s.scene), view_of_shot(s));
    EXPECT_THAT(frame::ignored_options(*plan),
                testing::Contains("ambient_occlusion off: no light shines"));
    EXPECT_THAT(row(solids("solids")), testing::HasSubstr("only on request"));

    // Two cubes, and the gap between them.
    for (const auto& [gap, clear] : {std::pair{0.1F, false}, {0.4F, true}}) {
        Shot two = occluded(shot("two"), "gtao_4");
        for (const float side : {-1.0F, 1.0F}) {
            const auto first = two.scene.mesh.position.size();
            add_cube(two.scene.mesh, 0.3F);
            for (auto i = first; i < two.scene.mesh.position.size(); ++i)
                two.scene.mesh.position[i].x += side * (0.3F + gap / 2);
        }
        two.scene.mesh.uv.clear();
        two.camera.azimuth_degrees = 25;
        EXPECT_EQ(row(two).find("flat or convex") != std::string::npos, clear) << gap;
        const image::Image without = draw(occluded(two, "none"));
        EXPECT_EQ(draw(two) == without, clear) << gap;
        two.options.effects["ambient_occlusion"] = true;
        EXPECT_EQ(draw(two) == without, clear) << gap;
    }
}

TEST(AmbientOcclusion, IsLeftWithoutATrace) {
    Jobs jobs(2);
    frame::Renderer renderer(jobs);
    std::uint64_t revision = 0;
    for (Shot s : {solids("solids"), bowl("bowl", frame::Cull::none), holed_cube("holes")}) {
        s.scene.revision = ++revision;
        for (const char* rung : {"auto", "gtao_16", "none", "gtao_4", "gtao_8", "auto"})
            for (const char* colours : {"auto", "side"}) {
                Shot asked = occluded(s, rung);
                asked.options.colour_by = colours;
                const scene::View view = view_of_shot(s);
                const auto plan = frame::plan(asked.options, frame::facts(s.scene), view);
                ASSERT_TRUE(plan);
                EXPECT_EQ(renderer.render(s.scene, view, *plan), draw(asked)) << rung;
                EXPECT_EQ(renderer.stats().occlusion_bytes > 0, plan->occlusion != nullptr) << rung;
                EXPECT_EQ(plan->occlusion != nullptr,
                          rung[0] == 'g' && colours == std::string("auto"))
                    << s.name << ' ' << rung;
            }
    }
}

} // namespace
} // namespace scanout::test
