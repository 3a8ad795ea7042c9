// The option --light: what it says, and what it answers to what it does not understand.
#include "app/options/light_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::app {
namespace {

using scene::Light;
using scene::LightFrame;
using scene::LightKind;
using testing::HasSubstr;

std::vector<Light> lights_of(const std::vector<std::string>& specs) {
    std::vector<Light> lights = scene::default_lights();
    bool first = true;
    for (const std::string& spec : specs) {
        const auto added = add_light(lights, std::exchange(first, false), spec);
        EXPECT_TRUE(added) << spec << ": " << added.error().what;
    }
    return lights;
}

std::vector<std::string> names(const std::vector<Light>& lights) {
    std::vector<std::string> found;
    for (const Light& light : lights)
        found.push_back(light.name);
    return found;
}

std::string refusal(const std::string& spec) {
    std::vector<Light> lights = scene::default_lights();
    const auto added = add_light(lights, true, spec);
    EXPECT_FALSE(added) << spec;
    EXPECT_EQ(lights, scene::default_lights()) << spec << " changed something";
    if (added) return "accepted";
    EXPECT_EQ(added.error().exit, Exit::usage);
    EXPECT_EQ(added.error().what.find('\n'), std::string::npos);
    return added.error().what;
}

TEST(LightSpec, TheFirstReplacesTheDefaultLightsButNotTheAmbientOne) {
    EXPECT_EQ(names(lights_of({})), (std::vector<std::string>{"key", "fill", "hemisphere"}));
    EXPECT_EQ(names(lights_of({"point:1,2,3"})), (std::vector<std::string>{"hemisphere", "point"}));
    EXPECT_EQ(names(lights_of({"point:1,2,3", "point:2,2,3", "key", "key"})),
              (std::vector<std::string>{"hemisphere", "point", "point 2", "key", "key 2"}));
    EXPECT_EQ(lights_of({"ambient:0.4", "key"})[0].power, 0.4);
    EXPECT_EQ(lights_of({"key", "ambient"}).back().power, double{scene::kAmbient});
    EXPECT_TRUE(lights_of({"none"}).empty());
    EXPECT_EQ(names(lights_of({"none", "fill"})), std::vector<std::string>{"fill"});
    EXPECT_EQ(lights_of({"key", "fill", "ambient:0.15"})[1].towards,
              scene::default_lights()[1].towards);
}

TEST(LightSpec, AHemisphereTakesThePlaceOfWhatComesFromEverywhere) {
    EXPECT_EQ(lights_of({"key", "fill", "hemisphere"}), scene::default_lights());
    const std::vector<Light> lights =
        lights_of({"ambient:0.2", "hemisphere:0,0,1:ground=#ff0000:power=0.5"});
    ASSERT_EQ(lights.size(), 1U);
    EXPECT_EQ(lights[0].kind, LightKind::hemisphere);
    EXPECT_EQ(lights[0].frame, LightFrame::world);
    EXPECT_EQ(lights[0].towards, DVec3(0, 0, 1));
    EXPECT_EQ(lights[0].ground, Vec3(1, 0, 0));
    EXPECT_EQ(lights[0].power, 0.5);
    EXPECT_FALSE(lights[0].casts);
    EXPECT_EQ(lights_of({"hemisphere:power=0.3"})[0].frame, LightFrame::camera);
    EXPECT_THAT(refusal("hemisphere:0,0,0"), HasSubstr("no direction"));
    EXPECT_THAT(refusal("hemisphere:0,1,0:size=1"), HasSubstr("hemisphere lights have"));
    EXPECT_THAT(refusal("point:1,2,3:ground=#ffffff"), HasSubstr("point lights have"));
    // The lights of before are still to be had.
    const std::vector<Light> before = lights_of(
        {"camera:-2,3,6:power=0.8:name=key", "camera:6,-2,3:power=0.15:name=fill", "ambient:0.15"});
    EXPECT_EQ(before, scene::plain_lights());
}

TEST(LightSpec, ReadsEveryField) {
    const Light spot = lights_of({"spot:1,-2,3e1:to=0,0.5,0:cone=10,12.5:color=#ff0000:power=2:"
                                  "size=0.25:shape=square:shadow=off:name=desk lamp"})
                           .back();
    EXPECT_EQ(spot.kind, LightKind::spot);
    EXPECT_EQ(spot.position, DVec3(1, -2, 30));
    EXPECT_EQ(spot.target, DVec3(0, 0.5, 0));
    EXPECT_EQ(spot.inner_degrees, 10);
    EXPECT_EQ(spot.outer_degrees, 12.5);
    EXPECT_EQ(spot.colour, Vec3(1, 0, 0));
    EXPECT_EQ(spot.power, 2);
    EXPECT_EQ(spot.size, 0.25);
    EXPECT_EQ(spot.shape, scene::LightShape::square);
    EXPECT_FALSE(spot.casts);
    EXPECT_EQ(spot.name, "desk lamp");
    EXPECT_EQ(spot.frame, LightFrame::world);
    const Light sun = lights_of({"directional:1,2,3:colour=grey"}).back();
    EXPECT_EQ(sun.kind, LightKind::directional);
    EXPECT_EQ(sun.towards, DVec3(1, 2, 3));
    EXPECT_NEAR(sun.colour.x, 0.2158605, 1e-6) << "colours are sRGB, light is linear";
    EXPECT_TRUE(sun.casts);
    const Light head = lights_of({"camera"}).back();
    EXPECT_EQ(head.frame, LightFrame::camera);
    EXPECT_EQ(head.towards, DVec3(0, 0, 1));
    EXPECT_FALSE(head.casts);
    EXPECT_EQ(lights_of({"camera:1,0,0:shadow=on"}).back().towards, DVec3(1, 0, 0));
    EXPECT_TRUE(lights_of({"camera:1,0,0:shadow=on"}).back().casts);
    EXPECT_EQ(lights_of({"point:0,0,0:frame=camera"}).back().frame, LightFrame::camera);
    EXPECT_EQ(lights_of({"key:power=2"}).back().power, 2);
    EXPECT_EQ(lights_of({"key:power=2"}).back().towards, scene::default_lights()[0].towards);
    EXPECT_EQ(lights_of({"ambient:power=0.3"}).back().power, 0.3);
}

TEST(LightSpec, SaysWhatIsWrong) {
    EXPECT_THAT(refusal("pont:1,2,3"), HasSubstr("did you mean 'point'?"));
    EXPECT_THAT(refusal(""), HasSubstr("directional"));
    EXPECT_THAT(refusal("point"), HasSubstr("X,Y,Z"));
    EXPECT_THAT(refusal("point:1,2"), HasSubstr("'1,2'"));
    EXPECT_THAT(refusal("directional:0,0,0"), HasSubstr("no direction"));
    EXPECT_THAT(refusal("point:1,2,3:powr=2"), HasSubstr("did you mean 'power'?"));
    EXPECT_THAT(refusal("point:1,2,3:power=-1"), HasSubstr("power wants 0 to"));
    EXPECT_THAT(refusal("point:1,2,3:power=nan"), HasSubstr("power"));
    EXPECT_THAT(refusal("point:1,2,3:cone=1,2"), HasSubstr("point lights have"));
    EXPECT_THAT(refusal("directional:1,2,3:size=90"), HasSubstr("size wants 0 to 80, not 90"));
    EXPECT_THAT(refusal("camera:size=81"), HasSubstr("size wants 0 to 80"));
    EXPECT_EQ(lights_of({"directional:1,2,3:size=80"}).back().size, 80);
    EXPECT_EQ(lights_of({"point:1,2,3:size=81"}).back().size, 81);
    for (const char* field : {"size=2", "shape=square", "shadow=on", "frame=camera", "to=1,2,3"})
        EXPECT_THAT(refusal(std::string("ambient:0.3:") + field),
                    HasSubstr("ambient lights have colour color power name"));
    EXPECT_THAT(refusal("spot:1,2,3:cone=30,20"), HasSubstr("INNER"));
    EXPECT_THAT(refusal("spot:1,2,3:to=1,2,3"), HasSubstr("move `to`"));
    EXPECT_THAT(refusal("spot:1,2,3:cone=0,181"), HasSubstr("180"));
    EXPECT_THAT(refusal("camera:shadow=maybe"), HasSubstr("off or on"));
    EXPECT_THAT(refusal("key:colour=#12"), HasSubstr("#rrggbb"));
    EXPECT_THAT(refusal("key:name="), HasSubstr("name"));
    EXPECT_THAT(refusal("key::"), HasSubstr("NAME=VALUE"));
    EXPECT_THAT(refusal("none:1"), HasSubstr("none"));
}

TEST(LightSpec, HasAnEnd) {
    std::vector<Light> lights;
    for (std::size_t i = 0; i < scene::kMaxLights; ++i)
        EXPECT_TRUE(add_light(lights, false, "key"));
    EXPECT_FALSE(add_light(lights, false, "key"));
}

RC_GTEST_PROP(LightSpec, NeverCrashes, (const std::string& tail)) {
    for (const char* head : {"", "spot:1,2,3:", "point:", "key:", "ambient:"}) {
        std::vector<Light> lights;
        (void)add_light(lights, true, head + tail);
    }
}

} // namespace
} // namespace scanout::app
