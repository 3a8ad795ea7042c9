// Overdraw: how many primitives lie over the centre of each pixel, after culling and before the
// depth test, in false colours. The colours step with every doubling and no two counts have the
// same, so that a picture can be read back.
#include "frame/stencil.h"

#include <array>

namespace scanout::frame::stencil {
namespace {

constexpr std::array<image::Rgba8, 256> colours() {
    struct Stop {
        int count;
        std::array<int, 3> code;
    };
    constexpr Stop kStops[] = {{1, {31, 47, 143}}, {2, {32, 96, 255}},   {4, {0, 200, 200}},
                               {8, {32, 208, 32}}, {16, {255, 224, 0}},  {32, {255, 128, 0}},
                               {64, {255, 0, 0}},  {128, {255, 0, 255}}, {255, {255, 255, 255}}};
    std::array<image::Rgba8, 256> all{};
    for (std::size_t i = 0; i + 1 < std::size(kStops); ++i) {
        const Stop &from = kStops[i], &to = kStops[i + 1];
        const int steps = to.count - from.count;
        for (int step = 0; step <= steps; ++step) {
            const auto code = [&](std::size_t c) {
                const int way = to.code[c] - from.code[c];
                return static_cast<std::uint8_t>(from.code[c] + way * step / steps);
            };
            all[static_cast<std::size_t>(from.count + step)] = {code(0), code(1), code(2), 255};
        }
    }
    return all;
}

void show_overdraw(const StencilBuffer& marks, int y, image::Image& picture) {
    static constexpr auto kColours = colours();
    const auto counts = marks.row(y);
    const auto pixels = picture.row(y);
    for (std::size_t x = 0; x < counts.size(); ++x)
        if (counts[x] != 0) pixels[x] = kColours[counts[x]];
}

} // namespace

extern const Stencil overdraw;
constinit const Stencil overdraw{
    {.axis = "stencil",
     .name = "overdraw",
     .blurb = "how many primitives lie over a pixel, hidden or not, instead of colours: 1 dark "
              "blue, 2 blue, 4 cyan, 8 green, 16 yellow, 32 orange, 64 red, 128 magenta, 255 white",
     .source = "Segal and Akeley 1992",
     .kind = Kind::model},
    Stencil::Marks::covering,
    show_overdraw};

} // namespace scanout::frame::stencil
