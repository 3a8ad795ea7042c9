#include "walk/models.h"

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include <fmt/format.h>

namespace scanout::test {
namespace {

// Rings from pole to pole; the normals are those of the ball.
std::string ball(int around, int rings, double radius, double x, bool normals) {
    std::string text;
    for (int j = 0; j <= rings; ++j)
        for (int i = 0; i < around; ++i) {
            const double up = std::numbers::pi * (static_cast<double>(j) / rings - 0.5),
                         turn = 2 * std::numbers::pi * i / around;
            const double n[3] = {std::cos(up) * std::sin(turn), std::sin(up),
                                 std::cos(up) * std::cos(turn)};
            text += fmt::format("v {:.5f} {:.5f} {:.5f}\nvn {:.5f} {:.5f} {:.5f}\n",
                                x + radius * n[0], radius * n[1], radius * n[2], n[0], n[1], n[2]);
        }
    const auto corner = [&](int j, int i) {
        const int number = (rings + 1 - j) * around - i % around; // from the end
        return normals ? fmt::format(" -{0}//-{0}", number) : fmt::format(" -{}", number);
    };
    for (int j = 0; j < rings; ++j)
        for (int i = 0; i < around; ++i)
            text += "f" + corner(j, i) + corner(j, i + 1) + corner(j + 1, i + 1) +
                    corner(j + 1, i) + "\n";
    return text;
}

// normals: "" of the faces, or as every corner's.
std::string box(double half, double x, bool bent, bool inside_out = false) {
    std::string text;
    for (int i = 0; i < 8; ++i) {
        const double p[3] = {(i & 1) != 0 ? half : -half, (i & 2) != 0 ? half : -half,
                             (i & 4) != 0 ? half : -half};
        text += fmt::format("v {} {} {}\n", x + p[0], p[1], p[2]);
        if (bent) text += fmt::format("vn {} {} {}\n", p[0], p[1], p[2]);
    }
    constexpr int kSides[6][4] = {{4, 5, 7, 6}, {1, 0, 2, 3}, {5, 1, 3, 7},
                                  {0, 4, 6, 2}, {6, 7, 3, 2}, {0, 1, 5, 4}};
    for (const auto& side : kSides) {
        text += "f";
        for (int k = 0; k < 4; ++k) {
            const int number = 8 - side[inside_out ? 3 - k : k];
            text += bent ? fmt::format(" -{0}//-{0}", number) : fmt::format(" -{}", number);
        }
        text += "\n";
    }
    return text;
}

constexpr const char* kFloor = "v -2 -0.5 2\nv 2 -0.5 2\nv 2 -0.5 -2\nv -2 -0.5 -2\n"
                               "f -4 -3 -2 -1\n";

} // namespace

void write_walk_models(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    const auto write = [&](const char* name, const std::string& text) {
        std::ofstream(folder / (std::string(name) + ".obj")) << text;
    };
    write("ball_smooth", ball(8, 5, 1, 0, true));
    write("ball_flat", "s off\n" + ball(7, 4, 1, 0, false));
    write("box", box(0.5, 0, false));
    write("box_bent", box(0.5, 0, true));
    write("box_inside_out", box(0.5, 0, false, true));
    write("boxes_apart", box(0.3, -0.6, false) + box(0.3, 0.7, true));
    write("box_and_ball", box(0.5, 0, false) + ball(9, 6, 0.5, 0.4, true));
    write("stage", kFloor + box(0.3, -0.4, false) + ball(12, 7, 0.4, 0.5, true));
    write("triangle", "v 0 0 0\nv 1 0 0.2\nv 0 1 -0.3\nf 1 2 3\n");
    write("triangle_bent", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1 0 0.1\nvn 0 1 -1\nvn -1 0 1\n"
                           "f 1//1 2//2 3//3\n");
    write("wires", "v 0 0 0\nv 1 0 0.2\nv 0 1 -0.3\nl 1 2 3\np 1 2 3\n");
    write("point", "v 3 4 5\np 1\n");
    write("no_area", "v 0 0 0\nv 1 1 1\nv 2 2 2\nv 2 2 2\nf 1 2 3\nf 1 1 2\nf 3 4 1\n");
    write("sliver", "v 0 0 0\nv 1 0 0\nv 0.5 1e-7 0\nv 0.5 0.5 1e-6\nf 1 2 3\nf 1 3 4\n");
    write("huge", "v 1e30 0 0\nv -1e30 1e29 0\nv 0 1e30 3e29\nv 1 1 1\nf 1 2 3\nf 1 2 4\n");
    write("tiny", "v 1e-30 0 0\nv -1e-30 1e-31 0\nv 0 1e-30 3e-31\nf 1 2 3\n");
    write("far_away", "v 100000 0 0\nv 100001 0 0\nv 100000 1 0.1\nf 1 2 3\n");
    write("twice", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\nf 1 2 3\n");
    write("wrong_normals", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 0\nvn nan 0 1\nf 1//1 2//2 3//1\n");
    write("bow_tie", "v 0 0 0\nv 1 1 0\nv 1 0 0.1\nv 0 1 0\nf 1 2 3 4\n");
    write("empty", "# nothing\n");
}

} // namespace scanout::test
