// The floor is that of the model in bench/peers/floor.h, and the core it stands on is measured, not
// the loop that measures it.
#include "bench/peers/clock.h"
#include "bench/peers/floor.h"

#include <cstring>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::bench {
namespace {

// The core by which the model was made, at 1920x1080; half of the triangles face the eye.
double floor_there(Shading shading, std::size_t triangles, double fragments) {
    const CoreLimits core{3.4e9, 25.8e9, 17.5e9};
    const Work work{triangles / 2, triangles, static_cast<double>(triangles) / 2, fragments,
                    1920.0 * 1080};
    return floor_of(Load{"", "", shading, 1, 1, 1}, work, core);
}

TEST(Floor, IsThatOfTheModel) {
    struct {
        Shading shading;
        std::size_t triangles;
        double fragments, floor; // ms
    } const rows[] = {{Shading::depth, 69'451, 0.339e6, 0.82},
                      {Shading::blinn_phong, 69'451, 0.339e6, 1.21},
                      {Shading::textured, 69'451, 0.339e6, 2.63},
                      {Shading::depth, 871'414, 0.35e6, 5.90},
                      {Shading::blinn_phong, 871'414, 0.35e6, 6.94}};
    for (const auto& row : rows)
        EXPECT_NEAR(floor_there(row.shading, row.triangles, row.fragments), row.floor,
                    row.floor * 0.03)
            << row.triangles << ' ' << static_cast<int>(row.shading);
    // What throws shadows there is textured, too: 14 cycles a pixel, of 24.
    const double shadowed = 15.13 - 14 * 0.374e6 / 3.4e6;
    EXPECT_NEAR(floor_there(Shading::shadowed, 871'414, 0.374e6), shadowed, shadowed * 0.03);
    EXPECT_EQ(floor_of(Load{"", "", Shading::depth, 4, 1, 1}, {}, {1, 1, 1}), 0);
}

#ifndef SCANOUT_SANITIZED // whose own work would be measured
// memcpy reads and writes all of it: what only reads, or only writes past the caches, is no slower.
TEST(Floor, TheCoreIsMeasuredAsFastAsMemcpy) {
    constexpr std::size_t kBytes = 64 << 20;
    std::vector<char> from(kBytes, 1), to(kBytes);
    Times times;
    CoreMeter meter;
    for (int i = 0; i < 9; ++i) {
        times.add([&] { std::memcpy(to.data(), from.data(), kBytes); });
        meter.measure();
    }
    const double copied = kBytes / (times.cpu_median() * 1e-3);
    const CoreLimits core = meter.typical();
    EXPECT_GT(core.read, 0.8 * copied);
    EXPECT_GT(core.write, 0.8 * copied);
    EXPECT_GT(core.clock, 0.5e9);
    EXPECT_LT(core.clock, 10e9);
}
#endif

} // namespace
} // namespace scanout::bench
