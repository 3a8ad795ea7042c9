// What a user asks for and does not get is said in a line, and only that.
#include "frame/in_vain.h"
#include "support/scenes.h"
#include "support/transparent_scenes.h"

#include <algorithm>
#include <functional>

#include <gmock/gmock.h>

namespace scanout::test {
namespace {

using frame::FrameOptions;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> in_vain(const Shot& s) {
    const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                                       s.options.height);
    const auto plan = frame::plan(s.options, frame::facts(s.scene, s.options.shadow_plane), *view);
    EXPECT_TRUE(plan) << s.name;
    return plan ? frame::asked_in_vain(*plan) : std::vector<std::string>();
}

// One option, and what it asks for.
struct Asked {
    const char* option;
    std::function<void(FrameOptions&)> ask;
};
const std::vector<Asked>& all_options() {
    static const std::vector<Asked> options = {
        {"--texture", [](FrameOptions& o) { o.texture = "nearest"; }},
        {"--wrap", [](FrameOptions& o) { o.wrap = "mirror"; }},
        {"--mapping", [](FrameOptions& o) { o.mapping = "cylinder"; }},
        {"--reflection", [](FrameOptions& o) { o.reflection = "phong"; }},
        {"--transparency", [](FrameOptions& o) { o.transparency = "sorted"; }},
        {"--blend", [](FrameOptions& o) { o.blend = "add"; }},
        {"--alpha-cut", [](FrameOptions& o) { o.alpha_cut = 0.9; }},
        {"--blend-space", [](FrameOptions& o) { o.blend_space = "encoded"; }},
        {"--shadow volume", [](FrameOptions& o) { o.shadow = "volume"; }},
        {"--shadow-size", [](FrameOptions& o) { o.shadow_size = 128; }},
        {"--shadow-filter", [](FrameOptions& o) { o.shadow_filter = 7; }},
        {"--shadow-plane", [](FrameOptions& o) {
             o.shadow_plane = {DVec3(0, 1, 0), 0};
         }}};
    return options;
}

// How the line about it begins.
std::string said_of(const Asked& asked) {
    return asked.option == std::string("--shadow volume") ? "shadow off" : asked.option;
}

TEST(InVain, AnOptionThatAPlainSceneHasNoUseForIsNamed) {
    Shot s = solids("plain");
    EXPECT_THAT(in_vain(s), IsEmpty());
    for (const Asked& asked : all_options()) {
        Shot other = s;
        asked.ask(other.options);
        EXPECT_THAT(in_vain(other), ElementsAre(HasSubstr(said_of(asked)))) << asked.option;
    }
}

TEST(InVain, WhatIsSaidToChangeNothingChangesNoBit) {
    int said = 0;
    for (const Shot& s : golden_shots()) {
        if (s.options.stencil != "auto") continue;
        const image::Image picture = draw(s);
        for (const Asked& asked : all_options()) {
            Shot other = s;
            asked.ask(other.options);
            const std::vector<std::string> lines = in_vain(other);
            if (std::none_of(lines.begin(), lines.end(), [&](const std::string& line) {
                    return line.starts_with(said_of(asked));
                }))
                continue;
            EXPECT_EQ(draw(other), picture) << s.name << " " << asked.option;
            ++said;
        }
    }
    EXPECT_GT(said, 500);
}

TEST(InVain, PairsThatDoNotGoTogetherAreNamed) {
    Shot s = solids("lit");
    s.options.lights = {light_of(scene::LightKind::directional, 1)};
    s.options.lights[0].casts = true;
    s.options.shadow_plane = {DVec3(0, 1, 0), 0};
    EXPECT_THAT(in_vain(s), ElementsAre(HasSubstr("--shadow-plane changes nothing")));
    s.options.shadow_plane.reset();
    s.options.shadow = "volume";
    s.options.shadow_size = 2048;
    s.options.shadow_filter = 5;
    s.options.lights[0].size = 3;
    EXPECT_THAT(in_vain(s),
                ElementsAre(HasSubstr("--shadow-size 2048"), HasSubstr("--shadow-filter 5"),
                            HasSubstr("the size of a light")));
    s.options.shadow = "map_soft";
    s.options.shadow_filter = 3;
    EXPECT_THAT(in_vain(s), IsEmpty());
}

TEST(InVain, ATechniqueThatAnotherReplacesIsNamed) {
    Shot s = bowl("bare", frame::Cull::none);
    s.scene.materials[0].opacity = 0.5F;
    s.options.aa = "area";
    EXPECT_THAT(in_vain(s), ElementsAre(HasSubstr("--aa area is not possible: areas know no "
                                                  "transparency, which this scene has; samples_16 "
                                                  "in its place")));
    s.options.aa = "auto";
    s.options.samples = 4;
    EXPECT_THAT(in_vain(s), IsEmpty());
    s.options.blend = "add";
    EXPECT_THAT(in_vain(s), IsEmpty()) << "something blends";
    s.options.transparency = "cut_out";
    EXPECT_THAT(in_vain(s), ElementsAre(HasSubstr("--blend add changes nothing")));
    Shot bare = covered_solids("bare", "checker", "uv");
    bare.scene.mesh.uv.clear();
    EXPECT_THAT(in_vain(bare), ElementsAre(HasSubstr("--mapping uv is not possible: the model has "
                                                     "no uv; box in its place")));
}

} // namespace
} // namespace scanout::test
