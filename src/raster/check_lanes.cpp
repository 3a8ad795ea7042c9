#include "raster/check_lanes.h"

#ifdef SCANOUT_CHECK_LANES
#include "base/check.h"

#include <cmath>

namespace scanout::raster {

void check_lanes(std::span<const ScreenVertex> vertices) {
    constexpr double kMost = kGuardPixels * kSubpixel;
    for (const ScreenVertex& v : vertices) {
        if (!v.on_screen()) continue;
        CHECK_LE(std::abs(v.x), kMost);
        CHECK_LE(std::abs(v.y), kMost);
        CHECK(std::isfinite(v.depth));
    }
}

void check_lanes(std::span<const float> depths) {
    for (const float depth : depths)
        CHECK(std::isfinite(depth));
}

} // namespace scanout::raster
#endif
