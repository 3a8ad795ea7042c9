// Shadow maps of fronts alone, against those of both sides.
#include "frame/pass/lights.h"
#include "frame/pass/shadow_maps.h"
#include "frame/plans.h"
#include "io/load.h"
#include "support/scenes.h"

#include <array>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace scanout::frame {
namespace {

using raster::Facing;
using scene::LightKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr LightKind kShadowedKinds[] = {LightKind::directional, LightKind::point, LightKind::spot};

scene::Light caster(LightKind kind) {
    scene::Light light = test::light_of(kind, 0.9);
    light.casts = true;
    light.target.reset();
    light.outer_degrees = 60;
    return light;
}

// Bodies that pierce one another, in two materials.
test::Shot bodies() {
    test::Shot s = test::solids("bodies");
    test::add_sphere(s.scene.mesh, {-0.6F, 0.5F, -0.2F}, 0.3F, 9, 7, 0);
    s.options.effects["shadow"] = true; // where a part that is left is convex, too
    return s;
}

// A rough ball: seen from its rim, neighbours fold over one another.
test::Shot knobs() {
    test::Shot s = test::shot("knobs");
    geom::Mesh& mesh = s.scene.mesh;
    test::add_sphere(mesh, Vec3(0), 0.8F, 120, 90);
    test::Random random(3);
    std::map<std::array<float, 3>, float> height;
    for (Vec3& p : mesh.position) {
        const auto [at, added] = height.try_emplace({p.x, p.y, p.z}, 0.0F);
        if (added) at->second = static_cast<float>(random.in(0.94, 1.06));
        p = p * at->second;
    }
    return s;
}

test::Shot shipped(const std::string& name) {
    test::Shot s = test::shot(name);
    Warnings warnings;
    auto scene =
        io::load(fmt::format("{}/models/{}/{}.obj", SCANOUT_SOURCE_DIR, name, name), {}, warnings);
    EXPECT_TRUE(scene) << name;
    if (scene) s.scene = std::move(*scene);
    return s;
}

// Its light from any side; one at a place is often within the model's box. Every fifth is mirrored.
void turn(test::Shot& s, int round, test::Random& random) {
    scene::Light light = caster(kShadowedKinds[round % 3]);
    light.towards = random.in_cube(1);
    const geom::Mesh& mesh = s.scene.mesh;
    light.position = mesh.centre + random.in_cube(round % 2 == 0 ? 0.7 : 3) *
                                       std::ldexp(mesh.radius, mesh.exponent);
    s.options.lights = {light, test::light_of(LightKind::ambient, 0.1)};
    s.camera.azimuth_degrees = random.in(0, 360);
    s.camera.elevation_degrees = random.in(-80, 80);
    s.model.scale.x = round % 5 == 0 ? -1 : 1;
    // Triangles of many texels, and some of less than one.
    s.options.shadow_size = round % 4 == 0 ? 512 : 64;
}

struct Frame {
    scene::View view;
    FramePlan plan;
    Facing& in_maps() { return plan.shadow.in_maps.back(); } // of its one light that casts
};
Frame frame_of(const test::Shot& s) {
    const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                                       s.options.height);
    EXPECT_TRUE(view);
    auto made = plan(s.options, facts(s.scene), *view);
    EXPECT_TRUE(made);
    EXPECT_FALSE(made->shadow.in_maps.empty()) << s.name;
    return {*view, std::move(*made)};
}

std::vector<std::vector<float>> maps(const test::Shot& s, const Frame& frame) {
    Jobs jobs(1);
    const shade::MipChains mips;
    ShadowMaps drawn(1);
    const FrameLights lights(frame.plan, frame.view, s.scene.mesh);
    drawn.add({jobs, s.scene, frame.view, frame.plan, mips}, lights.lights()[0],
              s.options.shadow_size, false);
    std::vector<std::vector<float>> depths;
    for (const shade::ShadowMap& map : drawn.maps())
        depths.emplace_back(map.depth, map.depth + map.size * map.size);
    return depths;
}

// Do maps of the frame's fronts alone differ from those of both sides?
bool backs_show(const test::Shot& s, Frame frame) {
    frame.in_maps() = Facing::front;
    const auto fronts = maps(s, frame);
    frame.in_maps() = Facing::any;
    return maps(s, frame) != fronts;
}

