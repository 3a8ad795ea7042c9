// Live switches of the rendering: each goes through its axis, can be undone, and is in the command.
#include "app/switches/live_switches.h"
#include "app/switches/switch_note.h"
#include "app/view/view_command.h"
#include "frame/catalogue.h"
#include "viewer_bench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scanout::app {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(LiveSwitches, GoThroughTheAxisWithAutoAmongItsTechniquesAndBack) {
    for (std::size_t i = 0; i < kSwitchedAxes.size(); ++i) {
        const auto next =
            static_cast<Id>(static_cast<int>(Id::shading_next) + 2 * static_cast<int>(i));
        const auto previous = static_cast<Id>(static_cast<int>(next) + 1);
        Bench bench;
        EXPECT_EQ(bench.look().rendering.asked[i], "auto");
        const std::vector<std::string_view> names = frame::names_on(kSwitchedAxes[i]);
        for (const std::string_view name : names) {
            EXPECT_EQ(bench.act(next), Effect::rendering);
            EXPECT_EQ(bench.look().rendering.asked[i], name);
            EXPECT_THAT(bench.viewer.answer(), HasSubstr(": " + std::string(name)));
        }
        bench.act(next);
        EXPECT_EQ(bench.look().rendering.asked[i], "auto");
        bench.act(previous);
        EXPECT_EQ(bench.look().rendering.asked[i], names.back());
        for (std::size_t k = 0; k < names.size() + 2; ++k)
            bench.act(Id::undo);
        EXPECT_EQ(bench.look(), Bench().look());
    }
}

TEST(LiveSwitches, ExposureGoesByHalfStopsAndBackgroundAroundTheNames) {
    Settings settings;
    settings.frame.exposure = 0.3;
    Bench bench(settings);
    bench.act(Id::exposure_up);
    EXPECT_EQ(bench.look().rendering.exposure, 0.5);
    EXPECT_EQ(bench.viewer.answer(), "exposure: +0.5 stops");
    bench.act(Id::exposure_up);
    bench.act(Id::exposure_down);
    bench.act(Id::exposure_down);
    EXPECT_EQ(bench.look().rendering.exposure, 0);
    EXPECT_EQ(bench.viewer.answer(), "exposure: +0 stops");
    const image::Rgba8 start = bench.look().rendering.background;
    std::vector<std::string> seen;
    do {
        bench.act(Id::background_next);
        seen.push_back(background_text(bench.look().rendering.background));
    } while (!(bench.look().rendering.background == start) && seen.size() < 20);
    EXPECT_EQ(seen.size(), 9U) << "the names of --background, slate among them";
    bench.act(Id::background_next);
    bench.act(Id::background_previous);
    EXPECT_EQ(bench.look().rendering.background, start);
    EXPECT_EQ(background_text({1, 2, 171, 255}), "#0102ab");
}

TEST(LiveSwitches, PutAsksForThemInPlaceOfTheCommandLine) {
    frame::FrameOptions options;
    options.samples = 8;
    Rendering rendering = rendering_of(options);
    frame::FrameOptions same = options;
    put(rendering, same);
    EXPECT_EQ(same, options);
    rendering.asked[1] = "tent";
    rendering.asked[3] = "volume";
    rendering.exposure = 2;
    put(rendering, same);
    EXPECT_EQ(same.aa, "tent");
    EXPECT_EQ(same.samples, 1) << "two ways to ask for one thing";
    EXPECT_EQ(same.shadow, "volume");
    EXPECT_EQ(same.exposure, 2);
    options.shadow = "map";
    rendering.asked[3] = "auto";
    put(rendering, same = options);
    EXPECT_EQ(same.shadow, "auto");
}

TEST(LiveSwitches, TheCommandSaysThemOnce) {
    Settings settings;
    settings.given = {{"samples", "8"}, {"tone", "filmic"}, {"exposure", "1"}};
    settings.frame.samples = 8;
    settings.frame.tone = "filmic";
    settings.frame.exposure = 1;
    Bench bench(settings);
    std::string text = view_options(bench.viewer, settings, bench.mesh);
    EXPECT_THAT(text, HasSubstr("--samples 8"));
    EXPECT_THAT(text, HasSubstr("--tone filmic"));
    EXPECT_EQ(text.find("--tone"), text.rfind("--tone"));
    EXPECT_THAT(text, HasSubstr("--exposure 1 "));
    EXPECT_THAT(text, Not(HasSubstr("--background")));
    bench.act(Id::aa_next);
    bench.act(Id::tone_next);
    bench.act(Id::exposure_down);
    bench.act(Id::exposure_down);
    bench.act(Id::background_next);
    text = view_options(bench.viewer, settings, bench.mesh);
    EXPECT_THAT(text, HasSubstr("--aa none"));
    EXPECT_THAT(text, Not(HasSubstr("--samples")));
    EXPECT_THAT(text, Not(HasSubstr("--tone")));
    EXPECT_THAT(text, Not(HasSubstr("--exposure")));
    EXPECT_THAT(text, HasSubstr("--background red"));
}

TEST(LiveSwitches, CountBeforeRungsUntilTheNextStepOnTheFrontier) {
    Bench bench;
    bench.act(Id::texture_next);
    EXPECT_TRUE(counts_before_rung(bench.look().rendering, "texture"));
    EXPECT_FALSE(counts_before_rung(bench.look().rendering, "shadow"));
    EXPECT_FALSE(counts_before_rung(bench.look().rendering, "interpolate"));
    bench.act(Id::rung_down);
    EXPECT_FALSE(counts_before_rung(bench.look().rendering, "texture"));
}

// The triangle has no texture, and nothing casts a shadow.
TEST(LiveSwitches, ATechniqueThatCannotRunSaysThePlansReason) {
    scene::Scene scene;
    scene.mesh = test::triangle_mesh();
    const auto note = [&](std::string_view axis, std::string_view asked) {
        frame::FrameOptions options;
        frame::ask(options, axis, asked);
        return switch_note(*frame::plan(options, frame::facts(scene)), axis);
    };
    EXPECT_THAT(note("texture", "bilinear"), HasSubstr("changes nothing: no texture is read"));
    EXPECT_THAT(note("shadow", "volume"), HasSubstr("(off: "));
    EXPECT_THAT(note("shadow", "auto"), HasSubstr("(off: "));
    EXPECT_EQ(note("shading", "flat"), "");
    EXPECT_EQ(note("shading", "auto"), " (per_pixel)");
}

} // namespace
} // namespace scanout::app
