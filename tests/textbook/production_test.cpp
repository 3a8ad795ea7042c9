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
         std::filesystem::directory_iterator(SCANOUT_SOURCE_DIR "/src/textbook")) {
        std::ifstream stream(entry.path());
        const auto lines = std::count(std::istreambuf_iterator<char>(stream), {}, '\n');
        EXPECT_LT(lines, 200) << entry.path();
        ++files;
    }
    EXPECT_GT(files, 50);
}

} // namespace
} // namespace scanout::textbook::test