TEST(FrontFaceShadows, OfAClosedMeshAreAllThatALightOutsideSees) {
    test::Random random(5);
    int alone = 0, both = 0, needed = 0;
    for (test::Shot& s : std::vector{bodies(), knobs(), shipped("spot"), shipped("rabbit")})
        for (int round = 0; round < 40; ++round) {
            turn(s, round, random);
            Frame frame = frame_of(s);
            const bool fronts = frame.in_maps() == Facing::front;
            const bool differ = backs_show(s, frame);
            EXPECT_FALSE(fronts && differ) << s.name << ' ' << round;
            EXPECT_TRUE(fronts || round % 3 > 0) << "a directional light is outside";
            (fronts ? alone : both) += 1;
            needed += differ ? 1 : 0;
        }
    EXPECT_GT(alone, 120);
    EXPECT_GT(both, 10);
    EXPECT_GT(needed, 5); // lights inside
}

// What a light at a place needs of a mesh whose parts are these.
Facing needs(const test::Shot& s) {
    Frame frame = frame_of(s);
    const Facing facing = frame.in_maps();
    EXPECT_EQ(backs_show(s, frame), facing == Facing::any) << s.name;
    return facing;
}

TEST(FrontFaceShadows, AreNotAllOfWhatIsOpenOrInsideOutOrHoldsTheLight) {
    for (const LightKind kind : kShadowedKinds) {
        test::Shot s = bodies();
        s.options.lights = {caster(kind)};
        s.options.lights[0].position = {1.5, 1.8, 0.9};
        EXPECT_EQ(needs(s), Facing::front);
        s.name = "inside out";
        test::Shot turned = s;
        for (std::size_t i = 0; i < turned.scene.mesh.index.size(); i += 3)
            std::swap(turned.scene.mesh.index[i], turned.scene.mesh.index[i + 1]);
        EXPECT_EQ(needs(turned), Facing::any);
        s.name = "open";
        test::Shot open = s;
        geom::Mesh& mesh = open.scene.mesh; // its first triangle, of the cube's side at -x, goes
        mesh.index.erase(mesh.index.begin(), mesh.index.begin() + 3);
        mesh.material.erase(mesh.material.begin());
        mesh.face.erase(mesh.face.begin());
        EXPECT_EQ(frame_of(open).in_maps(), Facing::any);
        s.name = "glass";
        test::Shot glass = s; // the cube throws no shadow, and is not drawn into maps
        glass.scene.materials[1].opacity = 0.5F;
        EXPECT_EQ(frame_of(glass).in_maps(), Facing::any);
    }
    test::Shot s = bodies();
    s.name = "inside";
    s.options.lights = {caster(LightKind::point)};
    s.options.lights[0].position = {0.1, 0.1, 0.1};
    EXPECT_EQ(needs(s), Facing::any);
}

// Before the near plane of a lamp's maps a front would be left out, and a back behind it seen.
TEST(FrontFaceShadows, AreNotAllThatALampSeesThatNearlyTouchesOne) {
    test::Shot s = bodies();
    s.options.lights = {caster(LightKind::point)};
    for (const double above : {1e-7, 1e-3}) {
        s.options.lights[0].position = {0.1, -0.45 - above, 0.1}; // under the cube
        EXPECT_EQ(frame_of(s).in_maps() == Facing::front, above > 1e-4) << above;
    }
}

TEST(FrontFaceShadows, AreToldByThePlan) {
    SceneFacts facts;
    facts.triangles = 10;
    facts.topology.closed = true;
    facts.topology.closed_boxes = {{DVec3(-0.5), DVec3(0.5)}};
    scene::View view;
    view.near_distance = 0.01;
    view.translation = view.world_origin = {0, 0, -5};
    FrameOptions options;
    options.lights = {caster(LightKind::directional), caster(LightKind::point)};
    options.lights[1].position = {2, 0, 0};
    const auto because = [&](const scene::View& seen) {
        const auto made = plan(options, facts, seen);
        EXPECT_TRUE(made);
        return made->decision("shadow")->because;
    };
    EXPECT_EQ(because(view), "2 lights cast: directional, point; the mesh is closed and wound "
                             "outwards: maps hold fronts alone");
    const auto made = plan(options, facts, view);
    EXPECT_THAT(made->shadow.in_maps, ElementsAre(Facing::front, Facing::front));
    EXPECT_THAT(because({}), HasSubstr("the maps of 1 of 2 hold fronts alone")) << "of no view";
    options.lights[1].position = {0.2, 0, 0};
    EXPECT_THAT(because(view), HasSubstr("the maps of 1 of 2 hold fronts alone"));
    options.shadow = "volume";
    EXPECT_THAT(because(view), Not(HasSubstr("fronts")));
    options.shadow = "auto";
    for (int fact = 0; fact < 3; ++fact) {
        facts.topology.closed = fact != 0;
        facts.topology.inside_out = fact == 1 ? 4 : 0;
        facts.topology.back_to_back = fact == 2;
        EXPECT_EQ(because(view), "2 lights cast: directional, point") << fact;
    }
}

} // namespace
} // namespace scanout::frame
