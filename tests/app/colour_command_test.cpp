// scanout colour from outside: one colour in every model, both ways; channels of a picture.
#include "app/options/colour_value.h"
#include "app/program_fixture.h"
#include "image/codec.h"
#include "image/colour_models.h"

namespace scanout::app {
namespace {

TEST(ColourValue, IsReadInAnyModelAndEachLineIsReadAgain) {
    for (const char* text : {"#ff8000", "rgb:255,128,0", "white", "black", "hsl:270,0.5,0.4",
                             "cmy:0,0.4,1", "lab:67,43,74", "ycbcr:128,128,128", "xyz:0.2,0.3,0.1",
                             "linear:0.5,0.26,1", "hsv:360,1,1"}) {
        const auto rgb = parse_colour_value(text);
        ASSERT_TRUE(rgb) << text << ": " << rgb.error().what;
        const std::vector<std::string> lines = colour_lines(*rgb);
        ASSERT_EQ(lines.size(), 1 + image::colour_models().size());
        if (lines[0].size() > 7) continue; // outside of sRGB: not every model has it
        for (const std::string& line : lines) {
            const auto again = parse_colour_value(line.substr(0, line.find(' ')));
            ASSERT_TRUE(again) << line << ": " << again.error().what;
            EXPECT_EQ(colour_lines(*again)[0], lines[0]) << line;
        }
    }
}

TEST(ColourValue, OutsideOfSrgbIsSaidAndTheNearestCodeGiven) {
    const auto rgb = parse_colour_value("lab:50,100,-100");
    ASSERT_TRUE(rgb);
    const std::vector<std::string> lines = colour_lines(*rgb);
    EXPECT_NE(lines[0].find("nearest"), std::string::npos) << lines[0];
    EXPECT_NE(lines.back().find("lab:50,100,-100 "), std::string::npos) << lines.back();
}

class Colour : public Program {};

TEST_F(Colour, PrintsALineForEachModel) {
    const Outcome outcome = run("colour '#ff8000'");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::vector<std::string> lines = outcome.lines();
    ASSERT_EQ(lines.size(), 9U);
    EXPECT_EQ(lines[0], "#ff8000");
    EXPECT_TRUE(lines[1].starts_with("rgb:255,128,0 "));
    EXPECT_TRUE(lines[2].starts_with("linear:1,0.215861,0 "));
    EXPECT_TRUE(lines[3].starts_with("cmy:0,0.498039,1 "));
    EXPECT_TRUE(lines[4].starts_with("hsv:30.117647,1,1 "));
    EXPECT_EQ(run("colour hsv:30.117647,1,1").lines()[1], lines[1]);
}

TEST_F(Colour, ChannelsOfAPictureLieBesideEachOtherOrInAFileEach) {
    image::Image picture(2, 3, {255, 0, 0, 255});
    const image::Bytes bytes = *image::encode_png(picture);
    folder.write("red.png", std::string(bytes.begin(), bytes.end()));
    EXPECT_EQ(run("colour red.png --channels lab -o all.png").code, 0);
    const image::Image all = *image::load(folder.file("all.png"));
    EXPECT_EQ(all.width(), 6);
    EXPECT_EQ(all.height(), 3);
    EXPECT_EQ(run("colour red.png --channels lab -o 'c-{n}.ppm'").code, 0);
    Jobs jobs(1);
    const auto expected = image::channels_of(picture, *image::find_colour_model("lab"), jobs);
    for (int i = 0; i < 3; ++i) {
        const image::Image one = *image::load(folder.file("c-" + std::to_string(i) + ".ppm"));
        EXPECT_EQ(one, expected[static_cast<std::size_t>(i)]);
        EXPECT_EQ(all.at(2 * i, 2), one.at(0, 0));
    }
}

TEST_F(Colour, BadUseIsOneLine) {
    folder.write("no.png", "no picture");
    for (const char* words :
         {"colour", "colour red blue", "colour reddish", "colour '#12345'", "colour lab:1,2",
          "colour lab:1,2,3,4", "colour lad:1,2,3", "colour hsv:30,2,1", "colour rgb:256,0,0",
          "colour lab:nan,0,0", "colour cmy:-0.1,0,0", "colour red -o x.png",
          "colour no.png --channels lab", "colour no.png --channels lad -o x.png",
          "colour no.png --channels lab -o x.tiff", "colour red --samples 2"})
        EXPECT_EQ(refused(words), 2) << words;
    EXPECT_EQ(refused("colour no.png --channels lab -o x.png"), 3);
    EXPECT_EQ(refused("colour none.png --channels lab -o x.png"), 3);
    EXPECT_NE(run("colour lad:1,2,3").err.find("did you mean 'lab'"), std::string::npos);
    EXPECT_NE(run("colour hsv:30,2,1").err.find("saturation of hsv is 0 to 1, not 2"),
              std::string::npos);
}

} // namespace
} // namespace scanout::app
