// False colours say facts, in exact codes.
#include "frame/pass/triangle_colours.h"
#include "geom/mesh_places.h"
#include "math/srgb.h"
#include "raster/screen/primitive.h"
#include "rows.h"
#include "support/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <gmock/gmock.h>

namespace scanout::test {
namespace {

Shot coloured_by(Shot s, const std::string& by) {
    s.options.colour_by = by;
    return s;
}

using ShownCodes = std::array<int, 3>;
std::map<ShownCodes, int> colours_in(const Shot& s) {
    std::map<ShownCodes, int> found;
    const image::Image picture = draw(s);
    for (const image::Rgba8& p : picture.pixels())
        if (!(p == s.options.background)) ++found[{p.r, p.g, p.b}];
    return found;
}
ShownCodes codes_of(const Vec3& linear) {
    return {srgb_encode(linear.x), srgb_encode(linear.y), srgb_encode(linear.z)};
}
std::set<ShownCodes> codes_in(const std::map<ShownCodes, int>& found) {
    std::set<ShownCodes> all;
    for (const auto& [colour, count] : found)
        all.insert(colour);
    return all;
}

Shot coloured_cube() {
    Shot s = shot("cube", 96, 96);
    s.scene.materials = {plain(Vec3(0.5F)), plain(Vec3(0.1F))};
    add_cube(s.scene.mesh, 0.5F, 1);
    s.scene.mesh.uv.clear();
    s.camera.azimuth_degrees = 30;
    s.camera.elevation_degrees = 25;
    return s;
}

constexpr ShownCodes kFrontCodes{90, 130, 230}, kBackCodes{220, 70, 60};

TEST(ColourBy, NormalShowsTheDirectionOfEachFaceInTheFilesAxes) {
    const std::set<ShownCodes> expected = {{255, 128, 128}, {128, 255, 128}, {128, 128, 255}};
    for (const char* interpolate : {"perspective", "affine", "adaptive"}) {
        Shot s = coloured_by(coloured_cube(), "normal");
        s.options.interpolate = interpolate;
        EXPECT_EQ(codes_in(colours_in(s)), expected) << interpolate;
    }
    Shot s = coloured_by(coloured_cube(), "normal");
    s.model.rotate_degrees = {0, 180, 0}; // the other sides look at the eye
    EXPECT_EQ(codes_in(colours_in(s)),
              (std::set<ShownCodes>{{0, 128, 128}, {128, 255, 128}, {128, 128, 0}}));
}

TEST(ColourBy, SideShowsFrontsAndBacks) {
    for (const scene::Projection projection :
         {scene::Projection::perspective, scene::Projection::orthographic})
        for (const double mirror : {1.0, -1.0}) {
            Shot s = coloured_by(coloured_cube(), "side");
            s.camera.projection = projection;
            s.model.scale = {mirror, 1, 1};
            EXPECT_EQ(codes_in(colours_in(s)), std::set<ShownCodes>{kFrontCodes}) << mirror;
            s.options.cull = frame::Cull::front;
            EXPECT_EQ(codes_in(colours_in(s)), std::set<ShownCodes>{kBackCodes}) << mirror;
        }
    const auto found = colours_in(coloured_by(bowl("bowl", frame::Cull::none), "side"));
    EXPECT_EQ(codes_in(found), (std::set<ShownCodes>{kFrontCodes, kBackCodes}))
        << "a bowl shows both";
}

TEST(ColourBy, MaterialAndPartHaveAColourEach) {
    EXPECT_EQ(codes_in(colours_in(coloured_by(coloured_cube(), "material"))),
              std::set<ShownCodes>{codes_of(frame::distinct_colour(1))});
    Shot none = coloured_by(coloured_cube(), "material");
    std::fill(none.scene.mesh.material.begin(), none.scene.mesh.material.end(), -1);
    EXPECT_EQ(codes_in(colours_in(none)), (std::set<ShownCodes>{{170, 170, 170}}));
    EXPECT_EQ(codes_in(colours_in(coloured_by(coloured_cube(), "part"))),
              std::set<ShownCodes>{codes_of(frame::distinct_colour(0))})
        << "though its faces have vertices of their own";
    Shot two = coloured_by(coloured_cube(), "part");
    add_sphere(two.scene.mesh, {0.6F, 0.5F, 0.5F}, 0.2F, 12, 6, 1);
    two.scene.mesh.uv.clear();
    EXPECT_EQ(codes_in(colours_in(two)),
              (std::set<ShownCodes>{codes_of(frame::distinct_colour(0)),
                                    codes_of(frame::distinct_colour(1))}));
    std::set<ShownCodes> all;
    for (std::uint32_t i = 0; i < 64; ++i)
        all.insert(codes_of(frame::distinct_colour(i)));
    EXPECT_EQ(all.size(), 64U);
}

TEST(ColourBy, DepthIsAsFarFromWhiteAsThePixelFromTheNearestCorner) {
    for (const scene::Projection projection :
         {scene::Projection::perspective, scene::Projection::orthographic}) {
        Shot s = coloured_by(coloured_cube(), "depth");
        s.camera.projection = projection;
        s.scene.mesh.box_min = DVec3(-0.5);
        s.scene.mesh.box_max = DVec3(0.5);
        const scene::View view = *scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {},
                                                   s.options.width, s.options.height);
        frame::Visibility visible;
        const image::Image picture = draw(s, view, {.visibility = &visible});
        const frame::DepthRange range = frame::depth_range(s.scene.mesh, view);
        int seen = 0, lowest = 255, highest = 0;
        for (std::size_t p = 0; p < visible.id.size(); ++p) {
            if (visible.id[p] == raster::kNoPrimitive) continue;
            const double depth = visible.depth[p];
            const double distance = projection == scene::Projection::perspective
                                        ? view.near_distance / depth
                                        : -(depth / view.depth_scale + view.depth_origin);
            const double code =
                255 * (range.farthest - distance) / (range.farthest - range.nearest);
            const image::Rgba8 got = picture.pixels()[p];
            ASSERT_NEAR(got.r, code, 0.51) << p;
            ASSERT_TRUE(got.r == got.g && got.g == got.b);
            lowest = std::min<int>(lowest, got.r);
            highest = std::max<int>(highest, got.r);
            ++seen;
        }
        EXPECT_GT(seen, 1000);
        EXPECT_GT(highest - lowest, 100);
        EXPECT_GT(highest, 240);
    }
}

TEST(ColourBy, DependsOnNoTileAndNoThreadAndIsSmoothedLikeLight) {
    for (const std::string& name : names_on("colour_by"))
        for (const char* aa : {"none", "samples_4", "supersampling_2", "tent", "area"}) {
            Shot s = coloured_by(solids("solids"), name);
            s.options.width = 131;
            s.options.height = 67;
            s.options.aa = aa;
            s.options.edges = "feature";
            const image::Image first = draw(s);
            EXPECT_EQ(draw(s, {.threads = 3, .tile_size = 8}), first) << name << ' ' << aa;
        }
}

TEST(ColourBy, LightsNothingAndIsLeftWithoutATrace) {
    Jobs jobs(1);
    frame::Renderer renderer(jobs);
    std::uint64_t revision = 0;
    for (Shot s : {solids("solids"), bowl("bowl", frame::Cull::none)}) {
        s.scene.revision = ++revision;
        for (const char* name :
             {"auto", "part", "normal", "light", "side", "material", "depth", "auto"}) {
            const Shot asked = coloured_by(s, name);
            const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {},
                                               s.options.width, s.options.height);
            const auto plan = frame::plan(asked.options, frame::facts(s.scene), *view);
            ASSERT_TRUE(plan);
            const bool light = name == std::string("auto") || name == std::string("light");
            EXPECT_EQ(plan->colours == nullptr, light);
            EXPECT_EQ(renderer.render(s.scene, *view, *plan), draw(asked)) << name;
            for (const Technique* t : plan->techniques)
                EXPECT_TRUE(light || (t->axis != "light" && t->axis != "reflection" &&
                                      t->axis != "shading" && t->axis != "shadow"))
                    << t->axis;
            EXPECT_EQ(plan->decision("directional_light")->on(), light);
            EXPECT_EQ(plan->lights.empty(), !light);
        }
    }
    const auto unknown = frame::plan(coloured_by(coloured_cube(), "mood").options, {});
    ASSERT_FALSE(unknown);
    EXPECT_THAT(unknown.error().what, testing::HasSubstr("choose auto light normal depth"));
}

} // namespace
} // namespace scanout::test
