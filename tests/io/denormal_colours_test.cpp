// HARD-CASES 64: colours that are as good as black reach no kernel as denormal numbers, which would
// slow each pixel.
#include "folder.h"
#include "io/obj/mtl.h"
#include "io/vertex_colours.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace scanout::io {
namespace {

bool is_denormal(float value) {
    return std::fpclassify(value) == FP_SUBNORMAL;
}

TEST(Row64, NoColourOfAFileIsADenormalNumber) {
    int naive = 0;
    for (int exponent = -1074; exponent <= 0; ++exponent) {
        const double value = std::ldexp(1.0, exponent);
        naive += is_denormal(static_cast<float>(value)) ? 1 : 0;
        Warnings warnings;
        const auto read = read_mtl(
            fmt::format("newmtl m\nKd {0} 0 {0}\nKs {0}\nKe 0 {0} 0\n", value), "x.mtl", warnings);
        ASSERT_EQ(read.size(), 1U);
        const scene::Material& m = read[0].material;
        std::vector<Vec3> colours = {Vec3(DVec3(value))};
        decode_vertex_colours(colours, "x", warnings);
        for (const Vec3& colour : {m.diffuse, m.specular, m.emission, colours[0]})
            for (int c = 0; c < 3; ++c) {
                EXPECT_FALSE(is_denormal(colour[c])) << exponent;
                // Squares, too: light on a surface and its mirror image.
                EXPECT_FALSE(is_denormal(colour[c] * colour[c])) << exponent;
            }
        EXPECT_EQ(m.diffuse.x, exponent < -60 ? 0 : static_cast<float>(value));
    }
    EXPECT_GE(naive, 23);
}

} // namespace
} // namespace scanout::io
