// The textbook renderer and the production renderer, which share no code, draw the same picture.
#include "support/scenes.h"
#include "textbook/models.h"
#include "textbook/pixels.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace scanout::textbook::test {
namespace {

// But for pixels whose centre an edge passes within the 1/512 px of snapping, and texels at the
// border of two.
TEST(TextbookRenderer, DrawsWhatTheProductionRendererDraws) {
    for (const char* name :
         {"spot/spot.obj", "suzanne/suzanne.obj", "cornell_box/cornell_box.obj"}) {
        Shot s = shot_of_model(name, 320, 240);
        s.options.texture = "nearest";
        s.options.effects["shadow"] = false;
        for (const double azimuth : {30.0, 150.0}) {
            s.camera.azimuth_degrees = azimuth;
            s.camera.elevation_degrees = 20;
            const image::Image production = scanout::test::draw(s), ours = picture(s);
            EXPECT_GT(covered_pixels(ours, s), 5000) << name;
            EXPECT_LT(different_pixels(ours, production, 1), 160) << name << ' ' << azimuth;
            record(name + std::to_string(static_cast<int>(azimuth)),
                   different_pixels(ours, production, 1));
        }
    }
}

// Between planes and through windows that the caller gives, whichever way the rest is cut.
TEST(TextbookRenderer, CutsWhatTheProductionRendererCuts) {
    Shot s = shot_of_model("spot/spot.obj", 160, 120);
    s.options.texture = "nearest";
    s.options.effects["shadow"] = false;
    s.camera.azimuth_degrees = 30;
    s.camera.distance = 3;
    const int whole = covered_pixels(scanout::test::draw(s), s);
    s.model.steps.push_back({scene::shear(0, 0.4, 0), DVec3(0), {}});
    for (const bool flat : {false, true}) {
        s.camera.projection =
            flat ? scene::Projection::orthographic : scene::Projection::perspective;
        const double unit = flat ? 1 : 2.9 / 3;
        s.camera.window =
            scene::Window{s.camera.projection, -0.7 * unit, 1 * unit, -0.9 * unit, 0.6 * unit};
        s.camera.near = 2.9;
        s.camera.far = 3.1;
        const image::Image production = scanout::test::draw(s);
        EXPECT_GT(covered_pixels(production, s), 1000);
        EXPECT_LT(covered_pixels(production, s), whole * 3 / 2);
        for (const Clip clip : {Clip::six_planes, Clip::four_cases, Clip::sutherland_hodgman})
            for (const Hidden hidden : {Hidden::z_pseudo, Hidden::z_linear, Hidden::z_squared}) {
                Parts parts = with(hidden);
                parts.clip = clip;
                EXPECT_LT(different_pixels(picture(s, parts), production, 1), 80)
                    << flat << ' ' << static_cast<int>(clip) << ' ' << static_cast<int>(hidden);
            }
        s.camera.far = 9;
        EXPECT_GT(different_pixels(scanout::test::draw(s), production, 1), 300);
        s.camera.near = flat ? 0.1 : 2.9; // a window is as large as its near plane says
        const int other = different_pixels(scanout::test::draw(s), production, 1);
        EXPECT_GT(other, flat ? 600 : 300);
    }
}

// A wire ends where the planes cut it.
TEST(TextbookRenderer, WiresEndAtThePlanes) {
    Shot s = shot_of_model("spot/spot.obj", 160, 120);
    s.camera.distance = 3;
    const image::Image whole = picture(s, with(Hidden::none));
    s.camera.far = 2.9;
    const int nearer = different_pixels(picture(s, with(Hidden::none)), whole);
    s.camera.far.reset();
    s.camera.near = 2.9;
    const int farther = different_pixels(picture(s, with(Hidden::none)), whole);
    EXPECT_GT(nearer, 300);
    EXPECT_GT(farther, 300);
}

TEST(TextbookRenderer, EveryPresetDrawsTheModelWhereTheOthersDo) {
    const Shot s = scanout::test::ball("ball");
    const image::Image blank(64, 64, s.options.background);
    const int covered = different_pixels(picture(s), blank);
    for (std::size_t r = 0; r < renderers().size(); ++r) {
        const image::Image drawn = picture(s, parts_of(static_cast<Renderer>(r)));
        EXPECT_NEAR(different_pixels(drawn, blank), covered, covered * 0.1) << renderers()[r].name;
    }
}

// What is to be read beside a textbook is short.
TEST(TextbookRenderer, NoFileHasTwoHundredLines) {
    int files = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(SCANOUT_SOURCE_DIR "/src/textbook")) {
        if (!entry.is_regular_file()) continue;
        std::ifstream stream(entry.path());
        const auto lines = std::count(std::istreambuf_iterator<char>(stream), {}, '\n');
        EXPECT_LT(lines, 200) << entry.path();
        ++files;
    }
    EXPECT_GT(files, 50);
}

} // namespace
} // namespace scanout::textbook::test
