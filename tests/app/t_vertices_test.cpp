// T-vertices are mended while a model is loaded: what a user sees and reads.
#include "app/program_fixture.h"

#include <cmath>
#include <sstream>

#include <fmt/format.h>

namespace scanout::app {
namespace {

// A quad in a plane that leans, and 60 quads along one of its edges, written with so many decimals.
std::string seam(int decimals) {
    std::string text;
    const auto vertex = [&](double u, double v) {
        text += fmt::format("v {:.{}f} {:.{}f} {:.{}f}\n", 0.9 * u + 0.1 * v, decimals,
                            0.3 * u + 0.8 * v, decimals, 0.2 * u - 0.5 * v, decimals);
    };
    constexpr int kParts = 60;
    vertex(-1, 0);
    vertex(-1, 1);
    for (int i = 0; i <= kParts; ++i)
        for (const double u : {0.0, 1.0})
            vertex(u, static_cast<double>(i) / kParts);
    text += fmt::format("f 1 3 {} 2\n", 3 + 2 * kParts);
    for (int i = 0; i < kParts; ++i)
        text += fmt::format("f {} {} {} {}\n", 3 + 2 * i, 4 + 2 * i, 6 + 2 * i, 5 + 2 * i);
    return text;
}

class TVertices : public Program {
protected:
    Outcome run(const std::string& words) {
        const Outcome done = Program::run(words);
        EXPECT_EQ(done.code, 0) << words << done.err;
        return done;
    }
    // Pixels of the background between two drawn ones of a row.
    std::size_t holes(const std::string& words) {
        run("render " + words + " --size 900x700 --samples 1 --background black -o p.ppm");
        const std::string file = folder.read("p.ppm");
        const std::string pixels = file.substr(file.size() - std::size_t{900} * 700 * 3);
        std::size_t found = 0;
        for (std::size_t y = 0; y < 700; ++y) {
            std::size_t dark = 0;
            bool drawn = false;
            for (std::size_t x = 0; x < 900; ++x) {
                const std::size_t at = (y * 900 + x) * 3;
                const bool is_dark = pixels[at] == 0 && pixels[at + 1] == 0 && pixels[at + 2] == 0;
                if (!is_dark && drawn) found += dark;
                drawn |= !is_dark;
                dark = is_dark ? dark + 1 : 0;
            }
        }
        return found;
    }
};

TEST_F(TVertices, NoBackgroundShowsInASurfaceOfThreeDecimals) {
    folder.write("seam.obj", seam(3));
    std::size_t kept = 0;
    for (const char* camera : {"0,0", "30,20", "-40,30", "200,10", "0,30", "225,-35"}) {
        const std::string seen = std::string("seam.obj --camera ") + camera;
        kept += holes(seen + " --t-vertices keep");
        EXPECT_EQ(holes(seen), 0U) << camera;
    }
    EXPECT_GT(kept, 20U);
}

TEST_F(TVertices, ThePictureIsThatOfTheFileThatDoctorMends) {
    folder.write("seam.obj", seam(3));
    run("doctor seam.obj --fix fixed.obj --size 64x48");
    const std::string picture = run("render seam.obj --size 900x700 --hash").out;
    EXPECT_EQ(run("render fixed.obj --size 900x700 --hash").out, picture);
    EXPECT_NE(run("render seam.obj --t-vertices keep --size 900x700 --hash").out, picture);
}

TEST_F(TVertices, OneLineSaysWhatWasMendedAndHowToLeaveIt) {
    folder.write("seam.obj", seam(3));
    const std::string said = run("render seam.obj --size 64x48 --hash").err;
    EXPECT_NE(said.find("warning: seam.obj: 59 vertices lie within other faces' edges"),
              std::string::npos)
        << said;
    EXPECT_NE(said.find("--t-vertices keep"), std::string::npos) << said;
    EXPECT_EQ(run("render seam.obj --t-vertices keep --size 64x48 --hash").err, "");
    folder.write("exact.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
                              "f 1 2 3 4\nf 2 5 6 3\n");
    EXPECT_EQ(run("render exact.obj --size 64x48 --hash").err, "");
}

TEST_F(TVertices, AHeapOfFacesIsNotSearchedAndALineSaysSo) {
    std::string heap = seam(3);
    const std::size_t vertices = 2 + 2 * 61;
    for (std::size_t i = 0; i < 70'000; ++i)
        heap += fmt::format("v {} {} {}\nv {} 1 {}\nv {} 0 1\nf {} {} {}\n", i % 300, i / 300,
                            i % 7, i % 300, i % 11, i / 300, vertices + 3 * i + 1,
                            vertices + 3 * i + 2, vertices + 3 * i + 3);
    folder.write("heap.obj", heap);
    const std::string said = run("render heap.obj --size 64x48 --hash").err;
    EXPECT_NE(said.find("open edges are too many to look for T-vertices"), std::string::npos)
        << said;
    EXPECT_EQ(said.find("lie within"), std::string::npos) << said;
}

} // namespace
} // namespace scanout::app
