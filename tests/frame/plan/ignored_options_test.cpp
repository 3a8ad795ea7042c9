// What a user asks for and does not get is said in a line, and only that.
#include "frame/plan/ignored_options.h"
#include "image/compare.h"
#include "support/scenes.h"
#include "support/transparent_scenes.h"

#include <algorithm>
#include <functional>
#include <set>

#include <gmock/gmock.h>

namespace scanout::test {
namespace {

using frame::FrameOptions;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> ignored(const Shot& s) {
    const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                                       s.options.height);
    const auto plan = frame::plan(s.options, frame::facts(s.scene, s.options.shadow_plane), *view);
    EXPECT_TRUE(plan) << s.name;
    return plan ? frame::ignored_options(*plan) : std::vector<std::string>();
}

// One option, and what it asks for.
struct IgnoredOption {
    const char* option;
    std::function<void(FrameOptions&)> ask;
};
const std::vector<IgnoredOption>& all_options() {
    static const std::vector<IgnoredOption> options = {
        {"--texture", [](FrameOptions& o) { o.texture = "nearest"; }},
        {"--wrap", [](FrameOptions& o) { o.wrap = "mirror"; }},
        {"--mapping", [](FrameOptions& o) { o.mapping = "cylinder"; }},
        {"--reflection", [](FrameOptions& o) { o.reflection = "phong"; }},
        {"--transparency", [](FrameOptions& o) { o.transparency = "sorted"; }},
        {"--blend", [](FrameOptions& o) { o.blend = "add"; }},
        {"--alpha-cut", [](FrameOptions& o) { o.alpha_cut = 0.9; }},
        {"--blend-space", [](FrameOptions& o) { o.blend_space = "encoded"; }},
        {"--tone", [](FrameOptions& o) { o.tone = "shoulder"; }},
        {"--shadow volume", [](FrameOptions& o) { o.shadow = "volume"; }},
        {"--shadow-size", [](FrameOptions& o) { o.shadow_size = 128; }},
        {"--shadow-filter", [](FrameOptions& o) { o.shadow_filter = 7; }},
        {"--shadow-plane", [](FrameOptions& o) {
             o.shadow_plane = {DVec3(0, 1, 0), 0};
         }}};
    return options;
}

// How the line about it begins.
std::string said_of(const IgnoredOption& asked) {
    return asked.option == std::string("--shadow volume") ? "shadow off" : asked.option;
}

TEST(IgnoredOptions, AnOptionThatAPlainSceneHasNoUseForIsNamed) {
    Shot s = solids("plain");
    EXPECT_THAT(ignored(s), IsEmpty());
    for (const IgnoredOption& asked : all_options()) {
        Shot other = s;
        asked.ask(other.options);
        EXPECT_THAT(ignored(other), ElementsAre(HasSubstr(said_of(asked)))) << asked.option;
    }
}

TEST(IgnoredOptions, WhatIsSaidToChangeNothingChangesNoBit) {
    int said = 0;
    std::vector<Shot> shots = golden_shots();
    shots.push_back(glossy("metal alone", "auto"));
    shots.back().scene.materials[0].specular = Vec3(0);
    shots.back().scene.materials[0].metalness = 1;
    shots.push_back(solids("near a lamp")); // brighter there than about the model's centre
    scene::Light lamp = light_of(scene::LightKind::point, 0.5);
    lamp.position = {0.45, 0.8, 0.3};
    shots.back().options.lights = {lamp};
    shots.back().options.samples = 4; // mixed before they are cut off at 1
    for (const Shot& s : shots) {
        if (s.options.stencil != "auto") continue;
        const image::Image picture = draw(s);
        for (const IgnoredOption& asked : all_options()) {
            Shot other = s;
            asked.ask(other.options);
            const std::vector<std::string> lines = ignored(other);
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

// What one option asks for, another one undoes, or an effect that is forced does.
struct Undone {
    std::string line; // said of the two together
    std::function<void(FrameOptions&)> asked, undoing;
};
std::vector<Undone> undone() {
    const auto off = [](const char* effect) {
        return [effect](FrameOptions& o) { o.effects[effect] = false; };
    };
    const auto on = [](const char* effect) {
        return [effect](FrameOptions& o) { o.effects[effect] = true; };
    };
    const auto ask = [](const char* axis, const char* name) {
        return [axis, name](FrameOptions& o) { EXPECT_TRUE(frame::ask(o, axis, name)); };
    };
    const auto lamp = [](FrameOptions& o) {
        o.lights.push_back(light_of(scene::LightKind::point, 0.5));
    };
    return {
        {"--shadow volume changes nothing: --effect shadow=off", ask("shadow", "volume"),
         off("shadow")},
        {"--exposure 2 changes nothing: --effect exposure=off",
         [](FrameOptions& o) { o.exposure = 2; }, off("exposure")},
        {"--texture trilinear is not possible: --effect mipmaps=off leaves it out; give one of the "
         "two; bilinear in its place",
         ask("texture", "trilinear"), off("mipmaps")},
        {"--texture trilinear changes nothing: --effect texture=off", ask("texture", "trilinear"),
         off("texture")},
        {"--source checker changes nothing: --effect texture=off", ask("source", "checker"),
         off("texture")},
        {"--wrap mirror changes nothing: --effect texture=off", ask("wrap", "mirror"),
         off("texture")},
        {"--reflection phong changes nothing: --effect highlight=off", ask("reflection", "phong"),
         off("highlight")},
        {"--blend add changes nothing: --effect blending=off", ask("blend", "add"),
         off("blending")},
        {"--transparency sorted changes nothing: --effect blending=off",
         ask("transparency", "sorted"), off("blending")},
        {"--alpha-cut 0.9 changes nothing: --effect cut_out=off",
         [](FrameOptions& o) { o.alpha_cut = 0.9; }, off("cut_out")},
        {"--light point changes nothing: --effect point_light=off", lamp, off("point_light")},
        {"--depth fixed_16 changes nothing: --depth-test always", ask("depth", "fixed_16"),
         ask("depth_test", "always")},
        {"--effect shadow=on changes nothing: --shadow attached", on("shadow"),
         ask("shadow", "attached")},
        {"--effect highlight=on changes nothing: --reflection lambert", on("highlight"),
         ask("reflection", "lambert")},
        {"--effect mipmaps=on changes nothing: --texture nearest", on("mipmaps"),
         ask("texture", "nearest")},
        {"--effect blending=on changes nothing: --blend none", on("blending"),
         ask("blend", "none")},
        {"--effect blending=on changes nothing: --transparency cut_out", on("blending"),
         ask("transparency", "cut_out")},
        {"--aa samples_4 changes nothing: the picture shows counts", ask("aa", "samples_4"),
         ask("stencil", "overdraw")},
        {"--samples 4 changes nothing: the picture shows counts",
         [](FrameOptions& o) { o.samples = 4; }, ask("stencil", "overdraw")},
        {"--tone filmic changes nothing: the picture shows counts", ask("tone", "filmic"),
         ask("stencil", "overdraw")},
        {"--exposure 1 changes nothing: the picture shows counts",
         [](FrameOptions& o) { o.exposure = 1; }, ask("stencil", "overdraw")},
        {"--light point changes nothing: the picture shows counts", lamp,
         ask("stencil", "overdraw")},
        {"--effect texture=on changes nothing: the picture shows counts", on("texture"),
         ask("stencil", "overdraw")}};
}

TEST(IgnoredOptions, WhatIsUndoneIsNamedWithWhatUndoesItAndChangesNoBit) {
    for (const Undone& pair : undone()) {
        int said = 0;
        std::vector<Shot> shots = golden_shots();
        shots.push_back(bowl("glass", frame::Cull::none));
        shots.back().scene.materials[0].opacity = 0.5F;
        for (Shot& s : shots) {
            s.options.aa = s.options.stencil = s.options.texture = s.options.reflection = "auto";
            s.options.samples = 1;
            Shot both = s;
            pair.undoing(s.options);
            both.options = s.options;
            pair.asked(both.options);
            const std::vector<std::string> lines = ignored(both);
            if (std::none_of(lines.begin(), lines.end(),
                             [&](const std::string& line) { return line.starts_with(pair.line); }))
                continue;
            EXPECT_EQ(std::set(lines.begin(), lines.end()).size(), lines.size()) << s.name;
            if (++said > 10) continue;
            EXPECT_EQ(draw(both), draw(s)) << s.name << ": " << pair.line;
        }
        EXPECT_GT(said, 0) << pair.line;
    }
}

TEST(IgnoredOptions, WhatIsForTrianglesChangesNoLinesAndPoints) {
    Shot s = wires("wires");
    ASSERT_EQ(s.scene.mesh.triangles(), 0U);
    EXPECT_THAT(ignored(s), IsEmpty());
    const image::Image picture = draw(s);
    const auto expect = [&](const char* axis, const char* name, bool vain) {
        Shot other = s;
        if (axis == std::string("cull"))
            other.options.cull = frame::Cull::back;
        else
            EXPECT_TRUE(frame::ask(other.options, axis, name));
        const std::vector<std::string> lines = ignored(other);
        EXPECT_EQ(lines.size(), vain ? 1U : 0U) << axis << ' ' << name;
        for (const std::string& line : lines)
            EXPECT_THAT(line, HasSubstr("changes nothing"));
        EXPECT_EQ(draw(other) == picture, vain) << axis << ' ' << name;
    };
    for (const char* aa : {"samples_2", "samples_16", "area"})
        expect("aa", aa, true);
    for (const char* aa : {"tent", "gaussian", "supersampling_2"})
        expect("aa", aa, false);
    expect("interpolate", "affine", true);
    expect("cull", "back", true);
    expect("shading", "flat", true);
    s.options.samples = 8;
    EXPECT_EQ(draw(s), picture);
    EXPECT_THAT(ignored(s), ElementsAre(HasSubstr("--samples 8 changes nothing: lines and")));
    s.options.aa = "supersampling_4";
    s.options.samples = 1;
    const image::Image mixed = draw(s);
    s.options.blend_space = "encoded";
    EXPECT_THAT(ignored(s), IsEmpty());
    EXPECT_NE(draw(s), mixed);
}

TEST(IgnoredOptions, WithoutForeshorteningAllInterpolationsAreAlike) {
    int said = 0;
    for (Shot s : golden_shots()) {
        s.options.interpolate = "auto";
        s.camera.projection = scene::Projection::orthographic;
        const image::Image flat = draw(s);
        for (const char* name : {"affine", "affine_16", "adaptive"}) {
            s.options.interpolate = name;
            const std::vector<std::string> lines = ignored(s);
            const std::string option = std::string("--interpolate ") + name;
            for (const std::string& line : lines)
                said += line.starts_with(option + " changes nothing") ? 1 : 0;
            EXPECT_LE(image::compare(draw(s), flat).max_difference, 1) << s.name << ' ' << name;
        }
    }
    EXPECT_GT(said, 300);
}

TEST(IgnoredOptions, WithNothingInViewDepthsChangeNothing) {
    Shot s = solids("away");
    s.camera.eye = DVec3(0, 0, 5);
    s.camera.target = DVec3(0, 0, 9);
    const image::Image empty = draw(s);
    s.options.depth = "fixed_16";
    s.options.depth_test = "greater";
    EXPECT_THAT(
        ignored(s),
        ElementsAre(HasSubstr("--depth fixed_16 changes nothing: nothing of the model"),
                    HasSubstr("--depth-test greater changes nothing: nothing of the model")));
    EXPECT_EQ(draw(s), empty);
}

TEST(IgnoredOptions, MapsOfAModelWithoutCoordinatesAreNamedOnce) {
    Shot s = covered_solids("bare", "auto", "auto");
    EXPECT_THAT(ignored(s), IsEmpty());
    s.scene.mesh.uv.clear();
    EXPECT_THAT(ignored(s), ElementsAre(HasSubstr("the model has no texture coordinates")));
    Shot boxed = s, unused = s;
    boxed.options.mapping = "box";
    EXPECT_THAT(ignored(boxed), IsEmpty());
    for (std::int32_t& material : unused.scene.mesh.material)
        material = -1;
    EXPECT_THAT(ignored(unused), IsEmpty()) << "no triangle has the material";
}

TEST(IgnoredOptions, PairsThatDoNotGoTogetherAreNamed) {
    Shot s = solids("lit");
    s.options.lights = {light_of(scene::LightKind::directional, 1)};
    s.options.lights[0].casts = true;
    s.options.shadow_plane = {DVec3(0, 1, 0), 0};
    EXPECT_THAT(ignored(s), ElementsAre(HasSubstr("--shadow-plane changes nothing")));
    s.options.shadow_plane.reset();
    s.options.shadow = "volume";
    s.options.shadow_size = 2048;
    s.options.shadow_filter = 5;
    s.options.lights[0].size = 3;
    EXPECT_THAT(ignored(s),
                ElementsAre(HasSubstr("--shadow-size 2048"), HasSubstr("--shadow-filter 5"),
                            HasSubstr("the size of a light softens no shadow: --shadow volume")));
    s.options.shadow = "map_soft";
    s.options.shadow_filter = 3;
    EXPECT_THAT(ignored(s), IsEmpty());
    s.options.lights[0].casts = false;
    s.options.shadow = "auto";
    s.options.shadow_size = FrameOptions().shadow_size;
    EXPECT_THAT(ignored(s), ElementsAre(HasSubstr("softens no shadow: it casts none")));
    s.options.lights[0].casts = true;
    s.options.lights[0].size = 0;
    EXPECT_THAT(ignored(s), IsEmpty());
    const image::Image sharp = draw(s);
    s.options.shadow = "map_soft";
    EXPECT_THAT(ignored(s), ElementsAre(HasSubstr("--shadow map_soft changes nothing: no light")));
    EXPECT_EQ(draw(s), sharp);
}

TEST(IgnoredOptions, ATechniqueThatAnotherReplacesIsNamed) {
    Shot s = bowl("bare", frame::Cull::none);
    s.scene.materials[0].opacity = 0.5F;
    s.options.aa = "area";
    EXPECT_THAT(ignored(s), ElementsAre(HasSubstr("--aa area is not possible: areas know no "
                                                  "transparency, which this scene has; samples_16 "
                                                  "in its place")));
    s.options.aa = "auto";
    s.options.samples = 4;
    EXPECT_THAT(ignored(s), IsEmpty());
    s.options.blend = "add";
    EXPECT_THAT(ignored(s), IsEmpty()) << "something blends";
    s.options.transparency = "cut_out";
    EXPECT_THAT(ignored(s), ElementsAre(HasSubstr("--blend add changes nothing")));
    Shot bare = covered_solids("bare", "checker", "uv");
    bare.scene.mesh.uv.clear();
    EXPECT_THAT(ignored(bare), ElementsAre(HasSubstr("--mapping uv is not possible: the model has "
                                                     "no uv; box in its place")));
}

} // namespace
} // namespace scanout::test
