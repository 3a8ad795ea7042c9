// scanout spectrum from outside: what it writes, and what it refuses.
#include "app/program_fixture.h"
#include "image/codec.h"

namespace scanout::app {
namespace {

class Spectrum : public Program {
protected:
    image::Image picture(const std::string& name) { return *image::load(folder.file(name)); }
    void write(const std::string& name, const image::Image& image) {
        const image::Bytes bytes = *image::encode_png(image);
        folder.write(name, std::string(bytes.begin(), bytes.end()));
    }
    image::Image gradient() const {
        image::Image out(45, 32);
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 45; ++x)
                out.at(x, y) = {static_cast<std::uint8_t>(5 * x), static_cast<std::uint8_t>(8 * y),
                                static_cast<std::uint8_t>(x * y % 256), 255};
        return out;
    }
};

TEST_F(Spectrum, AllFrequenciesGiveThePictureBackAndNoneIsSaid) {
    write("in.png", gradient());
    for (const char* words : {"--keep 0..2", "--keep ..1.5", "--keep 0.. --threads 3"}) {
        const Outcome outcome = run("spectrum in.png -o out.png " + std::string(words));
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.out + outcome.err, "");
        EXPECT_EQ(picture("out.png"), gradient());
    }
}

TEST_F(Spectrum, TheSpectrumIsAPictureOfTheSameSizeWhateverTheThreads) {
    write("in.png", gradient());
    EXPECT_EQ(run("spectrum in.png -o one.png --threads 1").code, 0);
    EXPECT_EQ(run("spectrum in.png -o two.ppm --threads 2").code, 0);
    EXPECT_EQ(picture("one.png"), picture("two.ppm"));
    EXPECT_EQ(picture("one.png").width(), 45);
    EXPECT_EQ(picture("one.png").at(22, 16).r, 255);
    EXPECT_TRUE(run("spectrum in.png -o -").out.starts_with("\x89PNG"));
}

TEST_F(Spectrum, BadUseIsOneLine) {
    write("in.png", gradient());
    folder.write("no.png", "no picture");
    for (const char* words :
         {"spectrum", "spectrum in.png", "spectrum in.png in.png -o x.png",
          "spectrum in.png -o in.png", "spectrum in.png -o x.obj",
          "spectrum in.png -o x.png --keep", "spectrum in.png -o x.png --keep 0.5",
          "spectrum in.png -o x.png --keep ..", "spectrum in.png -o x.png --keep 1..0",
          "spectrum in.png -o x.png --keep -1..1", "spectrum in.png -o x.png --keep 0..nan",
          "spectrum in.png -o x.png --samples 4"})
        EXPECT_EQ(refused(words), 2) << words;
    for (const char* words : {"spectrum none.png -o x.png", "spectrum no.png -o x.png",
                              "spectrum $m -o x.png", "spectrum in.png -o no/folder/x.png"})
        EXPECT_EQ(refused(words), 3) << words;
    EXPECT_NE(run("spectrum in.png -o x.png --keep 0.5").err.find("LOW..HIGH"), std::string::npos);
}

} // namespace
} // namespace scanout::app
